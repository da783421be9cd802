#include "node.hpp"

#include "api/runs/run_codec.hpp"
#include "api/services.hpp"
#include "base/gzip.hpp"
#include "base/json/json_value.hpp"
#include "base/json/json_writer.hpp"
#include "base/thread.hpp"
#include "service/log/station_texts.hpp"

namespace fitgauge::simulation {
namespace {

using app::Application;

/// The answer to a request with one measurement: its id.
class IdAnswer final : public app::Rendering {
 public:
  void add(std::span<const app::Measurement> measurements, std::string_view) override {
    id_ = app::measurement_id_text(measurements.front().id, measurements.front().origin);
  }
  app::Answer finish() override {
    return {.status = 201, .content_type = "text/plain", .location = {}, .body = id_};
  }

 private:
  std::string id_;
};

std::string unpacked(const std::string& packed) {
  GzipReader reader(packed);
  std::string all;
  for (;;) {
    const auto piece = reader.next();
    if (!piece || piece->empty()) return all;
    all += *piece;
  }
}

void write_head(api::JsonWriter& json, const app::LogIntake::Head& head) {
  json.begin_object()
      .member("size", head.size)
      .member("root", tlog::to_base64(head.root))
      .end_object();
}

Reply refused(const Error& error, int status) {
  std::string body;
  api::JsonWriter(body)
      .begin_object()
      .member("code", id(error.code))
      .member("detail", error.message)
      .end_object();
  return {.status = status, .body = body};
}

/// As api/log/station_resource.cpp.
Reply take_batch(Application& app, std::string_view origin, std::int64_t from,
                 const std::string& body) {
  const auto batch = api::read_batch(origin, from, body);
  if (!batch) return refused(batch.error(), api::status_of(batch.error().code));
  const auto answer = app.intake().take((*batch)->batch);
  if (!answer) {
    const bool is_forked = answer.error().code == ErrorCode::LogForked;
    return refused(answer.error(), is_forked ? 409 : api::status_of(answer.error().code));
  }
  Reply reply;
  api::JsonWriter json(reply.body);
  if (answer->outcome == app::LogIntake::Outcome::Taken) {
    write_head(json, answer->head);
    return reply;
  }
  const bool is_forked = answer->outcome == app::LogIntake::Outcome::Forked;
  reply.status = 409;
  json.begin_object().member("code", is_forked ? "log.forked" : "log.position").key("head");
  write_head(json, answer->head);
  json.end_object();
  return reply;
}

app::IdempotencyScope scope_of(const std::string& path, const std::string& body) {
  return {.caller = "mes", .method = "POST", .path = path, .key = "key-" + body, .body = body};
}

Result<std::optional<app::Answer>> kept_answer(app::MeasurementService& measurements,
                                               const app::IdempotencyScope& scope) {
  return wait_for_result<std::optional<app::Answer>>(
      [&](auto done) { measurements.find_answer(scope, std::move(done)); });
}

/// As RFC 9162, 2.1.3.2, has it computed from an inclusion proof; none: it is too short or long.
std::optional<tlog::Hash> root_by(const app::LogService::Proof& proof) {
  tlog::TreeHasher hasher;
  tlog::Hash root = proof.leaf;
  std::uint64_t node = proof.index;
  std::uint64_t last = proof.head->checkpoint.size - 1;
  for (const tlog::Hash& beside : proof.path) {
    if (last == 0) return std::nullopt;
    const bool is_left = node % 2 == 0 && node != last;
    root = is_left ? hasher.node(root, beside) : hasher.node(beside, root);
    while (!is_left && node % 2 == 0 && node != 0) {
      node /= 2;
      last /= 2;
    }
    node /= 2;
    last /= 2;
  }
  return last == 0 ? std::optional(root) : std::nullopt;
}

std::string parameter(std::string_view query, std::string_view name) {
  const std::string key = fmt::format("{}=", name);
  const std::size_t at = query.find(key);
  if (at == query.npos) return {};
  const std::string_view rest = query.substr(at + key.size());
  return std::string(rest.substr(0, rest.find('&')));
}

}  // namespace

struct Node::Up {
  Up(Node& node) : clock(machine_clock, ForwardClock::running_time, teller(node)) {}

  static std::function<void(std::string_view, const std::string&)> teller(Node& node) {
    return [&node](std::string_view event, const std::string& detail) {
      node.told.push_back(
          fmt::format("{:.3f} {}: {}", static_cast<double>(world_now()) / kSecond, event, detail));
    };
  }

  SystemClock machine_clock;
  ForwardClock clock;
  std::unique_ptr<Application> app;
  std::unique_ptr<api::GaugesInUse> gauges;
  std::unique_ptr<forwarder::Forwarder> forwarder;
  std::unique_ptr<connections::Connections> connections;  // ends first
};

Node::Node(std::string name, std::filesystem::path where, std::string centre, std::string receiver)
    : folder(std::move(where)), centre_(std::move(centre)), receiver_(std::move(receiver)) {
  machine.name = std::move(name);
  std::filesystem::create_directories(folder);
}
Node::~Node() { end(); }

bool Node::start() {
  const On on(&machine);
  auto up = std::make_unique<Up>(*this);
  const auto tell = Up::teller(*this);
  app::ApplicationOptions options;
  options.directory = folder;
  options.origin_name = machine.name;
  options.readers = 1;
  options.run_workers = 1;
  options.has_centre = !centre_.empty();
  options.steady_time = [clock = &up->clock] { return clock->steady(); };
  options.log_told = tell;
  options.health_changed = [tell](const store::Health& health) {
    tell(word(health.state), health.reason);
  };
  options.job_threw = [tell](const Error& bug) { tell("job_threw", bug.message); };
  const forwarder::CentreOptions there{.url = "http://" + centre_};
  if (!centre_.empty()) {
    options.ask_centre = [there](std::string_view digits) -> std::optional<app::AtCentre> {
      const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(3);
      forwarder::CentreLink link(there);
      const auto answer = link.get(fmt::format("/v1/log/revisions?station={}", digits),
                                   [until] { return std::chrono::steady_clock::now() < until; });
      const auto read = api::read_revisions(answer.status == 200 ? answer.body : "");
      if (!read) return std::nullopt;
      return app::AtCentre{.centre = (*read)->page.origin,
                           .rows = (*read)->page.size,
                           .note = (*read)->page.notes.value_or(0),
                           .is_branched = (*read)->page.is_branched};
    };
  }
  const auto failed = [&](const Error& error) {
    tell("not_started", error.message);
    return false;
  };
  auto opened = Application::open(options, up->clock);
  if (!opened) return failed(opened.error());
  up->app = *std::move(opened);
  const auto newest = up->app->newest_measurement();
  if (newest && *newest) up->clock.begin_after(**newest);
  if (const auto runs = up->app->runs().open(api::run_format()); !runs) return failed(runs.error());
  up->gauges = std::make_unique<api::GaugesInUse>(up->app->documents());
  if (const auto loaded = up->gauges->load(); !loaded) return failed(loaded.error());
  std::vector<connections::Definition> configured;
  const auto body = parse_json(fmt::format(
      R"({{"kind":"webhook","url":"http://{}/hook","start":"beginning","longest_wait_s":5,)"
      R"("secrets":["whsec_MDEyMzQ1Njc4OTAxMjM0NTY3ODkwMTIzNDU2Nzg5MDE="]}})",
      receiver_));
  auto definition = connections::read_definition("mes", *body, {});
  if (!definition) return failed(definition.error());
  configured.push_back(*std::move(definition));
  const auto mqtt = parse_json(fmt::format(
      R"({{"kind":"mqtt","broker":"mqtt://{}-broker","topic":"plant/measured","start":"beginning",)"
      R"("longest_wait_s":5}})",
      machine.name));
  auto publisher = connections::read_definition("line", *mqtt, {});
  if (!publisher) return failed(publisher.error());
  configured.push_back(*std::move(publisher));
  Application& app = *up->app;
  auto connected = connections::Connections::start(std::move(configured),
                                                   {.measurements = app.measurements(),
                                                    .events = app.events(),
                                                    .documents = app.documents(),
                                                    .files = app.files(),
                                                    .tables = app.tables(),
                                                    .gauges = *up->gauges,
                                                    .clock = up->clock,
                                                    .origin = std::string(app.log().origin()),
                                                    .may_reach_private = true,
                                                    .tell = tell});
  if (!connected) return failed(connected.error());
  up->connections = *std::move(connected);
  if (!centre_.empty()) {
    up->forwarder = std::make_unique<forwarder::Forwarder>(
        app.outbox(), app.revision_intake(tell),
        forwarder::ForwarderOptions{.centre = there, .tell = tell});
  }
  up_ = std::move(up);
  return true;
}

void Node::end() {
  if (!up_) return;
  const On on(&machine);
  const std::unique_ptr<Up> ending = std::move(up_);
  while (guests_ > 0) sleep_for(kMillisecond);
  ending->app->jobs().call_off();
  ending->app->runs().stop();
}

std::optional<std::string> Node::add_note(const std::string& text, const std::string& of) {
  if (!up_ || up_->app->log().forked()) return std::nullopt;
  const On on(&machine);
  auto& measurements = up_->app->measurements();
  const auto name = measurements.parse_id(of);
  if (!name) return std::nullopt;
  const auto scope = scope_of("/v1/measurements/" + of + "/notes", text);
  auto answer = kept_answer(measurements, scope);
  if (!answer) return std::nullopt;
  if (!*answer) {
    answer = wait_for_result<app::Answer>([&](auto done) {
      measurements.add_note(*name, {.text = text, .received_at = up_->clock.now()}, scope,
                            std::move(done));
    });
  }
  const auto note = answer ? parse_json((*answer)->body) : Result<JsonValue>(answer.error());
  return note ? std::optional(note->member("id").text) : std::nullopt;
}

std::map<std::string, std::string> Node::notes(const std::string& of) {
  const On on(&machine);
  std::map<std::string, std::string> found;
  auto& measurements = up_->app->measurements();
  const auto name = measurements.parse_id(of);
  if (!name) return found;
  const auto listed = wait_for_result<std::vector<app::Note>>(
      [&](auto done) { measurements.list_notes(*name, std::move(done)); });
  if (!listed) return found;
  for (const app::Note& note : *listed) found.emplace(note.id, note.text.value_or(""));
  return found;
}

std::optional<std::string> Node::post(const std::string& part, const std::string& of) {
  if (!up_ || up_->app->log().forked()) return std::nullopt;
  const On on(&machine);
  auto& measurements = up_->app->measurements();
  std::string digits;
  app::Measurement m;
  m.nominal_size = Length::millimetres(25);
  m.deviations = {.upper = Length::micrometres(50), .lower = Length()};
  m.basis = app::LimitsBasis::Explicit;
  m.measured = m.nominal_size + Length::nanometres(static_cast<std::int64_t>(part.size()) * 1000);
  m.part_id = part;
  m.received_at = m.measured_at = up_->clock.now();
  judge(m);
  const auto scope = scope_of("/v1/measurements", part);
  const auto kept = kept_answer(measurements, scope);
  if (!kept) return std::nullopt;
  if (*kept) return (*kept)->body;
  if (!of.empty()) {
    const auto name = measurements.parse_id(of);
    if (!name) return std::nullopt;
    const std::string_view own = up_->app->log().origin();
    const auto found = wait_for_result<std::int64_t>([&](auto done) {
      measurements.find(
          *name,
          [&](const app::Measurement& original) {
            m.correction_of = original.id;
            if (original.origin == own) return;
            digits = original.origin;
            m.corrected_elsewhere = {
                .row = original.row, .origin = original.origin_number, .digits = digits};
          },
          std::move(done));
    });
    if (!found) return std::nullopt;
    m.correction_reason = "misread";
  }
  const auto answer = wait_for_result<app::Answer>([&](auto done) {
    measurements.record(
        {m}, scope, [] { return std::make_unique<IdAnswer>(); }, std::move(done));
  });
  if (!answer) return std::nullopt;
  return answer->body;
}

std::optional<std::vector<Listed>> Node::list(const std::string& after) {
  if (!up_) return std::nullopt;
  const On on(&machine);
  app::MeasurementQuery query;
  query.source.reset();
  query.history = true;
  auto& measurements = up_->app->measurements();
  if (!after.empty()) {
    const auto name = measurements.parse_id(after);
    if (!name) return std::nullopt;
    query.after = *name;
  }
  std::vector<Listed> all;
  const auto page = wait_for_result<app::ListPage>([&](auto done) {
    measurements.list(
        query, 0, 1'000'000,
        [&all](const app::Measurement& m) {
          auto& listed = all.emplace_back(Listed{.id = app::measurement_id_text(m.id, m.origin),
                                                 .part = std::string(m.part_id.value_or(""))});
          if (!m.correction_of) return;
          listed.corrects = app::measurement_id_text(
              *m.correction_of, m.corrected_elsewhere ? m.corrected_elsewhere->digits : m.origin);
        },
        std::move(done));
  });
  if (!page) return std::nullopt;
  return all;
}

bool Node::backup(const std::filesystem::path& file) {
  const On on(&machine);
  return up_ && up_->app->backup(file).has_value();
}

std::string Node::head() { return up_->app->log().head()->note; }

std::string Node::prove(const std::string& id) {
  const On on(&machine);
  const auto name = up_->app->measurements().parse_id(id);
  if (!name) return name.error().message;
  const auto proof = wait_for_result<app::LogService::Proof>(
      [&](auto done) { up_->app->log().prove(*name, std::move(done)); });
  if (!proof) return proof.error().message;
  return root_by(*proof) == proof->head->checkpoint.root ? "" : "it is of another root";
}

std::vector<std::string> Node::verify(const std::map<std::string, std::string>& notes) {
  const On on(&machine);
  const auto verified = up_->app->verify(notes);
  return verified ? verified->findings : std::vector{verified.error().message};
}

bool Node::is_quiet() {
  if (!up_) return false;
  for (const auto& state : up_->connections->states()) {
    if (state.behind > 0 || state.is_failing || state.attempt_began_at) return false;
  }
  return !up_->forwarder ||
         (up_->forwarder->state().rows == 0 && up_->forwarder->state().failure.empty());
}

std::string Node::state() {
  if (!up_) return "down";
  std::string text;
  for (const auto& state : up_->connections->states()) {
    text += fmt::format("{} at {}, {} behind, {} refused, {} attempts, {} failed, last '{}'; ",
                        state.name, state.position.value_or(-1), state.behind, state.refused,
                        state.attempts, state.failures, state.last_error);
  }
  if (up_->forwarder) {
    const auto forwarding = up_->forwarder->state();
    text += fmt::format("{} rows to forward, '{}'; ", forwarding.rows, forwarding.failure);
  }
  for (const Error& finding : up_->app->readiness().findings)
    text += fmt::format("not ready: {}; ", finding.message);
  return text;
}

bool Node::is_ready() { return up_ && up_->app->readiness().findings.empty(); }

std::optional<Reply> Node::answer(const Exchange& exchange) {
  if (!up_ || machine.is_dead) return std::nullopt;
  const On on(&machine);
  Application& app = *up_->app;
  ++guests_;
  const auto done = [this](Reply reply) -> std::optional<Reply> {
    --guests_;
    return machine.is_dead ? std::nullopt : std::optional(std::move(reply));
  };
  const std::string_view path = exchange.path;
  if (exchange.method == "GET") {
    const auto page = wait_for_result<app::RevisionPage>([&](auto answered) {
      app.revisions().read(parameter(path, "station"), parameter(path, "after"), answered);
    });
    if (!page) return done(refused(page.error(), api::status_of(page.error().code)));
    return done({.status = 200, .body = api::revisions_text(*page)});
  }
  const std::string_view place = path.substr(std::string_view("/v1/log/").size());
  const std::size_t slash = place.find('/');
  std::int64_t from = 0;
  std::from_chars(place.data() + slash + 1, place.data() + place.size(), from);
  return done(take_batch(app, place.substr(0, slash), from, unpacked(exchange.body)));
}

}  // namespace fitgauge::simulation
