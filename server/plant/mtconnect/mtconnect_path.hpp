#pragma once

#include <array>
#include <bitset>
#include <string_view>

#include "base/result.hpp"

namespace fitgauge::mtconnect {

/// What the device Gauge observes.
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

/// Which of them a document shows, by their places.
using Selection = std::bitset<kDataItems.size()>;
inline const Selection kEverything = Selection().set();

/// The data items that a path names. Of XPath it takes paths with `|` between them, whose steps are
/// names or `*` behind `/` or `//`, and conditions `[@name="text"]` joined by `and` or `or`: enough
/// for `//Device[@name="Gauge"]//DataItem[@type="PART_ID" or @id="feature"]`. A step that names the
/// device or its list of data items chooses all that it holds.
/// @errors QueryInvalid: it is no such path, or names nothing that is there.
Result<Selection> select(std::string_view path);

}  // namespace fitgauge::mtconnect
