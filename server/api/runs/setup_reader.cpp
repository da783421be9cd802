#include "api/runs/setup_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "api/files/file_path.hpp"

namespace fitgauge::api {
namespace {

/// Lengths or plain numbers, as many as there is room for.
void read_elements(const JsonValue& array, const std::string& pointer, std::span<double> values,
                   bool lengths, FieldErrors& errors) {
  if (array.items.size() != values.size()) {
    return errors.add(
        ErrorCode::FieldInvalid, pointer,
        fmt::format("{} numbers are wanted, not {}", values.size(), array.items.size()));
  }
  // The elements as members of an object, whose names are then the tokens of their pointers.
  JsonValue object{.kind = JsonValue::Kind::Object};
  for (std::size_t i = 0; i < values.size(); ++i) {
    object.members.emplace_back(std::to_string(i), array.items[i]);
  }
  FieldReader element(object, pointer, errors);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string& index = object.members[i].first;
    if (!lengths) {
      if (const auto value = element.number(index)) values[i] = *value;
    } else if (const auto length = element.mm(index)) {
      values[i] = length->to_mm();
    }
  }
}

}  // namespace

void SetupReader::mm(SetupMember member, double& value) {
  if (fields_.has(member.name)) required_mm(member, value);
}

void SetupReader::mm(SetupMember member, std::optional<double>& value) {
  if (!fields_.has(member.name)) return;
  if (const auto length = fields_.mm(member.name)) value = length->to_mm();
}

void SetupReader::required_mm(SetupMember member, double& value) {
  if (const auto length = fields_.mm(member.name)) value = length->to_mm();
}

void SetupReader::um(SetupMember member, double& value) {
  if (!fields_.has(member.name)) return;
  constexpr double kMicrometres = 1000;
  if (const auto length = fields_.um(member.name)) {
    value = static_cast<double>(length->count()) / kMicrometres;
  }
}

void SetupReader::number(SetupMember member, double& value) {
  value = fields_.number_or(member.name, value);
}

void SetupReader::number(SetupMember member, std::optional<double>& value) {
  if (fields_.has(member.name)) value = fields_.number(member.name);
}

void SetupReader::integer(SetupMember member, int& value, int least, int most) {
  value = static_cast<int>(fields_.integer_or(member.name, value, least, most));
}

void SetupReader::required_integer(SetupMember member, int& value, int least, int most) {
  if (!fields_.has(member.name)) fields_.number(member.name);  // reports it as missing
  integer(member, value, least, most);
}

void SetupReader::seed(SetupMember member, std::uint64_t& value) {
  value = static_cast<std::uint64_t>(fields_.integer_or(
      member.name, static_cast<std::int64_t>(value), 0, std::numeric_limits<std::int64_t>::max()));
}

void SetupReader::boolean(SetupMember member, bool& value) {
  value = fields_.boolean_or(member.name, value);
}

void SetupReader::text(SetupMember member, std::string& value) {
  if (auto given = fields_.optional_text(member.name)) value = *std::move(given);
}

void SetupReader::required_file(SetupMember member, std::string& path) {
  const auto given = fields_.text(member.name);
  if (!given) return;
  const auto parsed = parse_file_path(*given);
  if (!parsed) return fields_.report(parsed.error().code, member.name, parsed.error().message);
  path = parsed->text();
}

void SetupReader::word(SetupMember member, std::span<const std::string_view> words,
                       std::size_t& index) {
  const auto given = fields_.optional_text(member.name);
  if (!given) return;
  const auto found = std::find(words.begin(), words.end(), *given);
  if (found != words.end()) {
    index = static_cast<std::size_t>(found - words.begin());
  } else {
    fields_.report(ErrorCode::FieldInvalid, member.name,
                   fmt::format("{} takes \"{}\"", member.name, fmt::join(words, "\" or \"")));
  }
}

void SetupReader::words(SetupMember member, std::span<const std::string_view> words,
                        std::span<bool> chosen) {
  const JsonValue* const array = fields_.has(member.name) ? fields_.array(member.name) : nullptr;
  if (array == nullptr) return;
  std::fill(chosen.begin(), chosen.end(), false);
  for (const JsonValue& item : array->items) {
    const auto found = item.is(JsonValue::Kind::String)
                           ? std::find(words.begin(), words.end(), item.text)
                           : words.end();
    if (found == words.end()) {
      return fields_.report(
          ErrorCode::FieldInvalid, member.name,
          fmt::format("{} takes a list of \"{}\"", member.name, fmt::join(words, "\", \"")));
    }
    chosen[static_cast<std::size_t>(found - words.begin())] = true;
  }
}

void SetupReader::elsewhere(SetupMember member, std::string (*)()) {
  fields_.optional(member.name);
}

void SetupReader::mm(SetupMember member, std::span<double> values) { optional_mm(member, values); }

void SetupReader::required_mm(SetupMember member, std::span<double> values) {
  if (!fields_.has(member.name)) fields_.array(member.name);  // reports it as missing
  optional_mm(member, values);
}

void SetupReader::numbers(SetupMember member, std::span<double> values) {
  if (!fields_.has(member.name)) return;
  const JsonValue* const array = fields_.array(member.name);
  if (array != nullptr) read_elements(*array, at(member.name), values, false, errors_);
}

bool SetupReader::optional_mm(SetupMember member, std::span<double> values) {
  if (!fields_.has(member.name)) return false;
  const JsonValue* const array = fields_.array(member.name);
  if (array != nullptr) read_elements(*array, at(member.name), values, true, errors_);
  return array != nullptr;
}

void SetupReader::required_mm(SetupMember member, std::vector<machine::Vec3>& points) {
  const JsonValue* const array = fields_.array(member.name);
  if (array == nullptr) return;
  for (std::size_t i = 0; i < array->items.size(); ++i) {
    const std::string pointer = pointer_to(at(member.name), i);
    const JsonValue& item = array->items[i];
    if (!item.is(JsonValue::Kind::Array)) {
      errors_.add(ErrorCode::FieldType, pointer,
                  fmt::format("an array is wanted, not {}", name_of(item.kind)));
      continue;
    }
    std::array<double, 3> point{};
    read_elements(item, pointer, point, true, errors_);
    points.push_back({point[0], point[1], point[2]});
  }
}

void SetupReader::object(SetupMember member, std::string_view, const Read& read) {
  if (!fields_.has(member.name)) return;
  const JsonValue* const value = fields_.object(member.name);
  if (value == nullptr) return;
  SetupReader reader(*value, at(member.name), errors_);
  read(reader);
}

void SetupReader::one_of(SetupMember member, std::span<const Kind> kinds,
                         const std::function<void(std::size_t, SetupFields&)>& read) {
  const auto word = fields_.text(member.name);
  for (std::size_t i = 0; word && i < kinds.size(); ++i) {
    if (kinds[i].word == *word) return read(i, *this);
  }
  if (word) {
    std::string all(kinds.front().word);
    for (const Kind& kind : kinds.subspan(1)) {
      all += &kind == &kinds.back() ? " or " : ", ";
      all += kind.word;
    }
    fields_.report(ErrorCode::FieldInvalid, member.name,
                   fmt::format("{} takes {}", member.name, all));
  }
  fields_.accept_all();  // what else it may have depends on the word
}

bool SetupReader::each(SetupMember member, std::string_view, const Read& read) {
  if (!fields_.has(member.name)) return false;
  const JsonValue* const value = fields_.array(member.name);
  if (value == nullptr) return false;
  for (std::size_t i = 0; i < value->items.size(); ++i) {
    SetupReader reader(value->items[i], pointer_to(at(member.name), i), errors_);
    read(reader);
  }
  return true;
}

}  // namespace fitgauge::api
