#include "api/statistics/computation.hpp"

#include "service/jobs.hpp"

namespace fitgauge::api {
namespace {

using Kind = JsonValue::Kind;
using metrology::Decimals;
using metrology::Exact;
using metrology::Groups;
using metrology::Subgroups;

bool is_decimal(const JsonValue& value) { return value.is(Kind::Number) || value.is(Kind::String); }

void report_type(const JsonValue& value, std::string pointer, FieldErrors& errors) {
  errors.add(
      ErrorCode::FieldType, std::move(pointer),
      fmt::format("must be a number, or a string with a number; got {}", name_of(value.kind)));
}

void read_items(const JsonValue& array, const std::string& pointer, Decimals& to,
                FieldErrors& errors) {
  if (array.items.empty()) errors.add(ErrorCode::StatisticsTooFew, pointer, "there is no value");
  for (std::size_t i = 0; i < array.items.size(); ++i)
    add_exact(array.items[i], pointer_to(pointer, i), to, errors);
}

}  // namespace

void add_exact(const JsonValue& value, const std::string& pointer, Decimals& to,
               FieldErrors& errors) {
  if (!is_decimal(value)) return report_type(value, pointer, errors);
  if (value.is(Kind::String) && value.text.find_first_of("eE") != std::string::npos) {
    errors.add(
        ErrorCode::NumberMalformed, pointer,
        fmt::format("'{}' has an exponent: write a plain decimal such as 25.013, or a JSON number",
                    first_characters(value.text, 40)));
    return;
  }
  if (const auto added = to.add(value.text); !added)
    errors.add(added.error().code, pointer, added.error().message);
}

bool ExactNumber::read(FieldReader& fields, std::string_view name, Exact& to) const {
  const JsonValue* value = fields.any(name);
  if (value == nullptr) return false;
  Decimals one;
  const FieldErrors::Mark before = fields.errors().mark();
  add_exact(*value, fields.at(name), one, fields.errors());
  if (fields.errors().mark() != before) return false;
  to = one[0];
  return true;
}

bool PositiveExact::read(FieldReader& fields, std::string_view name, Exact& to) const {
  if (!ExactNumber().read(fields, name, to)) return false;
  if (to <= 0) fields.report(code, name, std::string(refusal));
  return to > 0;
}

bool ExactNumbers::read(FieldReader& fields, std::string_view name, Decimals& to) const {
  const JsonValue* array = fields.array(name);
  if (array != nullptr) read_items(*array, fields.at(name), to, fields.errors());
  return array != nullptr;
}

bool ExactGroups::read(FieldReader& fields, std::string_view name, Groups& to) const {
  const JsonValue* array = fields.array(name);
  if (array == nullptr) return false;
  FieldErrors& errors = fields.errors();
  const std::string pointer = fields.at(name);
  for (std::size_t i = 0; i < array->items.size(); ++i) {
    const JsonValue& group = array->items[i];
    const std::string place = pointer_to(pointer, i);
    if (!group.is(Kind::Array)) {
      errors.add(ErrorCode::FieldType, place,
                 fmt::format("must be an array of values; got {}", name_of(group.kind)));
      continue;
    }
    read_items(group, place, to.values, errors);
    to.ends.push_back(to.values.size());
  }
  if (array->items.empty())
    errors.add(ErrorCode::StatisticsTooFew, pointer, "give one group of values or more");
  return true;
}

bool ExactSubgroups::read(FieldReader& fields, std::string_view name, Subgroups& to) const {
  if (fields.has("values"))
    fields.report(ErrorCode::FieldConflict, name, "give values or subgroups, not both");
  FieldErrors& errors = fields.errors();
  const FieldErrors::Mark before = errors.mark();
  Groups groups;
  if (!ExactGroups().read(fields, name, groups) || errors.mark() != before) return false;
  const std::size_t size = groups.ends.front();
  const metrology::GroupedCounts counts = groups.counts();
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i].size() == size && size > 1) continue;
    errors.add(
        size > 1 ? ErrorCode::StatisticsUnbalanced : ErrorCode::StatisticsTooFew,
        pointer_to(fields.at(name), i),
        size > 1
            ? fmt::format("all subgroups must have the same size: {} values here, {} in the first",
                          counts[i].size(), size)
            : "a subgroup must have two values or more; send single values as values");
    return false;
  }
  to = {.values = std::move(groups.values), .size = size};
  return true;
}

Error at_member(std::string_view name, Error error) {
  FieldErrors errors;
  errors.add(error.code, pointer_to("", name), std::move(error.message));
  return *errors.take();
}

void add_computation(Routes& add, const Computation& computation) {
  const auto handler = [&services = add.services, compute = computation.compute](
                           const Request& request, Responder responder) {
    services.jobs.figures_of(request.body().size())
        .run(
            [compute, &request]() -> Result<Response> {
              auto body = parse_json(request.body());
              if (!body) {
                Error error = body.error();
                if (error.code == ErrorCode::BodyTooLarge)
                  error.message.append(": ").append(kOfManyValues);
                return error;
              }
              return json_response(compute(*body));
            },
            answer_by(share(std::move(responder))));
  };
  add(fmt::format("POST {} viewer", computation.head), handler,
      {.summary = computation.summary,
       .description = computation.description,
       .body = {.use = http::BodyUse::Required,
                .media_types = {"application/json"},
                .limit = kLargestValuesBody,
                .when_too_large = std::string(kOfManyValues),
                .schema = computation.reads},
       .outcomes = {{.meaning = "Computed figures", .schema = computation.answers}}});
}

}  // namespace fitgauge::api
