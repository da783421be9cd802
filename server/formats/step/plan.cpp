#include "formats/step/drawing.hpp"

namespace fitgauge::step {
using api::JsonWriter;
using api::write_json;

namespace {

/// Fields of a characteristic from a drawing; the first are its limits.
constexpr std::array<std::string_view, 9> kDrawn = {"designation", "nominal_mm", "tolerance_class",
                                                    "upper_um",    "lower_um",   "feature",
                                                    "quantity",    "count",      "entity"};
constexpr std::size_t kLimits = 6;

bool is_drawn(std::string_view member) {
  return member == "name" || std::ranges::find(kDrawn, member) != kDrawn.end();
}

std::string limits_of(const JsonValue& characteristic) {
  std::string limits;
  for (const std::string_view name : std::span(kDrawn).first(kLimits)) {
    if (const JsonValue* value = characteristic.find(name))
      limits += fmt::format("{}{} {}", limits.empty() ? "" : ", ", name, value->text);
  }
  return limits;
}

/// Returns one key for equal limits, however they are written: 25 g6 and 25g6.
std::string limits_key(const JsonValue& characteristic) {
  const auto text = [&](std::string_view name) { return characteristic.member(name).text; };
  std::string size(text("designation"));
  if (size.empty()) size = fmt::format("{}{}", text("nominal_mm"), text("tolerance_class"));
  std::erase(size, ' ');
  return fmt::format("{} {} {} {}", size, text("upper_um"), text("lower_um"), text("feature"));
}

void write_size(JsonWriter& json, const DrawnSize& size, const JsonValue* before) {
  const auto has_modifier = [&size](std::string_view word) {
    return std::ranges::any_of(size.modifiers,
                               [word](const std::string& m) { return m.starts_with(word); });
  };
  json.begin_object().member("name", size.name);
  if (size.tolerance_class && has_modifier("envelope")) {
    json.member("designation",
                fmt::format("{} {} (E)", format_mm(size.nominal), *size.tolerance_class));
  } else {
    json.member_mm("nominal_mm", size.nominal);
    if (size.tolerance_class) json.member("tolerance_class", *size.tolerance_class);
  }
  if (size.upper) json.member_um("upper_um", *size.upper);
  if (size.lower) json.member_um("lower_um", *size.lower);
  if (!size.tolerance_class && size.feature) json.member("feature", word(*size.feature));
  json.member("quantity", word(size.quantity));
  if (size.count > 1) json.member("count", size.count);
  json.member("entity", size.entity);
  if (before != nullptr) {
    for (const auto& [name, value] : before->members) {
      if (!is_drawn(name)) write_json(json.key(name), value);
    }
  }
  json.end_object();
}

}  // namespace

Result<DrawnPlan> plan_of(const Drawing& drawing, std::string_view part, const JsonValue* before) {
  static const JsonValue kNone;
  const JsonValue& old = before != nullptr ? *before : kNone;
  const auto& known = old.member("characteristics").items;
  const auto find = [](const std::vector<JsonValue>& all, std::string_view name) {
    const auto found = std::ranges::find_if(
        all, [name](const JsonValue& one) { return one.text_of("name") == name; });
    return found != all.end() ? &*found : nullptr;
  };
  if (drawing.sizes.empty()) {
    return Error{ErrorCode::DrawingNoSizes,
                 fmt::format("no size of the drawing can be a characteristic ({} were not read): "
                             "POST it to /v1/drawings to see why",
                             drawing.not_read.size())};
  }
  DrawnPlan plan{.digest = drawing.digest, .not_read = drawing.not_read};
  Comparison& compared = plan.compared;
  if (const auto digest = old.member("drawing").text_of("digest"); !digest.empty())
    compared.digest.emplace(digest);
  JsonWriter json(plan.text);
  json.begin_object().member("part", part);
  if (const JsonValue* name = old.find("name")) write_json(json.key("name"), *name);
  json.key("drawing")
      .begin_object()
      .member("digest", drawing.digest)
      .member("part", drawing.part)
      .end_object();
  json.key("characteristics").begin_array();
  std::set<std::string_view> names;
  for (const DrawnSize& size : drawing.sizes) {
    names.insert(size.name);
    write_size(json, size, find(known, size.name));
  }
  for (const JsonValue& one : known) {
    if (names.contains(one.text_of("name"))) continue;
    if (one.find("entity") != nullptr)
      compared.gone.emplace_back(one.text_of("name"));
    else
      write_json(json, one);
  }
  json.end_array().end_object();
  const auto made = TRY(parse_json(plan.text));
  const auto& all = made.member("characteristics").items;
  plan.characteristics = all.size();
  for (const JsonValue& one : all) {
    const std::string name(one.text_of("name"));
    const JsonValue* other = find(known, name);
    if (other == nullptr)
      compared.added.push_back(name);
    else if (limits_key(*other) != limits_key(one))
      compared.changed.push_back({name, limits_of(*other), limits_of(one)});
  }
  return plan;
}

}  // namespace fitgauge::step
