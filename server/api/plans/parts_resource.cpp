#include "api/plans/characteristic_key.hpp"
#include "api/resources.hpp"
#include "base/json/body_forms.hpp"
#include "record/record_members.hpp"
#include "service/documents/document_service.hpp"
#include "service/measurements/measurement_service.hpp"

// A part: the value of each characteristic that was measured last, compared with a plan.

namespace fitgauge::api {
namespace {

using app::NamedDocument;
using gauging::Verdict;

constexpr Words kVerdict{Verdict::Indeterminate};

constexpr std::size_t kMostValues = 10'000;  ///< of one part; older ones are ignored

struct PartValue {
  Candidate candidate{};
  std::optional<std::string> characteristic{};
  std::string measurement{};
  std::optional<Verdict> verdict{};
  std::optional<std::string_view> envelope{};
  Length measured{};
  bool has_note = false;
  bool has_cause = false;  ///< or an action: what a catalogue asks for
};
void members(auto& v, const PartValue& value) {
  v.optional("characteristic", value.characteristic, "Absent if the value names no characteristic");
  v.member("measurement_id", value.measurement, "The record");
  v.member("verdict", value.verdict, kVerdict, "Verdict; null without limits");
  v.optional("envelope_result", value.envelope,
             "verified, not_verified or failed, if the envelope is required");
  v.member("measured_mm", value.measured, Millimetres{});
  v.member("measured_at", value.candidate.measured_at, Time{}, "Time in UTC");
}

/// A characteristic of a plan and its record.
struct Reaction {
  std::string characteristic{};
  std::optional<std::string> reaction{};
  std::string measurement{};
  bool has_catalogue = false;
  bool is_at_each_part = true;  ///< no frequency says otherwise
};
void members(auto& v, const Reaction& open) {
  v.member("characteristic", open.characteristic);
  v.optional("reaction", open.reaction, "Absent if the plan names only a catalogue");
  v.member("measurement_id", open.measurement, "The record that is not good");
}

struct Part {
  std::string part{};
  std::optional<std::string> plan{};
  std::optional<Verdict> verdict{};
  std::vector<std::string> missing{};
  std::vector<PartValue> values{};
  std::vector<Reaction> reactions{};
};
void members(auto& v, const Part& part) {
  v.member("part_id", part.part);
  v.optional("plan", part.plan, "Plan that the part is checked against");
  v.member("verdict", part.verdict, kVerdict,
           "Worst verdict; null if a value is missing or none has limits");
  v.member("missing", part.missing,
           "Characteristics of the plan without a value, in its order; not those with a frequency");
  v.member("characteristics", part.values,
           "Characteristics in the order of the plan, then the others");
  v.member("open_reactions", part.reactions,
           "Reactions that the plan demands and that have no note; with a catalogue, no cause or "
           "action");
}

/// @errors StorageCorrupt.
Result<std::vector<Reaction>> characteristics_of(const NamedDocument& plan) {
  const auto json = TRY(parse_stored_json(plan.text, "plan"));
  std::vector<Reaction> found;
  for (const JsonValue& each : json.find("characteristics")->items) {
    const auto has = [&each](std::string_view name) {
      const JsonValue* text = each.find(name);
      return text != nullptr && !text->text.empty();
    };
    Reaction& one = found.emplace_back(Reaction{.characteristic = each.find("name")->text});
    if (has("reaction")) one.reaction = each.find("reaction")->text;
    one.has_catalogue = has("catalogue");
    one.is_at_each_part = !has("frequency");
  }
  return found;
}

auto place_in(const std::vector<Reaction>& plan, const PartValue& value) {
  return std::ranges::find(plan, value.characteristic, &Reaction::characteristic) - plan.begin();
}

void hold_against(const std::vector<Reaction>& plan, Part& part) {
  std::ranges::stable_sort(part.values, {},
                           [&](const auto& value) { return place_in(plan, value); });
  for (const Reaction& each : plan) {
    bool is_missing = each.is_at_each_part;
    for (const PartValue& value : part.values) {
      if (value.characteristic != each.characteristic) continue;
      is_missing = false;
      if (value.verdict.value_or(Verdict::Good) != Verdict::Good &&
          (each.has_catalogue ? !value.has_cause : each.reaction && !value.has_note)) {
        part.reactions.emplace_back(each).measurement = value.measurement;
      }
    }
    if (is_missing) part.missing.push_back(each.characteristic);
  }
}

/// Compares the part with a plan: the named plan, the plan with the part's name, or the only plan
/// with all measured characteristics. @errors QueryInvalid if the named plan does not exist.
Result<void> plan_part(const std::vector<NamedDocument>& plans,
                       std::optional<std::string_view> named, Part& part) {
  std::vector<std::pair<std::string, std::vector<Reaction>>> fitting;
  const std::string name(named.value_or(part.part));
  for (const NamedDocument& plan : plans) {
    if (named && plan.name != name) continue;
    auto characteristics = TRY(characteristics_of(plan));
    const auto end = std::ssize(characteristics);
    const auto is_planned = [&](const PartValue& value) {
      return place_in(characteristics, value) < end;
    };
    if (plan.name == name) fitting.clear();
    if (plan.name == name || std::ranges::all_of(part.values, is_planned))
      fitting.emplace_back(plan.name, std::move(characteristics));
    if (plan.name == name) break;
  }
  if (named && fitting.empty())
    return Error{ErrorCode::QueryInvalid, fmt::format("plan not found: '{}'", name), "plan"};
  if (fitting.size() != 1) return {};
  part.plan = fitting.front().first;
  hold_against(fitting.front().second, part);
  return {};
}

void judge(Part& part) {
  const auto of = [](const PartValue& value) { return gauging::severity(value.verdict); };
  part.verdict = std::ranges::max_element(part.values, {}, of)->verdict;
  if (part.verdict == Verdict::Good && !part.missing.empty()) part.verdict.reset();
}

PartValue value_of(const app::Measurement& m) {
  PartValue value{.candidate = candidate_of(m),
                  .measurement = app::measurement_id_text(m.id, m.origin),
                  .measured = m.measured,
                  .has_note = !m.notes.empty(),
                  .has_cause = std::ranges::any_of(
                      m.notes, [](const auto& note) { return note.cause || note.measure; })};
  if (m.characteristic) value.characteristic.emplace(*m.characteristic);
  if (m.is_judged()) value.verdict = m.result.verdict;
  if (m.envelope) value.envelope = app::members::envelope_result(m);
  return value;
}

/// @param plan lives until `done` is called
void read_part(const Services& services, std::string_view id, std::optional<std::string_view> plan,
               std::function<void(Result<Part>)> done) {
  const auto part = std::make_shared<Part>(Part{.part = std::string(id)});
  app::MeasurementQuery query;
  query.texts.at(app::filter_place(1)) = part->part;
  query.newest_first = query.shows_notes = true;
  services.measurements.list(
      query, 0, kMostValues,
      [part](const app::Measurement& m) { part->values.push_back(value_of(m)); },
      [&services, part, plan, done = std::move(done)](const Result<app::ListPage>& page) {
        if (!page) return done(page.error());
        if (part->values.empty()) {
          return done(Error::of(ErrorCode::MeasurementUnknown, "no measurement has part_id '{}'",
                                part->part));
        }
        std::ranges::reverse(part->values);
        choose(part->values);
        std::erase_if(part->values, [](const auto& value) { return !value.candidate.counts; });
        services.documents.list(
            app::DocumentKind::Plan,
            [part, plan, done](const Result<std::vector<NamedDocument>>& plans) {
              if (!plans) return done(plans.error());
              const auto planned = plan_part(*plans, plan, *part);
              if (!planned) return done(planned.error());
              judge(*part);
              done(std::move(*part));
            });
      });
}

void get_part(const Services& services, const Request& request, Responder responder) {
  read_part(services, *request.text("part"), request.text("plan"),
            answer_with(std::move(responder),
                        [](const Part& part) { return json_response(body_json(part)); }));
}

}  // namespace

void find_plan_of(const Services& services, std::string_view part,
                  std::function<void(Result<PlanOfPart>)> done) {
  read_part(services, part, {}, [done = std::move(done)](const Result<Part>& found) {
    if (found) return done(PlanOfPart{.plan = found->plan, .missing = found->missing});
    if (found.error().code == ErrorCode::MeasurementUnknown) return done(PlanOfPart());
    done(found.error());
  });
}

void add_parts_schemas(Schemas& schemas) { schemas.push_back(answer_schema<Part>("Part")); }

void add_parts_routes(Routes& add) {
  add("GET /v1/parts/{part*} getPart viewer 404", get_part,
      {.summary = "A part: its verdict, what is missing, its values and open reactions",
       .description = "The value of each characteristic that was measured last, with corrections; "
                      "the verdict is the worst of them. A value without a characteristic is "
                      "listed by itself; a value without limits replaces no other value. A value "
                      "whose GO gauge failed also counts until this gauge passes. Without `plan` "
                      "the plan with the name of the part is used, or the only plan that has every "
                      "measured characteristic; without a plan nothing is missing.",
       .parameters = {path_parameter("part", "part_id of its measurements"),
                      query("plan", "Part number of the plan to hold it against")},
       .outcomes = {{.meaning = "The part", .schema = "Part"}}});
}

}  // namespace fitgauge::api
