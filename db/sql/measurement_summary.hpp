#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "sql/measurement_query.hpp"
#include "sql/statement.hpp"
#include "store/measurement_filter.hpp"
#include "store/measurement_index.hpp"
#include "store/measurement_statistics.hpp"
#include "store/measurement_summary.hpp"

namespace fitgauge::store {

/// Sums measurements up by the values of one field. Where the filter allows, whole nodes of the
/// index are added by their aggregates and only the rest is read row by row: filters by verdict,
/// source and times, and by the field itself.
class MeasurementSummary {
 public:
  MeasurementSummary(sql::Connection& connection, TextField group_by);

  /// @errors QueryInvalid when there are more than `max_groups` groups.
  Result<std::vector<SummaryGroup>> run(const MeasurementFilter& filter, std::size_t max_groups);

 private:
  struct Group {
    ExactStatistics statistics;
    std::array<std::int64_t, 4> verdicts{};  ///< by Verdict, Good first
  };
  enum class Relation { Outside, Inside, Partly };

  bool is_additive(const MeasurementFilter& filter) const;
  void add_nodes();
  void add_node(const IndexNode& node);
  Relation relation(const IndexNode& node, bool& usable);
  bool add_aggregates(const IndexNode& node);
  void add_rows(const MeasurementFilter& filter, const IdSpan& ids);
  void add_corrected_rows();
  void add(std::optional<std::string_view> value, Verdict verdict,
           const ExactStatistics& statistics);

  const TextField group_by_;
  MeasurementQuery rows_;
  sql::Statement last_block_;
  sql::Statement node_;
  sql::Statement aggregates_;
  sql::Statement aggregates_of_value_;
  sql::Statement corrected_;

  // Of the summary that is being made.
  const MeasurementFilter* filter_ = nullptr;
  std::size_t max_groups_ = 0;
  bool fits_ = true;
  std::map<std::optional<std::string>, Group, std::less<>> groups_;
  std::vector<IdSpan>
      aggregated_;  ///< what was added by aggregates, which leave corrected rows out
};

}  // namespace fitgauge::store
