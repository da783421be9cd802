#include "api/limits/limits_codec.hpp"

#include <algorithm>

#include "tables/iso286/tolerance_class.hpp"

namespace fitgauge::api {

Result<app::DesignationQuery> parse_designation(std::string_view text) {
  if (standards::is_designation(text)) {
    const auto limits = standards::limits_of(text);
    if (!limits) return limits.error();
    return app::DesignationQuery{limits->nominal, std::string(limits->tolerance_class)};
  }
  auto designation = iso286::parse_designation(text);
  if (!designation) return designation.error();
  return app::DesignationQuery{designation->nominal_size.length(),
                               std::move(designation->class_name)};
}

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

void write_limits_members(JsonWriter& json, const standards::DesignatedLimits& limits) {
  json.member("designation", limits.designation())
      .member_mm("nominal_mm", limits.nominal)
      .member("tolerance_class", limits.tolerance_class)
      .member("feature", word(limits.feature))
      .member_um("upper_deviation_um", limits.deviations.upper)
      .member_um("lower_deviation_um", limits.deviations.lower)
      .member_mm("upper_limit_mm", limits.upper_limit())
      .member_mm("lower_limit_mm", limits.lower_limit())
      .member_um("tolerance_um", limits.deviations.upper - limits.deviations.lower);
  if (limits.size_range) {
    json.key("size_range_mm")
        .begin_object()
        .member_mm("over", limits.size_range->over)
        .member_mm("up_to", limits.size_range->up_to)
        .end_object();
  }
  json.member("basis", word(app::LimitsBasis::Standard))
      .member("table_revision", std::string_view(limits.standard->revision));
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

std::string etag_of(const standards::Standard& standard) {
  std::string tag = '"' + standard.revision + '"';
  std::replace(tag.begin(), tag.end(), ' ', '-');  // a tag has no blank
  return tag;
}

}  // namespace fitgauge::api
