#include "plant/connections.hpp"

#include "service/log/leaves.hpp"

namespace fitgauge::connections {
namespace {

/// Returns the kind of a body; reports an unknown one.
const Kind* named_kind(const JsonValue& body, api::FieldErrors& errors) {
  api::FieldReader fields(body, "", errors);
  const auto word = fields.text("kind");
  if (!word) return nullptr;
  std::string names;
  for (const Kind& kind : kinds()) {
    if (kind.name == *word) return &kind;
    names += (names.empty() ? "" : ", ") + std::string(kind.name);
  }
  fields.report(ErrorCode::FieldInvalid, "kind",
                fmt::format("unknown kind of connection '{}'; use one of: {}",
                            first_characters(*word, 40), names));
  return nullptr;
}

constexpr std::string_view kSecrets = "secrets";
constexpr std::string_view kPassword = "password";
constexpr std::string_view kHeaders = "headers";

/// Returns whether both have the same text there, or both no text.
bool is_same(const JsonValue& a, const JsonValue& b, std::string_view name) {
  const JsonValue* const in_a = a.find(name);
  const JsonValue* const in_b = b.find(name);
  if (in_a == nullptr || in_b == nullptr) return in_a == in_b;
  return in_a->text == in_b->text;
}

bool overlap(const std::vector<std::string>& some, const std::vector<std::string>& others) {
  return std::ranges::any_of(some, [&](const std::string& one) {
    return std::ranges::any_of(others,
                               [&](const std::string& other) { return globs_overlap(one, other); });
  });
}

bool is_same_folder(const std::filesystem::path& one, const std::filesystem::path& other) {
  std::error_code failure;
  return std::filesystem::weakly_canonical(one, failure) ==
         std::filesystem::weakly_canonical(other, failure);
}

constexpr std::size_t kMostWaiting = 64;
constexpr std::size_t kTestsAtOnce = 8;

Error unknown(std::string_view name) {
  return {ErrorCode::ConnectionUnknown,
          fmt::format("connection not found: '{}'", first_characters(name, 100))};
}

Error read_only(std::string_view name) {
  return {ErrorCode::ConnectionReadOnly,
          fmt::format("the connection '{}' belongs to the configuration file: change it there and "
                      "restart the service",
                      name)};
}

}  // namespace

bool is_secret(std::string_view setting) { return setting == kSecrets || setting == kPassword; }

Result<void> check_name(std::string_view name) {
  const bool is_name = !name.empty() && name.size() <= 63 && std::ranges::all_of(name, [](char c) {
    return is_ascii_alphanumeric(c) || c == '-' || c == '_';
  });
  if (is_name) return {};
  return Error{ErrorCode::PathMalformed,
               "the name of a connection must have 1 to 63 letters, digits, - and _"};
}

void keep_secrets(JsonValue& body, const Definition& before) {
  const auto known = parse_json(before.text);
  if (!body.is(JsonValue::Kind::Object) || !known || !is_same(body, *known, "kind")) return;
  const auto keep = [&](std::string_view name) {
    const JsonValue* const secret = known->find(name);
    if (secret != nullptr && body.find(name) == nullptr) body.members.emplace_back(name, *secret);
  };
  keep(kSecrets);
  // The broker receives the password: only a caller who knows it may send it to another broker.
  const bool is_same_broker = is_same(body, *known, "broker") && is_same(body, *known, "user") &&
                              is_same(body, *known, "ca_file");
  if (is_same_broker) keep(kPassword);
  if (!is_same(body, *known, "url")) return;
  keep(kHeaders);
  for (auto& [name, value] : body.members) {
    if (name != kHeaders) continue;
    for (auto& [header, given] : value.members) {
      if (given.is(JsonValue::Kind::Null)) given = known->member(kHeaders).member(header);
    }
  }
}

Result<Definition> read_definition(std::string name, const JsonValue& body,
                                   const FolderPermissions& allowed) {
  TRY(check_name(name));
  api::FieldErrors errors;
  Definition definition{.name = std::move(name)};
  if (const Kind* const kind = named_kind(body, errors)) {
    definition.kind = kind->name;
    ReadSettings read(body, errors, allowed);
    read.member("kind", definition.kind);
    definition.settings = kind->read(read, definition.name);
    read.end();
  }
  if (auto error = errors.take()) return *std::move(error);
  definition.text = api::json_text(body);
  definition.shown = api::json_text(app::without_secrets(body));
  return definition;
}

std::optional<std::string> fault_of_both(const Definition& one, const Definition& other) {
  const auto& mine = one.settings.folder;
  const auto& its = other.settings.folder;
  if (!mine || !its || !is_same_folder(mine->folder, its->folder)) return std::nullopt;
  const auto fault = [](const Definition& in, std::string_view what, const Definition& second) {
    return fmt::format(
        "'{}' would store again what '{}' {} this folder: choose another folder, or "
        "other names",
        in.name, second.name, what);
  };
  if (overlap(mine->reads, its->reads)) return fault(one, "takes from", other);
  if (overlap(mine->reads, its->writes)) return fault(one, "writes into", other);
  if (overlap(its->reads, mine->writes)) return fault(other, "writes into", one);
  return std::nullopt;
}

Connections::Connections(Plant plant)
    : plant_(std::move(plant)),
      changes_("connections", 1, kMostWaiting),
      tests_("tests", kTestsAtOnce, kMostWaiting) {}

Result<std::unique_ptr<Connections>> Connections::start(std::vector<Definition> configured,
                                                        Plant plant) {
  std::unique_ptr<Connections> all(new Connections(std::move(plant)));
  const auto stored = all->plant_.documents.wait_for_list(app::DocumentKind::Connection);
  if (!stored && stored.error().code != ErrorCode::StorageCorrupt) return stored.error();
  for (Definition& definition : configured) {
    definition.is_read_only = true;
    all->begin(std::move(definition));
  }
  if (!stored) return all;  // the readiness shows the damage
  for (const app::NamedDocument& document : *stored) {
    const auto body = parse_stored_json(document.text, "a connection");
    const auto not_started = [&](const std::string& why) {
      all->plant_.tell("connection_not_started", fmt::format("{}: {}", document.name, why));
      const std::string kind(body ? body->text_of("kind") : "");
      const bool is_known = std::ranges::find(kinds(), kind, &Kind::name) != kinds().end();
      if (!is_known || all->find(document.name)) return;
      all->begin({.name = document.name,
                  .kind = kind,
                  .text = document.text,
                  .shown = api::json_text(app::without_secrets(*body)),
                  .fault = why});
    };
    if (all->find(document.name)) {
      not_started("the configuration file has a connection of that name: choose another name");
      continue;
    }
    auto definition =
        body ? read_definition(document.name, *body, {.roots = all->plant_.folders}) : body.error();
    if (!definition) {
      const Error& error = definition.error();
      not_started(error.details.empty() ? error.message : error.details.front().message);
    } else if (const auto fault = all->fault_with_others(*definition)) {
      not_started(*fault);
    } else {
      all->begin(*std::move(definition));
    }
  }
  return all;
}

Connections::~Connections() {
  stopping_.request_stop();
  changes_.stop();
  tests_.stop();
  for (const auto& [key, entry] : entries_) {
    if (entry.worker) entry.worker->request_stop();
  }
}

void Connections::begin(Definition definition) {
  const std::string key = ascii_lower(definition.name);
  auto worker = definition.fault.empty() ? definition.settings.start(plant_) : nullptr;
  const std::lock_guard lock(mutex_);
  entries_.insert_or_assign(key, Entry{std::move(definition), std::move(worker)});
}

void Connections::end(const std::string& key) {
  std::unique_ptr<Worker> worker;  // ends outside of the lock
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(key);
  if (found == entries_.end()) return;
  worker = std::move(found->second.worker);
  entries_.erase(found);
}

std::optional<Definition> Connections::find(std::string_view name) const {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(ascii_lower(name));
  return found == entries_.end() ? std::nullopt : std::optional(found->second.definition);
}

std::optional<std::string> Connections::fault_with_others(const Definition& definition) const {
  const std::string own = ascii_lower(definition.name);
  const std::lock_guard lock(mutex_);
  for (const auto& [key, entry] : entries_) {
    if (key == own) continue;
    if (auto fault = fault_of_both(definition, entry.definition)) return fault;
  }
  return std::nullopt;
}

Result<std::optional<Definition>> Connections::find_stored(std::string_view name) const {
  auto stored = TRY(plant_.documents.wait_for_list(app::DocumentKind::Connection));
  for (app::NamedDocument& document : stored) {
    if (ascii_lower(document.name) != ascii_lower(name)) continue;
    return std::optional(
        Definition{.name = std::move(document.name), .text = std::move(document.text)});
  }
  return std::optional<Definition>();
}

Result<Definition> Connections::named(std::string_view name) const {
  auto found = find(name);
  if (!found || found->name != name) return unknown(name);
  return *std::move(found);
}

ConnectionState Connections::state_of(const Entry& entry) {
  const Definition& definition = entry.definition;
  ConnectionState state = entry.worker
                              ? entry.worker->state()
                              : ConnectionState{.is_failing = true, .last_error = definition.fault};
  state.name = definition.name;
  state.kind = definition.kind;
  state.settings = definition.shown;
  state.is_outgoing = std::ranges::find(kinds(), definition.kind, &Kind::name)->is_outgoing;
  state.is_read_only = definition.is_read_only;
  return state;
}

std::vector<ConnectionState> Connections::states() const {
  std::vector<ConnectionState> states;
  const std::lock_guard lock(mutex_);
  for (const auto& [key, entry] : entries_) states.push_back(state_of(entry));
  return states;
}

std::optional<ConnectionState> Connections::state(std::string_view name) const {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(ascii_lower(name));
  if (found == entries_.end() || found->second.definition.name != name) return std::nullopt;
  return state_of(found->second);
}

Result<bool> Connections::put(const std::string& name, std::string_view body,
                              const std::optional<std::string>& caller) {
  if (plant_.is_shared) {
    return Error{ErrorCode::ConnectionReadOnly,
                 "this service shares its database and has no connections: add them at a station "
                 "with a data folder, which forwards to this service"};
  }
  TRY(check_name(name));
  auto before = find(name);
  if (before && before->is_read_only) return read_only(before->name);
  // A stored connection that is not shown keeps its position and its secrets, too.
  if (!before) before = TRY(find_stored(name));
  if (before && before->name != name) {
    return Error{ErrorCode::PathMalformed,
                 fmt::format("'{}' and the connection '{}' differ only in upper and lower case",
                             name, before->name)};
  }
  if (!before && states().size() >= kMostConnections) {
    return Error{ErrorCode::RequestInvalid,
                 fmt::format("the service has {} connections, the largest number: delete one",
                             kMostConnections)};
  }
  auto json = TRY(parse_json(body));
  if (before) keep_secrets(json, *before);
  auto definition = TRY(read_definition(name, json, {.roots = plant_.folders}));
  if (auto fault = fault_with_others(definition)) {
    api::FieldErrors errors;
    errors.add(ErrorCode::FieldInvalid, "/folder", *std::move(fault));
    return *errors.take();
  }
  if (const auto& follower = definition.settings.follower) {
    // Stores the start before the connection exists: it misses nothing after the response.
    if (!before) TRY(forget_progress(plant_.documents, name));
    TRY(begin_progress(*follower, plant_));
  }
  const auto is_new = TRY(plant_.documents.write_and_wait({.kind = app::DocumentKind::Connection,
                                                           .name = name,
                                                           .text = definition.text,
                                                           .caller = caller}));
  end(ascii_lower(name));
  begin(std::move(definition));
  return is_new;
}

Result<void> Connections::remove(const std::string& name,
                                 const std::optional<std::string>& caller) {
  const auto found = named(name);
  if (found && found->is_read_only) return read_only(name);
  // Removes a connection even if it was stored and not started.
  TRY(plant_.documents.remove_and_wait(app::DocumentKind::Connection, name, caller));
  if (found) end(ascii_lower(name));
  return forget_progress(plant_.documents, name);
}

Result<void> Connections::replay(const std::string& name, std::string_view body) {
  const auto found = TRY(named(name));
  if (!found.fault.empty()) return Error{ErrorCode::RequestInvalid, found.fault};
  const auto json = TRY(parse_json(body));
  const auto order = TRY(api::read_whole<ReplayOrder>(json));
  const auto& follower = found.settings.follower;
  if (!follower) {
    return Error{
        ErrorCode::RequestInvalid,
        fmt::format("the connection '{}' is incoming: only outgoing connections can replay", name)};
  }
  end(ascii_lower(name));  // which keeps how far it came
  const auto saved = [&]() -> Result<void> {
    auto progress = TRY(begin_progress(*follower, plant_));
    TRY(move_back(progress, order, plant_));
    return save_progress(plant_.documents, name, progress);
  }();
  begin(found);
  return saved;
}

Result<ConnectionTest> Connections::test(const std::string& name) {
  const auto found = TRY(named(name));
  if (!found.fault.empty()) return ConnectionTest{false, found.fault};
  {
    std::unique_lock lock(mutex_);  // a broker sends the first of two with one name away
    tested_.wait(lock, [&] { return under_test_.insert(name).second; });
  }
  const std::shared_ptr<void> end(nullptr, [&](void*) {
    const std::lock_guard lock(mutex_);
    under_test_.erase(name);
    tested_.notify_all();
  });
  const TestResult tested = found.settings.test(plant_, stopping_.get_token());
  return ConnectionTest{tested.has_value(), tested ? *tested : tested.error().message};
}

}  // namespace fitgauge::connections
