#include "api/runs/run_posting.hpp"

#include <future>

#include "api/runs/run_codec.hpp"
#include "api/wire/request_facts.hpp"
#include "service/jobs.hpp"

namespace fitgauge::api {
namespace {

using Kind = JsonValue::Kind;

JsonValue text(std::string value) { return {.kind = Kind::String, .text = std::move(value)}; }
JsonValue number(std::int64_t value) {
  return {.kind = Kind::Number, .text = std::to_string(value)};
}

/// Returns the body of a POST with this order.
JsonValue body_of(const std::string& program, const std::string& setup) {
  JsonValue body{.kind = Kind::Object};
  body.members.emplace_back("program", text(program));
  if (!setup.empty()) body.members.emplace_back("setup", text(setup));
  JsonValue limits{.kind = Kind::Object};
  limits.members.emplace_back("blocks", number(kMostBlocks));
  limits.members.emplace_back("seconds", number(static_cast<std::int64_t>(kMostSeconds)));
  body.members.emplace_back("limits", std::move(limits));
  return body;
}

Result<app::RunOrder> read_order(const Services& services, const std::string& program,
                                 const std::string& setup) {
  const auto tables = TRY(services.runs.control_tables());
  return decode_run_order(
      body_of(program, setup),
      [&services](const std::string& name) {
        return services.documents.wait_for(app::DocumentKind::Setup, name);
      },
      *tables);
}

Result<std::shared_ptr<app::ActiveRun>> start(const Services& services,
                                              const interpreter::ControlPath& program,
                                              const std::string& setup) {
  auto order = TRY(read_order(services, program.text(), setup));
  const auto diagnostics = TRY(services.runs.check_program(order.program));
  if (klartext::has_errors(diagnostics, order.options.keeps_unreadable))
    return Error{ErrorCode::ProgramInvalid, program.text() + " or a program it calls has errors"};
  return services.runs.start(std::move(order), std::nullopt,
                             [](const app::ActiveRun&) { return app::Answer{}; });
}

/// The result of `work` as an order.
template <class Work>
auto ordered(const Services& services, const Work& work) {
  std::promise<decltype(work())> promise;
  services.jobs.orders.run(work,
                           [&](decltype(work()) made) { promise.set_value(std::move(made)); });
  return promise.get_future().get();
}

constexpr std::string_view kRuns = "/v1/runs/";

/// Marks the response to a run that is answered before its end.
Response with_preference(Response response) {
  return std::move(response).with("Preference-Applied", "respond-async");
}

/// The answer stored for an Idempotency-Key: of a run that is waited for only the place, since its
/// report never changes.
app::Answer accepted(const app::ActiveRun& run, bool at_once) {
  app::Answer answer{.status = 201, .content_type = {}, .location = {}, .body = {}};
  answer.location = std::string(kRuns) + run.id_text();
  if (!at_once) return answer;
  answer.status = 202;
  answer.content_type = "application/json";
  answer.body = unfinished_run_json(run);
  return answer;
}

void answer_end(const SharedPosting& posting, std::string location,
                const Result<app::FinishedRun>& end) {
  if (!end) return posting->responder.fail(end.error());
  posting->responder.answer(
      api::response_of({201, "application/json", std::move(location), end->report}));
}

void replay(const SharedPosting& posting, app::Answer kept) {
  if (kept.status == 202)
    return posting->responder.answer(with_preference(replayed(std::move(kept))));
  const std::string_view location = kept.location;
  const auto id =
      posting->services.runs.parse_id(location.substr(std::min(kRuns.size(), location.size())));
  if (!id) {
    return posting->responder.fail(
        {ErrorCode::StorageCorrupt, "this Idempotency-Key belongs to a request that is not a run"});
  }
  posting->services.runs.find(
      *id, [posting, kept = std::move(kept)](Result<app::StoredRun> run) mutable {
        if (!run) return posting->responder.fail(run.error());
        if (run->result.empty()) {
          return posting->responder.fail(
              {ErrorCode::IdempotencyInProgress,
               "the first request with this Idempotency-Key is still running: try again soon"});
        }
        kept.content_type = "application/json";
        kept.body = std::move(run->result);
        posting->responder.answer(replayed(std::move(kept)));
      });
}

/// The problem document with the findings of the check.
Response invalid_program(const Request& request, const std::string& program,
                         const std::vector<klartext::Diagnostic>& diagnostics) {
  Response response =
      problem({ErrorCode::ProgramInvalid, program + " or a program that it calls has errors"},
              std::nullopt, request);
  auto& body = std::get<std::string>(response.body);
  body.pop_back();
  body += ",\"diagnostics\":";
  JsonWriter json(body);
  write_diagnostics(json, diagnostics);
  body += '}';
  return response;
}

/// Returns the order of a body whose program may run, or the refusal.
Result<app::RunOrder> read_order(const SharedPosting& posting) {
  auto body = TRY(parse_json(posting->request.body()));
  const auto tables = TRY(posting->services.runs.control_tables());
  auto order = decode_run_order(
      std::move(body),
      [&posting](const std::string& name) {
        return posting->services.documents.wait_for(app::DocumentKind::Setup, name);
      },
      *tables);
  if (!order) return order;
  TRY(posting->services.runs.load_meshes(order->setup, "/setup", app::MissingFiles::Refused));
  order->caller = caller_text(posting->request);
  return order;
}

/// Starts a run, and answers unless the response waits for its end.
Result<void> start(const SharedPosting& posting) {
  app::RunService& runs = posting->services.runs;
  if (posting->scope) {
    auto kept = TRY(runs.kept_answer(*posting->scope));
    if (kept) {
      replay(posting, *std::move(kept));
      return {};
    }
  }
  auto order = TRY(read_order(posting));
  const auto diagnostics = runs.check_program(order.program);
  if (!diagnostics) {
    Error error = diagnostics.error();
    if (error.code == ErrorCode::ProgramUnknown)
      error.details.push_back({error.code, error.message, "/program"});
    return error;
  }
  if (klartext::has_errors(*diagnostics, order.options.keeps_unreadable)) {
    posting->responder.answer(
        invalid_program(posting->request, order.program.text(), *diagnostics));
    return {};
  }
  TRY(runs.check_start(order));
  const bool at_once = prefers_async(posting->request);
  app::Answer answer;  // as stored: a repeat of the request gets the same
  const auto run = TRY(runs.start(std::move(order), posting->scope, [&](const app::ActiveRun& r) {
    return answer = accepted(r, at_once);
  }));
  if (at_once) {
    posting->responder.answer(with_preference(api::response_of(std::move(answer))));
    return {};
  }
  run->on_end([posting, location = std::move(answer.location)](
                  const Result<app::FinishedRun>& end) { answer_end(posting, location, end); });
  return {};
}

}  // namespace

Result<machine::Setup> machine_of_setup(const Services& services, const std::string& name) {
  return ordered(services, [&]() -> Result<machine::Setup> {
    if (!name.empty()) TRY(services.documents.wait_for(app::DocumentKind::Setup, name));
    auto order = TRY(read_order(services, "TNC:\\none.h", name));
    return std::move(order.setup);
  });
}

Result<std::shared_ptr<app::ActiveRun>> start_program(const Services& services,
                                                      const interpreter::ControlPath& program,
                                                      const std::string& setup) {
  return ordered(services, [&] { return start(services, program, setup); });
}

void post_run(const Services& services, const Request& request, Responder responder) {
  const SharedPosting posting = begin_posting(services, request, std::move(responder));
  if (!posting) return;
  services.jobs.orders.run([posting] { return start(posting); },
                           [posting](const Result<void>& started) {
                             if (!started) posting->responder.fail(started.error());
                           });

}  // namespace fitgauge::api

}  // namespace fitgauge::api
