#include "base/json/field_reader.hpp"

namespace fitgauge::api {
namespace {

bool has_word(std::string_view words, std::string_view word) {
  return fmt::format(" {} ", words).find(fmt::format(" {} ", word)) != std::string::npos;
}

}  // namespace

std::string listed(std::string_view words) {
  std::string text(take_field(words, ' '));
  while (!words.empty()) {
    const std::string_view word = take_field(words, ' ');
    text.append(words.empty() ? " or " : ", ").append(word);
  }
  return text;
}

std::optional<std::string> not_applicable(const Applicable& row, std::string_view what,
                                          std::string_view kind) {
  if (has_word(row.kinds, kind)) return std::nullopt;
  return fmt::format("{}{}{} has no effect with {} {}: it belongs to {} {}", row.member,
                     row.values.empty() ? "" : " ", row.values, what, kind, what,
                     listed(row.kinds));
}

using Kind = JsonValue::Kind;

void FieldErrors::add(ErrorCode code, std::string pointer, std::string message,
                      std::optional<std::size_t> line) {
  if (++count_ > kMostListed) return;
  Error& entry = entries_.emplace_back(Error{code, std::move(message), std::move(pointer)});
  if (line) entry.details.push_back({code, {}, std::to_string(*line)});
}

bool FieldErrors::has(std::string_view pointer) const {
  return std::any_of(entries_.begin(), entries_.end(),
                     [pointer](const Error& entry) { return entry.where == pointer; });
}

void FieldErrors::rollback(Mark mark) {
  count_ = mark;
  entries_.resize(std::min(entries_.size(), mark));
}

std::optional<Error> FieldErrors::take() {
  if (empty()) return std::nullopt;
  return listed(ErrorCode::RequestInvalid, std::move(entries_), count_);
}

FieldReader::FieldReader(const JsonValue& object, std::string pointer, FieldErrors& errors)
    : object_(object), pointer_(std::move(pointer)), errors_(errors) {
  if (!object.is(Kind::Object)) {
    errors_.add(ErrorCode::FieldType, pointer_,
                fmt::format("must be an object; got {}", name_of(object.kind)));
  }
}

void FieldReader::report(ErrorCode code, std::string_view name, std::string message) {
  errors_.add(code, at(name), std::move(message));
}

const JsonValue* FieldReader::take(std::string_view name, bool required) {
  known_.push_back(name);
  const JsonValue* value = object_.find(name);
  if (value == nullptr && required && object_.is(Kind::Object))
    report(ErrorCode::FieldMissing, name, "{} is required", name);
  return value;
}

const JsonValue* FieldReader::take(std::string_view name, bool required,
                                   std::initializer_list<Kind> kinds, std::string_view wanted) {
  const JsonValue* value = take(name, required);
  if (value == nullptr || std::find(kinds.begin(), kinds.end(), value->kind) != kinds.end())
    return value;
  report(ErrorCode::FieldType, name, "{} must be {}; got {}", name, wanted, name_of(value->kind));
  return nullptr;
}

std::optional<Length> FieldReader::length(std::string_view name, bool micrometres) {
  const JsonValue* value =
      take(name, true, {Kind::Number, Kind::String}, "a number or a string with one");
  if (value == nullptr) return std::nullopt;
  const DecimalSyntax syntax{.exponent = value->is(Kind::Number)};
  const auto parsed =
      micrometres ? parse_length_um(value->text, syntax) : parse_length_mm(value->text, syntax);
  if (parsed) return *parsed;
  report(parsed.error().code, name, parsed.error().message);
  return std::nullopt;
}

std::optional<Length> FieldReader::mm(std::string_view name) { return length(name, false); }

std::optional<Length> FieldReader::um(std::string_view name) { return length(name, true); }

std::optional<double> FieldReader::number(std::string_view name) {
  const JsonValue* value = take(name, true, {Kind::Number}, "a number");
  if (value == nullptr) return std::nullopt;
  const auto parsed = read_number<double>(value->text);
  if (parsed && std::isfinite(*parsed)) return parsed;
  report(ErrorCode::NumberOutOfRange, name, "{} is out of range", name);
  return std::nullopt;
}

std::optional<bool> FieldReader::boolean(std::string_view name) {
  const JsonValue* value = take(name, true, {Kind::Boolean}, "true or false");
  return value == nullptr ? std::nullopt : std::optional(value->boolean);
}

std::optional<std::string> FieldReader::text(std::string_view name) {
  const JsonValue* value = take(name, true, {Kind::String}, "a string");
  return value == nullptr ? std::nullopt : std::optional(value->text);
}

const JsonValue* FieldReader::array(std::string_view name) {
  return take(name, true, {Kind::Array}, "an array");
}

const JsonValue* FieldReader::any(std::string_view name) { return take(name, true); }

const JsonValue* FieldReader::object(std::string_view name) {
  return take(name, true, {Kind::Object}, "an object");
}

std::optional<std::int64_t> FieldReader::integer(std::string_view name, std::int64_t least,
                                                 std::int64_t most) {
  const JsonValue* value = take(name, true, {Kind::Number}, "a whole number");
  if (value == nullptr) return std::nullopt;
  const auto parsed = read_number<std::int64_t>(value->text);
  if (parsed && *parsed >= least && *parsed <= most) return parsed;
  report(ErrorCode::FieldInvalid, name, "{} must be a whole number from {} to {}", name, least,
         most);
  return std::nullopt;
}

std::int64_t FieldReader::integer_or(std::string_view name, std::int64_t fallback,
                                     std::int64_t least, std::int64_t most) {
  if (has(name)) return integer(name, least, most).value_or(fallback);
  known_.push_back(name);
  return fallback;
}

std::optional<std::string> FieldReader::optional_text(std::string_view name) {
  const JsonValue* value = take(name, false, {Kind::String}, "a string");
  return value == nullptr ? std::nullopt : std::optional(value->text);
}

const JsonValue* FieldReader::optional(std::string_view name) { return take(name, false); }

void FieldReader::refuse_not_applicable(std::span<const Applicable> table, std::string_view what,
                                        std::string_view kind) {
  api::refuse_not_applicable(
      table, what, kind, [this](const Applicable& row) { return has(row.member); },
      [this](std::string_view member, std::string message) {
        report(ErrorCode::FieldConflict, member, std::move(message));
      });
}

void FieldReader::refuse_unknown() {
  for (const auto& [name, value] : object_.members) {
    if (std::find(known_.begin(), known_.end(), name) == known_.end())
      report(ErrorCode::FieldUnknown, name, "unknown field {}", name);
  }
}

}  // namespace fitgauge::api
