#include "daemon/parts.hpp"

#include <toml++/toml.h>

#include <sstream>

#include "base/folder.hpp"
#include "daemon/log.hpp"
#include "service/log/station_texts.hpp"

namespace fitgauge::daemon {
namespace {

using connections::Definition;

JsonValue text_value(std::string text) {
  return {.kind = JsonValue::Kind::String, .text = std::move(text)};
}

template <class Number>
JsonValue number_value(Number number) {
  return {.kind = JsonValue::Kind::Number, .text = fmt::format("{}", number)};
}

/// TOML as the JSON that a PUT would have.
JsonValue json_of(const toml::node& node) {
  JsonValue value;
  if (const toml::table* const table = node.as_table()) {
    value.kind = JsonValue::Kind::Object;
    for (const auto& [key, member] : *table)
      value.members.emplace_back(std::string(key.str()), json_of(member));
  } else if (const toml::array* const array = node.as_array()) {
    value.kind = JsonValue::Kind::Array;
    for (const toml::node& item : *array) value.items.push_back(json_of(item));
  } else if (const auto text = node.value_exact<std::string>()) {
    return text_value(*text);
  } else if (const auto number = node.value_exact<std::int64_t>()) {
    return number_value(*number);
  } else if (const auto real = node.value_exact<double>()) {
    return number_value(*real);
  } else if (const auto truth = node.value_exact<bool>()) {
    return {.kind = JsonValue::Kind::Boolean, .boolean = *truth};
  } else {
    // A date or a time: no connection accepts one, so the error shows it.
    std::ostringstream date;
    node.visit([&date](const auto& any) {
      if constexpr (toml::is_value<decltype(any)>) date << any.get();
    });
    return text_value(date.str());
  }
  return value;
}

/// One `[[connection]]`.
class ConnectionReader {
 public:
  ConnectionReader(const std::string& file, const toml::table& table)
      : file_(file), table_(table) {}

  Result<Definition> read() const {
    JsonValue body = json_of(table_);
    const JsonValue* const name = body.find("name");
    if (name == nullptr || !name->is(JsonValue::Kind::String))
      return error(table_.get("name"), "name of a connection must be a text");
    std::string named = name->text;
    std::erase_if(body.members, [](const auto& member) { return member.first == "name"; });
    TRY(load_patterns(body));
    auto definition = connections::read_definition(std::move(named), body, {.all = true});
    if (!definition) return errors(definition.error());
    return definition;
  }

 private:
  Error error(const toml::node* node, std::string_view message) const {
    const auto line = node == nullptr ? table_.source().begin.line : node->source().begin.line;
    return Error::of(ErrorCode::ConfigInvalid, "{}:{}: {}", file_, line, message);
  }

  /// Every field that cannot be accepted, each with its line.
  Error errors(const Error& refused) const {
    if (refused.code == ErrorCode::PathMalformed) return error(table_.get("name"), refused.message);
    if (refused.details.empty()) return error(nullptr, refused.message);
    Error all{ErrorCode::ConfigInvalid, {}};
    for (const Error& field : refused.details) {
      const std::string_view place =
          std::string_view(field.where).substr(field.where.empty() ? 0 : 1);
      const toml::node* const node = table_.get(place.substr(0, place.find('/')));
      all.message += (all.message.empty() ? "" : "\n") + error(node, field.message).message;
    }
    return all;
  }

  /// The names of files with their contents.
  Result<void> load_patterns(JsonValue& body) const {
    for (auto& [key, list] : body.members) {
      if (key != "patterns" || !list.is(JsonValue::Kind::Array)) continue;
      for (JsonValue& item : list.items) {
        if (!item.is(JsonValue::Kind::String))
          return error(table_.get("patterns"), "patterns must be a list of texts");
        const auto path = std::filesystem::path(file_).parent_path() / item.text;
        auto content = read_regular(path);
        if (!content) {
          return error(table_.get("patterns"), fmt::format("cannot read the pattern file {}: {}",
                                                           path.string(), content.error().message));
        }
        JsonValue pattern{.kind = JsonValue::Kind::Object};
        pattern.members.emplace_back("file", text_value(item.text));
        pattern.members.emplace_back("text", text_value(*std::move(content)));
        item = std::move(pattern);
      }
    }
    return {};
  }

  const std::string& file_;
  const toml::table& table_;
};

constexpr std::chrono::seconds kPatienceAtStart{3};
constexpr long kOk = 200;

/// `centre.example:8286` of `https://centre.example:8286/`; empty if it is no centre's address.
std::string_view authority_of(std::string_view url) {
  const std::size_t scheme = url.find("://");
  if (scheme == url.npos) return {};
  std::string_view authority = url.substr(scheme + 3);
  if (authority.ends_with('/')) authority.remove_suffix(1);
  return authority.find_first_of("/?#@ ") == authority.npos ? authority : std::string_view();
}

bool is_this_machine(std::string_view authority) {
  if (authority.starts_with("[::1]")) return true;
  const std::string_view host = authority.substr(0, authority.find(':'));
  const auto is_of_number = [](char c) { return (c >= '0' && c <= '9') || c == '.'; };
  return host == "localhost" ||
         (host.starts_with("127.") && std::ranges::all_of(host, is_of_number));
}

std::string without_last_slash(std::string url) {
  if (url.ends_with('/')) url.pop_back();
  return url;
}

forwarder::CentreOptions centre_of(const Config& config) {
  return {.url = without_last_slash(config.forward_to),
          .key_file = config.forward_key_file,
          .authorities = config.forward_ca};
}

}  // namespace

Result<std::vector<Definition>> read_connections(const std::string& path) {
  std::vector<Definition> definitions;
  if (path.empty()) return definitions;
  const auto invalid = [&path](auto line, std::string_view what) {
    return config_error("{}:{}: {}", path, line, what);
  };
  const auto text = read_regular(path);
  if (!text) return config_error("cannot read {}: {}", path, text.error().message);
  toml::table file;
  try {
    file = toml::parse(*text, path);
  } catch (const toml::parse_error& error) {
    return invalid(error.source().begin.line, error.description());
  }
  std::set<std::string> names;
  for (const auto& [key, node] : file) {
    const toml::array* const list = node.as_array();
    if (key.str() != "connection" || list == nullptr)
      return invalid(key.source().begin.line, "the file must contain only [[connection]]");
    for (const toml::node& item : *list) {
      const toml::table* const table = item.as_table();
      if (table == nullptr) return invalid(item.source().begin.line, "write [[connection]]");
      auto definition = TRY(ConnectionReader(path, *table).read());
      if (!names.insert(ascii_lower(definition.name)).second) {
        return invalid(item.source().begin.line,
                       fmt::format("the connection '{}' occurs twice", definition.name));
      }
      for (const Definition& other : definitions) {
        if (const auto fault = connections::fault_of_both(definition, other))
          return invalid(item.source().begin.line, *fault);
      }
      definitions.push_back(std::move(definition));
    }
  }
  if (definitions.size() > connections::kMostConnections)
    return invalid(1, fmt::format("more than {} connections", connections::kMostConnections));
  return definitions;
}

Result<std::unique_ptr<connections::Connections>> start_connections(
    const Config& config, app::Application& app, const Clock& clock,
    const api::GaugesInUse& gauges) {
  auto configured = TRY(read_connections(config.connections));
  return connections::Connections::start(
      std::move(configured),
      {.measurements = app.measurements(),
       .events = app.events(),
       .documents = app.documents(),
       .files = app.files(),
       .tables = app.tables(),
       .gauges = gauges,
       .clock = clock,
       .origin = std::string(app.log().origin()),
       .is_branch = app.log().origins().first() != app.log().origin(),
       .folders = {config.connection_folders.begin(), config.connection_folders.end()},
       .may_reach_private = config.allow_private_addresses,
       .is_shared = !config.database.empty(),
       .tell = [](std::string_view event, const std::string& detail) {
         event == "connection_recovered" ? log_info(event, detail) : log_warning(event, detail);
       }});
}

Result<void> check_forwarding(const Config& config) {
  const std::string& url = config.forward_to;
  if (url.empty()) {
    if (config.forward_key_file.empty() && config.forward_ca.empty()) return {};
    return config_error(
        "forward-key-file and forward-ca need forward-to, the address of the centre");
  }
  const std::string_view authority = authority_of(url);
  const bool is_plain = url.starts_with("http://");
  if (authority.empty() || !(is_plain || url.starts_with("https://"))) {
    return config_error(
        "forward-to must be https://host or https://host:port of a centre; got '{}'", url);
  }
  if (is_plain && !config.forward_insecure && !is_this_machine(authority)) {
    return config_error(
        "forward-to {} would send the key and the measurements without encryption: use "
        "https://, or set forward-insecure",
        url);
  }
  for (const std::string& file : {config.forward_key_file, config.forward_ca}) {
    if (file.empty()) continue;
    if (const auto opened = open_regular(file); !opened)
      return config_error("cannot read {}: {}", file, opened.error().message);
  }
  return {};
}

void tell_log(std::string_view event, const std::string& detail) {
  event == "forward_goes_on" || event == "revisions_taken" ? log_info(event, detail)
                                                           : log_warning(event, detail);
}

std::optional<app::AtCentre> ask_centre(const Config& config, std::string_view digits) {
  const auto until = std::chrono::steady_clock::now() + kPatienceAtStart;
  forwarder::CentreLink link(centre_of(config));
  const auto answer = link.get(fmt::format("/v1/log/revisions?station={}", digits),
                               [until] { return std::chrono::steady_clock::now() < until; });
  const auto read = api::read_revisions(answer.status == kOk ? answer.body : "");
  if (!read) return std::nullopt;
  return app::AtCentre{.centre = (*read)->page.origin,
                       .rows = (*read)->page.size,
                       .note = (*read)->page.notes.value_or(0),
                       .is_branched = (*read)->page.is_branched};
}

std::unique_ptr<forwarder::Forwarder> start_forwarder(const Config& config, app::Application& app,
                                                      forwarder::Tell tell) {
  if (config.forward_to.empty()) return nullptr;
  return std::make_unique<forwarder::Forwarder>(
      app.outbox(), app.revision_intake(tell),
      forwarder::ForwarderOptions{.centre = centre_of(config), .tell = tell});
}

void write_outbox_metrics(const forwarder::Forwarder* forwarder, const Clock& clock,
                          api::Exposition& out) {
  // The metrics exist without a centre too.
  const auto state = forwarder == nullptr ? std::nullopt : std::optional(forwarder->state());
  out.gauge("fitgauge_outbox_rows", "Measurements that have not reached the centre");
  if (state) out.sample(state->rows);
  out.gauge("fitgauge_outbox_oldest_seconds", "Waiting time of the oldest of these measurements");
  if (!state) return;
  const std::int64_t now = clock.now().nanoseconds;
  const std::int64_t oldest = state->oldest ? state->oldest->nanoseconds : now;
  out.sample(std::max(0.0, static_cast<double>(now - oldest) / kNanosecondsPerSecond));
}

}  // namespace fitgauge::daemon
