#include "plant/webhook/body_template.hpp"

#include "base/json/json_value.hpp"
#include "base/json/json_writer.hpp"

namespace fitgauge::connections {
namespace {

constexpr std::string_view kOpen = "{{";
constexpr std::string_view kClose = "}}";

Error invalid(std::string message) { return {ErrorCode::FieldInvalid, std::move(message)}; }

bool is_field(std::string_view name) {
  return !name.empty() && std::ranges::all_of(name, [](char c) {
    return is_ascii_alphanumeric(c) || c == '_' || c == '.';
  });
}

/// Whether the text has an odd number of unescaped quotes.
bool changes_string(std::string_view text) {
  bool is_odd = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\') {
      ++i;
    } else if (text[i] == '"') {
      is_odd = !is_odd;
    }
  }
  return is_odd;
}

/// Follows the names between the dots; null if one does not exist.
const JsonValue& member_at(const JsonValue& object, std::string_view path) {
  const std::size_t dot = path.find('.');
  const JsonValue& member = object.member(path.substr(0, dot));
  return dot == path.npos ? member : member_at(member, path.substr(dot + 1));
}

JsonValue field_of(const JsonValue& event, std::string_view id, std::string_view name) {
  if (name == "id") return {.kind = JsonValue::Kind::String, .text = std::string(id)};
  const std::string_view first = name.substr(0, name.find('.'));
  return member_at(event.find(first) != nullptr ? event : event.member("data"), name);
}

/// Returns the value as the inside of a JSON string, without quotes.
std::string in_string(const JsonValue& value) {
  if (value.is(JsonValue::Kind::Null)) return {};
  const bool is_text = value.is(JsonValue::Kind::String) || value.is(JsonValue::Kind::Number);
  const std::string quoted = api::json_text(
      {.kind = JsonValue::Kind::String, .text = is_text ? value.text : api::json_text(value)});
  return quoted.substr(1, quoted.size() - 2);
}

}  // namespace

Result<BodyTemplate> BodyTemplate::read(const JsonValue& body) {
  std::string text = body.is(JsonValue::Kind::String) ? body.text : api::json_text(body);
  if (text.empty() || text.size() > kLongest) {
    return invalid(fmt::format("body must have 1 to {} bytes; got {}", kLongest, text.size()));
  }
  auto made = parse(text);
  if (!made) return made;
  // Tests the JSON with an event that has no fields.
  if (const auto parsed = parse_json(made->body_of("", "{}")); !parsed) {
    return invalid(
        fmt::format("body must be JSON with {{{{field}}}} in it: {}", parsed.error().message));
  }
  return made;
}

Result<BodyTemplate> BodyTemplate::parse(std::string_view text) {
  BodyTemplate made;
  const auto add = [&made](Part::Kind kind, std::string_view part) {
    if (kind != Part::Kind::Literal || !part.empty())
      made.parts_.push_back({kind, std::string(part)});
  };
  bool is_in_string = false;
  for (std::size_t open = text.find(kOpen); open != text.npos; open = text.find(kOpen)) {
    const std::size_t close = text.find(kClose, open);
    const std::string_view name =
        close == text.npos ? "" : text.substr(open + kOpen.size(), close - open - kOpen.size());
    std::string_view before = text.substr(0, open);
    if (!is_field(name)) {
      return invalid(fmt::format("body must name a field, as in {{{{part_id}}}}; got '{}'",
                                 first_characters(text.substr(open), 40)));
    }
    is_in_string = is_in_string != changes_string(before);
    text.remove_prefix(close + kClose.size());
    const bool is_alone =
        is_in_string && before.ends_with('"') && !before.ends_with("\\\"") && text.starts_with('"');
    if (is_alone) {
      before.remove_suffix(1);
      text.remove_prefix(1);
      is_in_string = false;
    }
    add(Part::Kind::Literal, before);
    add(is_in_string ? Part::Kind::Text : Part::Kind::Value, name);
  }
  add(Part::Kind::Literal, text);
  return made;
}

std::string BodyTemplate::body_of(std::string_view id, std::string_view event) const {
  const auto parsed = parse_json(event);
  const JsonValue none;
  std::string body;
  for (const Part& part : parts_) {
    if (part.kind == Part::Kind::Literal) {
      body += part.text;
      continue;
    }
    const JsonValue value = field_of(parsed ? *parsed : none, id, part.text);
    body += part.kind == Part::Kind::Text ? in_string(value) : api::json_text(value);
  }
  return body;
}

}  // namespace fitgauge::connections
