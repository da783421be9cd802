#include "api/runs/setup_forms.hpp"

#include <fmt/format.h>

#include "api/files/file_path.hpp"

namespace fitgauge::api {

bool read_numbers(const JsonValue& array, const std::string& pointer, std::span<double> to,
                  bool are_lengths, FieldErrors& errors) {
  if (array.items.size() != to.size()) {
    errors.add(ErrorCode::FieldInvalid, pointer,
               fmt::format("{} numbers are wanted, not {}", to.size(), array.items.size()));
    return false;
  }
  // The elements as members of an object, whose names are then the tokens of their pointers.
  JsonValue object{.kind = JsonValue::Kind::Object};
  for (std::size_t i = 0; i < to.size(); ++i) {
    object.members.emplace_back(std::to_string(i), array.items[i]);
  }
  FieldReader element(object, pointer, errors);
  for (std::size_t i = 0; i < to.size(); ++i) {
    const std::string& index = object.members[i].first;
    are_lengths ? Mm{}.read(element, index, to[i]) : Number{}.read(element, index, to[i]);
  }
  return true;
}

bool PointList::read(FieldReader& fields, std::string_view name,
                     std::vector<machine::Vec3>& to) const {
  const JsonValue* const array = fields.array(name);
  if (array == nullptr) return false;
  for (std::size_t i = 0; i < array->items.size(); ++i) {
    const std::string pointer = pointer_to(fields.at(name), i);
    const JsonValue& item = array->items[i];
    std::array<double, 3> point{};
    if (!item.is(JsonValue::Kind::Array)) {
      fields.errors().add(ErrorCode::FieldType, pointer,
                          fmt::format("an array is wanted, not {}", name_of(item.kind)));
    } else if (read_numbers(item, pointer, point, true, fields.errors())) {
      to.push_back({point[0], point[1], point[2]});
    }
  }
  return true;
}

bool DiskFile::read(FieldReader& fields, std::string_view name, std::string& to) const {
  const auto given = fields.text(name);
  if (!given) return false;
  const auto parsed = parse_file_path(*given);
  if (parsed) {
    to = parsed->text();
  } else {
    fields.report(parsed.error().code, name, parsed.error().message);
  }
  return parsed.has_value();
}

}  // namespace fitgauge::api
