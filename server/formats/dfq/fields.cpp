#include "formats/dfq/fields.hpp"

#include "formats/dfq/lines.hpp"

namespace fitgauge::aqdef {
namespace {

using enum FieldType;

/// Types and lengths as public lists of the format have them; in ascending order.
constexpr std::array kFields = {
    FieldInfo{1, Number, 22, "measured value"},
    FieldInfo{2, Integer, 5, "attribute"},
    FieldInfo{4, Time, 0, "date and time"},
    FieldInfo{5, List, 0, "events"},
    FieldInfo{6, Text, 14, "batch number"},
    FieldInfo{7, Integer, 10, "cavity number"},
    FieldInfo{8, Integer, 10, "operator"},
    FieldInfo{9, Text, 255, "text"},
    FieldInfo{10, Integer, 10, "machine number"},
    FieldInfo{11, List, 0, "process parameters"},
    FieldInfo{12, Integer, 10, "gage number"},
    FieldInfo{14, Text, 40, "part ident"},
    FieldInfo{20, Integer, 5, "subgroup size"},
    FieldInfo{21, Integer, 5, "number of errors"},
    FieldInfo{53, Text, 20, "order number"},
    FieldInfo{97, Text, 38, "GUID of the value"},
    FieldInfo{100, Integer, 5, "number of characteristics"},
    FieldInfo{1001, Text, 30, "part number"},
    FieldInfo{1002, Text, 80, "part description"},
    FieldInfo{1053, Text, 40, "contract"},
    FieldInfo{1081, Text, 24, "machine number"},
    FieldInfo{1082, Text, 40, "machine description"},
    FieldInfo{1086, Text, 40, "operation"},
    FieldInfo{1100, Text, 40, "area"},
    FieldInfo{1303, Text, 40, "plant"},
    FieldInfo{2001, Text, 20, "characteristic number"},
    FieldInfo{2002, Text, 80, "characteristic description"},
    FieldInfo{2004, Integer, 5, "characteristic type"},
    FieldInfo{2022, Integer, 5, "decimal places"},
    FieldInfo{2101, Number, 22, "nominal value"},
    FieldInfo{2103, Text, 2, "tolerance class"},
    FieldInfo{2104, Integer, 3, "tolerance grade"},
    FieldInfo{2110, Number, 22, "lower limit"},
    FieldInfo{2111, Number, 22, "upper limit"},
    FieldInfo{2112, Number, 22, "lower allowance"},
    FieldInfo{2113, Number, 22, "upper allowance"},
    FieldInfo{2120, Integer, 3, "type of the lower limit"},
    FieldInfo{2121, Integer, 3, "type of the upper limit"},
    FieldInfo{2142, Text, 20, "unit"},
    FieldInfo{2800, Text, 50, "name of user field 1"},
    FieldInfo{2801, Text, 1, "type of user field 1"},
    FieldInfo{2802, Text, 255, "text of user field 1"},
    FieldInfo{4062, Text, 40, "machine of the catalogue"},
    FieldInfo{4063, Text, 100, "description of a machine"},
    FieldInfo{4072, Text, 40, "gage of the catalogue"},
    FieldInfo{4073, Text, 80, "description of a gage"},
    FieldInfo{4092, Text, 50, "operator of the catalogue"},
    FieldInfo{4093, Text, 50, "first name of an operator"},
};

static_assert(std::is_sorted(kFields.begin(), kFields.end(),
                             [](const FieldInfo& a, const FieldInfo& b) {
                               return a.number < b.number;
                             }));

constexpr char kBar = '|';

/// Fields of a text that begins after the first bar and ends with one.
std::optional<std::vector<CarriedField>> parse_fields(std::string_view text) {
  std::vector<CarriedField> fields;
  while (!text.empty()) {
    if (!is_field_line(text) || text.size() < 7 || text[5] != ' ') return std::nullopt;
    const auto field = parse_field_line(text.substr(0, 5));
    if (!field) return std::nullopt;
    const Level level = level_of(field->number);
    if (level != Level::Value && level != Level::Part) return std::nullopt;
    text.remove_prefix(6);
    CarriedField carried{.number = field->number, .text = {}};
    for (;;) {
      if (text.empty()) return std::nullopt;  // no bar at its end
      const char c = text[0];
      text.remove_prefix(1);
      if (c == kBar && !text.starts_with(kBar)) break;
      if (c == kBar) text.remove_prefix(1);
      carried.text += c;
    }
    fields.push_back(std::move(carried));
  }
  return fields;
}

}  // namespace

Level level_of(int number) {
  if (number == k::kCount || number == 101 || number == 999) return Level::File;
  switch (number / 1000) {
    case 0: return Level::Value;
    case 1: return Level::Part;
    case 4: return Level::Catalogue;
    case 5: return Level::Group;
    case 2:
    case 3:
    case 8: return Level::Characteristic;
    default: return Level::Other;
  }
}

const FieldInfo* field_info(int number) {
  const auto found =
      std::lower_bound(kFields.begin(), kFields.end(), number,
                       [](const FieldInfo& field, int wanted) { return field.number < wanted; });
  return found != kFields.end() && found->number == number ? &*found : nullptr;
}

std::string format_comment(const Comment& comment) {
  std::string text = comment.text;
  if (comment.fields.empty()) return text;
  if (!text.empty()) text += ' ';
  for (const CarriedField& field : comment.fields) {
    text += fmt::format("|K{:04} ", field.number);
    for (const char c : field.text) {
      text += c;
      if (c == kBar) text += c;
    }
  }
  return text += kBar;
}

Comment parse_comment(std::string_view comment) {
  for (std::size_t at = comment.find("|K"); at != std::string_view::npos && comment.ends_with(kBar);
       at = comment.find("|K", at + 1)) {
    if (at > 0 && comment[at - 1] != ' ') continue;
    auto fields = parse_fields(comment.substr(at + 1));
    if (fields && !fields->empty()) {
      return {.text = std::string(comment.substr(0, at == 0 ? 0 : at - 1)),
              .fields = *std::move(fields)};
    }
  }
  return {.text = std::string(comment)};
}

}  // namespace fitgauge::aqdef
