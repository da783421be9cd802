#include "formats/dfq/lines.hpp"

namespace fitgauge::aqdef {
namespace {

using enum FieldType;

constexpr std::array kFields = {
#define FITGAUGE_FIELD(name, ...) FieldInfo{__VA_ARGS__},
#include "formats/dfq/fields.inc"
#undef FITGAUGE_FIELD
};

static_assert(std::ranges::is_sorted(kFields, {}, &FieldInfo::number));

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
  const auto* const found = std::ranges::lower_bound(kFields, number, {}, &FieldInfo::number);
  return found != kFields.end() && found->number == number ? found : nullptr;
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
