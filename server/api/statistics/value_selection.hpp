#pragma once

#include <unordered_map>

#include "base/json/body_forms.hpp"
#include "http/route.hpp"
#include "metrology/statistics/capability.hpp"
#include "service/measurements/measurement_service.hpp"

namespace fitgauge::api {

metrology::Exact exact_mm(Length length);

/// Ids of measurements, in four bytes each: most of one folder, with rising numbers.
class MeasurementIds {
 public:
  void add(std::int64_t number, std::string_view origin);
  std::size_t size() const { return offsets_.size(); }
  std::size_t bytes() const {
    return offsets_.size() * sizeof(offsets_.front()) + parts_.size() * sizeof(parts_.front());
  }
  std::string text(std::size_t index) const;
  /// Returns the ids in another order of their indices.
  MeasurementIds in_order(const std::vector<std::uint32_t>& order) const;

 private:
  struct Part {
    std::size_t begin = 0;  ///< its first index
    std::int64_t base = 0;  ///< base of the offsets of its numbers
    std::string_view origin;
  };

  const Part& part_of(std::size_t index) const;

  std::vector<std::uint32_t> offsets_;
  std::vector<Part> parts_;
};

/// The measurements of a figure, in a response.
struct Selection {
  std::size_t count = 0;
  std::size_t subgroup_count = 0;
  std::string first_id{};  ///< in the order of a chart
  std::string last_id{};
  std::string as_of{};  ///< the newest measurement there was
  std::optional<Length> lower_limit{};
  std::optional<Length> upper_limit{};
};
void members(auto& v, const Selection& selection) {
  v.member("count", selection.count, "Number of values");
  v.member("subgroups", selection.subgroup_count, "0 if the values are single values");
  v.member("first_id", selection.first_id, "The first of them in storage order");
  v.member("last_id", selection.last_id);
  v.member("as_of", selection.as_of, "The newest measurement there was");
  v.optional("lower_limit_mm", selection.lower_limit, Millimetres{}, "Limit of all values");
  v.optional("upper_limit_mm", selection.upper_limit, Millimetres{});
}

/// The stored values a figure is computed from, in mm, with the limits all of them have.
struct SelectedValues : Selection {
  metrology::Subgroups data{};
  metrology::SpecificationLimits limits{};
  MeasurementIds ids{};                  ///< of single values
  std::vector<std::string> subgroups{};  ///< otherwise the names of the subgroups
};

/// Collects values as they are read. Needs 20 bytes a value, and the subgroup names.
class ValueSelection {
 public:
  static constexpr std::size_t kMostBytes = std::size_t{48} << 20;

  explicit ValueSelection(std::size_t most_bytes = kMostBytes) : most_bytes_(most_bytes) {}

  /// Adds all values of a query, a correction in the place of its target. Blocks.
  /// @errors those of add() and of reading
  Result<void> read(app::MeasurementService& measurements, const app::MeasurementQuery& query);

  /// @errors LimitsMixed: other limits than the first value; StatisticsTooMany; FiguresLimit.
  Result<void> add(const app::MeasuredRun& run);

  /// Moves values to their places, after all are added.
  void move(const std::vector<app::MovedValue>& moves);

  /// Returns the values by subgroup: subgroups in the order of their first value, the values of
  /// each in their order; single values if there are no subgroups, or they are ignored.
  /// @errors StatisticsTooFew: none, or subgroups of one value; StatisticsUnbalanced: a value
  ///   without subgroup, or subgroups of different sizes.
  Result<SelectedValues> selected(bool ignores_subgroups) &&;

 private:
  struct Limits {
    std::optional<Length> lower;
    std::optional<Length> upper;
    friend bool operator==(const Limits&, const Limits&) = default;
  };

  /// `25 to 25.021 mm`, for errors.
  static std::string text_of(const Limits& limits);
  Result<SelectedValues> one_by_one() &&;
  Result<SelectedValues> by_subgroup() &&;
  /// Puts the values that are being added into their subgroup.
  void join(std::string_view subgroup, std::size_t values);
  Result<SelectedValues> described();

  const std::size_t most_bytes_;
  std::string as_of_;
  std::size_t bytes_ = 0;
  std::optional<Limits> limits_;
  std::vector<metrology::Wide> counts_;  ///< in nm
  MeasurementIds ids_;
  bool names_subgroups_ = false;
  std::optional<std::string> ungrouped_;  ///< the id of the first value without a subgroup
  // While every value has one:
  std::vector<std::uint32_t> groups_;  ///< the number of the subgroup of each value
  std::unordered_map<std::string, std::uint32_t> numbers_;
  std::vector<const std::string*> names_;  ///< by number
};

/// `subgroups=ignore`
Parameter subgroups_parameter();
bool ignores_subgroups(const Request& request);

}  // namespace fitgauge::api
