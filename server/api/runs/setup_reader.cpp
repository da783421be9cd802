#include "api/runs/setup_reader.hpp"

namespace fitgauge::api {

void SetupReader::required_mm(std::string_view name, std::vector<machine::Vec3>& points) {
  const JsonValue* array = fields_.array(name);
  if (array == nullptr) return;
  for (std::size_t i = 0; i < array->items.size(); ++i) {
    const std::string pointer = pointer_to(at(name), i);
    const JsonValue& item = array->items[i];
    if (!item.is(JsonValue::Kind::Array)) {
      errors_.add(ErrorCode::FieldType, pointer,
                  fmt::format("an array is wanted, not {}", name_of(item.kind)));
      continue;
    }
    std::array<double, 3> point{};
    read_elements(item, pointer, point, mm_element, errors_);
    points.push_back({point[0], point[1], point[2]});
  }
}

}  // namespace fitgauge::api
