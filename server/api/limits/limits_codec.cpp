#include "api/limits/limits_codec.hpp"

namespace fitgauge::api {

void write_limits_members(JsonWriter& json, const iso286::LimitsOfSize& limits,
                          const iso286::ToleranceTables& tables) {
  const std::string_view class_name = tables.class_name(limits.class_id);
  const Length nominal_size = limits.nominal_size.length();
  json.member("designation", designation_text(nominal_size, class_name))
      .member_mm("nominal_mm", nominal_size)
      .member("tolerance_class", class_name)
      .member("feature", word(limits.feature))
      .member_um("upper_deviation_um", limits.deviations.upper)
      .member_um("lower_deviation_um", limits.deviations.lower)
      .member_mm("upper_limit_mm", limits.upper_limit())
      .member_mm("lower_limit_mm", limits.lower_limit())
      .member_um("tolerance_um", limits.tolerance())
      .key("size_range_mm")
      .begin_object()
      .member_mm("over", limits.size_range.over)
      .member_mm("up_to", limits.size_range.up_to)
      .end_object()
      .member("basis", word(limits.basis))
      .member("table_revision", std::string_view(tables.revision().id));
}

void write_limits(JsonWriter& json, const iso286::LimitsOfSize& limits,
                  const iso286::ToleranceTables& tables) {
  json.begin_object();
  write_limits_members(json, limits, tables);
  json.end_object();
}

std::string designation_text(Length nominal_size, std::string_view class_name) {
  std::string text = format_mm(nominal_size);
  text += ' ';
  return text += class_name;
}

std::string etag_of(const iso286::ToleranceTables& tables) {
  return '"' + tables.revision().id + '"';
}

}  // namespace fitgauge::api
