#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "plant/mtconnect/mtconnect_path.hpp"
#include "service/measurements/measurement_service.hpp"

// MTConnect 2.4: a device `Gauge` whose observations are the measurements of the log.

namespace fitgauge::mtconnect {

/// Sequence 1 is that the gauge is there; measurement n of the log has two: its part and itself.
constexpr std::uint64_t part_sequence(std::int64_t id) {
  return 2 * static_cast<std::uint64_t>(id);
}
constexpr std::uint64_t feature_sequence(std::int64_t id) { return part_sequence(id) + 1; }
/// The measurement that has a sequence; before the first, 0.
constexpr std::int64_t measurement_at(std::uint64_t sequence) {
  return static_cast<std::int64_t>(sequence / 2);
}

/// What every document says of the agent.
struct Agent {
  std::string_view origin;   ///< of the data folder for ever: 16 hexadecimal digits
  std::string_view history;  ///< what its ids end with now
  Timestamp now;
  Timestamp began;          ///< since when the gauge is there
  std::int64_t newest = 0;  ///< measurements in the log
  bool has_asset = false;
};

/// How many values were judged so, in all; counted for PART_COUNT.
struct Counts {
  std::int64_t good = 0;
  std::int64_t rework = 0;
  std::int64_t reject = 0;
  std::int64_t indeterminate = 0;
};

Counts counts_of(const std::vector<app::MeasurementGroup>& groups);

/// The part counts by the ids of their data items.
std::array<std::pair<std::string_view, std::int64_t>, 5> counts_by_item(const Counts& counts);

/// The key of a measurement's entry in the table of features: its characteristic.
std::string entry_of(const app::Measurement& measurement);
/// The cells of that entry.
std::vector<std::pair<std::string_view, std::string>> cells_of(const app::Measurement& measurement);

inline constexpr std::string_view kUnavailable = "UNAVAILABLE";

/// Gathers the observations of a document.
class Streams {
 public:
  explicit Streams(const Agent& agent, const Selection& selection = kEverything)
      : agent_(agent), selection_(selection) {}

  void add_availability();
  /// The observation of that sequence. @pre it is one of the two that the measurement has.
  void add(const app::Measurement& measurement, std::uint64_t sequence);
  /// @param newest of the measurements that are counted
  void add_counts(const Counts& counts, std::int64_t newest, Timestamp at);
  /// No measurement is known yet.
  void add_unavailable_part();
  void add_unavailable_feature();
  /// Which asset has changed. @param newest of the measurements it had; 0: there was none.
  void add_assets(std::int64_t newest, Timestamp at);
  std::size_t count() const { return count_; }

  /// @param next the sequence to ask from next.
  std::string document(std::uint64_t next) const;

 private:
  /// Whether the data item of that id is shown.
  bool shows(std::string_view id) const;
  void append(std::string observation);

  const Agent agent_;
  const Selection selection_;
  std::string events_;
  std::size_t count_ = 0;
};

/// The id of the one asset: QIF results of the newest measurements.
std::string asset_id(const Agent& agent);
/// @param qif the element QIFDocument; empty: there is no asset.
std::string assets_document(const Agent& agent, std::string_view qif, Timestamp at);

std::string devices_document(const Agent& agent);
/// @param code OUT_OF_RANGE and such.
std::string error_document(const Agent& agent, std::string_view code, std::string_view message);

}  // namespace fitgauge::mtconnect
