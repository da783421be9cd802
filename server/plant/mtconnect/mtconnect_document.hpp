#pragma once

#include <bitset>

#include "api/resources.hpp"
#include "api/services.hpp"
#include "http/route.hpp"
#include "service/measurements/measurement_service.hpp"

namespace fitgauge::mtconnect {

/// Observations of the device Gauge.
struct DataItem {
  std::string_view id;
  std::string_view type;
  std::string_view sub_type{};
  bool is_discrete = false;
};

inline constexpr std::array<DataItem, 10> kDataItems = {{
    {"avail", "AVAILABILITY"},
    {"asset_changed", "ASSET_CHANGED", "", true},
    {"asset_removed", "ASSET_REMOVED"},
    {"part", "PART_ID"},
    {"count1", "PART_COUNT", "ALL"},
    {"count2", "PART_COUNT", "GOOD"},
    {"count3", "PART_COUNT", "BAD"},
    {"count4", "PART_COUNT", "x:REWORK"},
    {"count5", "PART_COUNT", "x:INDETERMINATE"},
    {"feature", "FEATURE_MEASUREMENT"},
}};

/// Data items that a document shows, by their places.
using Selection = std::bitset<kDataItems.size()>;
inline const Selection kEverything = Selection().set();

/// The data items of a path. Supports XPath paths with `|` between them, whose steps are names or
/// `*` after `/` or `//`, and conditions `[@name="text"]` joined by `and` or `or`: enough for
/// `//Device[@name="Gauge"]//DataItem[@type="PART_ID" or @id="feature"]`. A step to the device or
/// its list of data items selects all of them.
/// @errors QueryInvalid: it is not such a path, or selects nothing.
Result<Selection> select(std::string_view path);

// MTConnect 2.4: a device `Gauge` whose observations are the measurements of the log.

/// Sequence 1 is the availability of the gauge. Measurement n has two: its part and its value.
constexpr std::uint64_t part_sequence(std::int64_t id) {
  return 2 * static_cast<std::uint64_t>(id);
}
constexpr std::uint64_t feature_sequence(std::int64_t id) { return part_sequence(id) + 1; }
/// The measurement that has a sequence; before the first, 0.
constexpr std::int64_t measurement_at(std::uint64_t sequence) {
  return static_cast<std::int64_t>(sequence / 2);
}

/// The agent's part of every document.
struct Agent {
  std::string_view origin;   ///< of the data folder for ever: 16 hexadecimal digits
  std::string_view history;  ///< present end of its ids
  Timestamp now;
  Timestamp began;          ///< since when the gauge is there
  std::int64_t newest = 0;  ///< measurements in the log
  bool has_asset = false;
};

/// Number of values with each verdict, in all; counted for PART_COUNT.
using Counts = app::VerdictTally;

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

  void add_availability() { append("Availability", "avail", 1, agent_.began, "", "AVAILABLE"); }
  /// Adds the observation with that sequence. @pre it is one of the measurement's two.
  void add(const app::Measurement& measurement, std::uint64_t sequence);
  /// @param newest of the measurements that are counted
  void add_counts(const Counts& counts, std::int64_t newest, Timestamp at);
  /// Adds a part without values, if no measurement is known yet.
  void add_unavailable_part() { append("PartId", "part", 1, agent_.began, "", kUnavailable); }
  void add_unavailable_feature() {
    append("FeatureMeasurementTable", "feature", 1, agent_.began, R"( count="0")", kUnavailable);
  }
  /// Adds the change of the asset. @param newest of the measurements it had; 0: there was none.
  void add_assets(std::int64_t newest, Timestamp at);
  std::size_t count() const { return count_; }

  /// @param next the sequence to ask from next.
  std::string document(std::uint64_t next) const;

 private:
  /// Appends an observation if its data item is selected. @param attributes after the time
  void append(std::string_view element, std::string_view id, std::uint64_t sequence, Timestamp at,
              std::string_view attributes, std::string_view text);

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

namespace fitgauge::api {

/// The current header of every document of the agent.
mtconnect::Agent mtconnect_agent(const Services& services);
http::Response mtconnect_response(int status, std::string text);

/// Largest sequence that a query may name.
inline constexpr std::int64_t kMostSequence = std::int64_t{1} << 53;

/// Number of open streams.
using OpenStreams = std::shared_ptr<std::atomic<int>>;
inline constexpr int kMostMtconnectStreams = 32;

std::vector<http::Parameter> sample_parameters();

/// GET /mtconnect/sample: a document of the observations from a sequence on, or with `interval` a
/// stream of them. @param open outlives the streams.
void sample_mtconnect(const Services& services, const OpenStreams& open,
                      const http::Request& request, http::Responder responder);

/// /mtconnect/probe, current, sample, assets and asset. Nothing runs for them: they read the log.
void add_mtconnect_routes(Routes& add);

/// Whether an error of the request is returned as an MTConnect document.
bool is_of_mtconnect(const http::Request& request);
/// Returns a problem as an MTConnectError document. @param problem as others get it
http::Response mtconnect_error(const Services& services, const Error& error,
                               http::Response problem);

}  // namespace fitgauge::api
