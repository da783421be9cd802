#pragma once

#include "base/json/body_forms.hpp"
#include "formats/step/part21.hpp"
#include "metrology/gauging/gauge.hpp"
#include "tables/iso286/tolerance_tables.hpp"

// The sizes of a drawing: dimensions and limits in a STEP file with product manufacturing
// information (AP242, AP203, AP214), and its content that is not a size.

namespace fitgauge::step {

/// A size that a characteristic of a plan is made of: with a class or with deviations.
struct DrawnSize {
  std::string name{};  ///< of its callout, or of its kind; unique in the drawing
  Length nominal{};
  std::optional<std::string> tolerance_class{};
  std::optional<Length> upper{};
  std::optional<Length> lower{};
  std::optional<iso286::Feature> feature{};
  gauging::Quantity quantity = gauging::Quantity::Diameter;
  std::int64_t count = 1;
  std::string entity{};  ///< `#120`
  std::vector<std::string> modifiers{};
  std::vector<std::string> remarks{};
};

/// An entry of the file that is not a size, or an incomplete size.
struct NotRead {
  std::string entity{};
  std::string name{};
  std::string why{};
};

struct ChangedLimits {
  std::string name{};
  std::string before{};  ///< `nominal_mm 35, upper_um 200, lower_um 0`
  std::string after{};
};

/// Members that characteristics of a drawing have and characteristics of a plan have not.
struct Comparison {
  std::optional<std::string> digest{};  ///< of the drawing that the plan came from
  std::vector<std::string> added{};
  std::vector<std::string> gone{};
  std::vector<ChangedLimits> changed{};
};

struct Drawing {
  std::string part{};    ///< the number of the one product; empty if there are several
  std::string digest{};  ///< SHA-256 of the file in hexadecimal
  std::vector<DrawnSize> sizes{};
  std::vector<NotRead> not_read{};
  std::optional<Comparison> compared{};  ///< with a plan
};

void members(auto& v, const DrawnSize& size) {
  v.member("name", size.name, "Name of the callout (default: of the kind); unique in the drawing");
  v.member("nominal_mm", size.nominal, api::Millimetres{}, "");
  v.optional("tolerance_class", size.tolerance_class,
             "Tolerance class; then deviations are absent");
  v.optional("upper_um", size.upper, api::Micrometres{}, "Upper deviation");
  v.optional("lower_um", size.lower, api::Micrometres{}, "Lower deviation");
  v.optional("feature", size.feature, api::Words{iso286::Feature::Shaft},
             "Feature that the faces show, for a diameter or width");
  v.member("quantity", size.quantity, api::Words{gauging::Quantity::Deviation}, "Quantity");
  v.member("count", size.count, api::Integer{.least = 1}, "Number of features: 4 of 4X");
  v.member("entity", size.entity, "Instance in the file: #120");
  v.member("modifiers", size.modifiers, api::List<std::string, api::Text>{},
           "Modifiers as written in the file");
  v.member("remarks", size.remarks, api::List<std::string, api::Text>{}, "Checks before use");
}
void members(auto& v, const NotRead& other) {
  v.member("entity", other.entity, "Instance in the file");
  v.member("name", other.name, "Name of the callout (default: of the entity)");
  v.member("why", other.why, "Reason, and what to do");
}
void members(auto& v, const ChangedLimits& change) {
  v.member("name", change.name, "Name of the characteristic");
  v.member("before", change.before, "Limits in the plan");
  v.member("after", change.after, "Limits in the drawing");
}
void comparison_members(auto& v, const Comparison& compared) {
  v.member("added", compared.added, api::List<std::string, api::Text>{},
           "Names that the plan has not");
  v.member("gone", compared.gone, api::List<std::string, api::Text>{},
           "Names of drawn ones that the drawing has not");
  v.member("changed", compared.changed, "Sizes with the same name and other limits");
}
void members(auto& v, const Comparison& compared) {
  v.optional("digest", compared.digest, "SHA-256 of the drawing of the plan");
  comparison_members(v, compared);
}
void members(auto& v, const Drawing& drawing) {
  v.member("part", drawing.part, "The number of the product; empty if there are several");
  v.member("digest", drawing.digest, "SHA-256 of the file, in hexadecimal");
  v.member("sizes", drawing.sizes, "Sizes that a plan can use as they are");
  v.member("not_read", drawing.not_read,
           "Tolerances of form and place, notes, and sizes that lack something");
  v.optional("compared", drawing.compared,
             "Comparison with the plan of the part; absent if there is none");
}

/// @param text a whole file, read a stretch at a time if it is mapped; lengths are converted to mm
/// and rounded to the nearest nanometre
/// @param tables of the classes that the file names
/// @errors DrawingMalformed with the line: the file is none, is cut, or contradicts itself.
Result<Drawing> read_drawing(const FileText& text, const iso286::ToleranceTables& tables,
                             std::size_t most_instances = Part21::kMostInstances);

/// A plan made from a drawing, with its differences from the stored plan.
struct DrawnPlan {
  std::string text{};  ///< JSON
  std::string digest{};
  std::uint64_t characteristics = 0;
  Comparison compared{};
  std::vector<NotRead> not_read{};
};

void members(auto& v, const DrawnPlan& plan) {
  v.member("digest", plan.digest, "SHA-256 of the file, which the plan keeps");
  v.member("characteristics", plan.characteristics, "Number of characteristics of the plan");
  comparison_members(v, plan.compared);
  v.member("not_read", plan.not_read, "Content of the file that is not in the plan");
}

/// Makes each size a characteristic with its name. Settings of people for that name (gauge, rule,
/// sample, reaction) stay; characteristics without a drawing stay after the drawing's.
/// @param before the plan of the part; null if there is none
/// @errors DrawingNoSizes.
Result<DrawnPlan> plan_of(const Drawing& drawing, std::string_view part, const JsonValue* before);

}  // namespace fitgauge::step
