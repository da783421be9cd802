#include "store/measurements_store.hpp"

#include <fmt/format.h>

#include <map>
#include <stdexcept>

#include "sqlite/measurement_insert.hpp"
#include "sqlite/measurement_query.hpp"
#include "sqlite/statement.hpp"
#include "store/measurement_fields.hpp"
#include "store/measurement_statistics.hpp"

namespace fitgauge::store {
namespace {

using sqlite::Rows;
using sqlite::Statement;

MeasurementRow read_row(const Rows& rows) {
  MeasurementRow row;
  int column = 0;
  row.id = rows.get<std::int64_t>(column);
  for_each_field(row, [&](const char*, auto& value) {
    value = rows.get<std::remove_reference_t<decltype(value)>>(++column);
  });
  row.hash = rows.get<Digest>(++column);
  return row;
}

constexpr std::string_view column_of(GroupBy group_by) {
  switch (group_by) {
    case GroupBy::PartId: return "part_id";
    case GroupBy::Characteristic: return "characteristic";
    case GroupBy::Order: return "work_order";
    case GroupBy::Operation: return "operation";
    case GroupBy::Machine: return "machine";
    case GroupBy::Operator: return "operator";
    case GroupBy::Gauge: return "gauge";
    case GroupBy::Unit: return "unit";
    case GroupBy::ToleranceClass: return "tolerance_class";
    case GroupBy::Caller: return "caller";
  }
  return "characteristic";
}

/// What is gathered of a group while its rows pass.
struct Gathered {
  ExactStatistics statistics;
  SummaryGroup group;

  void add(Verdict verdict, std::int64_t measured_nm) {
    statistics.add(measured_nm);
    const bool first = group.count++ == 0;
    if (first || measured_nm < group.min_nm) group.min_nm = measured_nm;
    if (first || measured_nm > group.max_nm) group.max_nm = measured_nm;
    ++group.verdicts.at(static_cast<std::size_t>(verdict) - 1);
  }

  SummaryGroup finish(std::optional<std::string> value) {
    group.value = std::move(value);
    group.mean_mm = statistics.mean_mm();
    if (group.count > 1) group.standard_deviation_mm = statistics.standard_deviation_mm();
    return std::move(group);
  }
};

}  // namespace

struct MeasurementsStore::Statements {
  explicit Statements(sqlite::Connection& c)
      : connection(c),
        insert(c),
        newest(c, "SELECT id, hash FROM measurements ORDER BY id DESC LIMIT 1"),
        by_id(c, fmt::format("SELECT {} FROM measurements WHERE id = ?", measurement_columns())),
        correction(c, "SELECT id FROM measurements WHERE correction_of = ?"),
        revision(c, "SELECT 1 FROM table_revisions WHERE number = ?"),
        lookup(c),
        whole_rows(c, measurement_columns()) {}

  MeasurementChain::End chain_end() {
    Rows rows = newest.query();
    if (!rows.next()) return {};
    return {rows.get<std::int64_t>(0), rows.get<Digest>(1)};
  }

  /// @errors as append
  Result<void> require_current(std::int64_t id) {
    if (!by_id.query(id).next()) {
      return Error{ErrorCode::MeasurementUnknown,
                   fmt::format("there is no measurement {} to correct", id)};
    }
    if (corrected_by(id)) {
      return Error{ErrorCode::MeasurementCorrected,
                   fmt::format("measurement {} was corrected before; correct the current one", id)};
    }
    return {};
  }

  /// A row with limits of a revision that is not there is a bug of the caller's. Revisions are
  /// never deleted: one that was seen is there.
  void require_revision(std::int64_t number) {
    if (number == seen_revision) return;
    if (!revision.query(number).next()) {
      throw std::logic_error(fmt::format("there is no table revision {}", number));
    }
    seen_revision = number;
  }

  std::optional<std::int64_t> corrected_by(std::int64_t id) {
    Rows rows = correction.query(id);
    return rows.next() ? std::optional(rows.get<std::int64_t>(0)) : std::nullopt;
  }

  /// Made at the first summary by this field.
  MeasurementQuery& values_by(GroupBy group_by) {
    const auto found = values.find(group_by);
    if (found != values.end()) return found->second;
    const std::string columns = fmt::format("m.{}, m.verdict, m.measured_nm", column_of(group_by));
    return values.emplace(group_by, MeasurementQuery(connection, columns)).first->second;
  }

  sqlite::Connection& connection;
  MeasurementInsert insert;
  Statement newest;
  Statement by_id;
  Statement correction;
  Statement revision;
  MeasurementLookup lookup;
  MeasurementQuery whole_rows;
  std::map<GroupBy, MeasurementQuery> values;
  std::optional<std::int64_t> seen_revision;
};

MeasurementsStore::MeasurementsStore(sqlite::Connection& connection)
    : statements_(std::make_unique<Statements>(connection)) {}
MeasurementsStore::~MeasurementsStore() = default;

Result<IdRange> MeasurementsStore::append(std::span<MeasurementRow> rows) {
  MeasurementChain chain(chain_end());
  const std::int64_t first = chain.end().id + 1;
  chain.link(rows);
  if (const Result<void> appended = append_linked(rows); !appended) return appended.error();
  return IdRange{first, chain.end().id};
}

Result<void> MeasurementsStore::append_linked(std::span<const MeasurementRow> rows) {
  for (const MeasurementRow& row : rows) {
    if (row.correction_of) {
      if (Result<void> open = statements_->require_current(*row.correction_of); !open) {
        return open.error();
      }
    }
    if (row.table_revision) statements_->require_revision(*row.table_revision);
  }
  statements_->insert.append(rows);
  return {};
}

MeasurementChain::End MeasurementsStore::chain_end() const { return statements_->chain_end(); }

bool MeasurementsStore::find(std::int64_t id, const Visitor& visit) const {
  Rows rows = statements_->by_id.query(id);
  if (!rows.next()) return false;
  visit(read_row(rows));
  return true;
}

std::optional<std::int64_t> MeasurementsStore::corrected_by(std::int64_t id) const {
  return statements_->corrected_by(id);
}

std::optional<std::int64_t> MeasurementsStore::list(const MeasurementFilter& filter,
                                                    std::int64_t after, std::size_t limit,
                                                    const Visitor& visit) const {
  std::int64_t last = after;
  std::size_t count = 0;
  bool more = false;
  statements_->whole_rows.run(filter, after, [&](const Rows& rows) {
    // One row more than the page tells that there is a next one.
    more = count++ == limit;
    if (more) return false;
    const MeasurementRow row = read_row(rows);
    visit(row);
    last = row.id;
    return true;
  });
  return more ? std::optional(last) : std::nullopt;
}

bool MeasurementsStore::index_block() { return statements_->lookup.take_in_block(); }

std::int64_t MeasurementsStore::last_id() const { return chain_end().id; }

Result<std::vector<SummaryGroup>> MeasurementsStore::summary(const MeasurementFilter& filter,
                                                             GroupBy group_by,
                                                             std::size_t max_groups) const {
  std::map<std::optional<std::string>, Gathered, std::less<>> groups;
  bool fits = true;
  statements_->values_by(group_by).run(filter, 0, [&](const Rows& rows) {
    const auto value = rows.get<std::optional<std::string_view>>(0);
    auto group = groups.find(value);
    if (group == groups.end()) {
      fits = groups.size() < max_groups;
      if (!fits) return false;
      group = groups.try_emplace(value ? std::optional(std::string(*value)) : std::nullopt).first;
    }
    group->second.add(rows.get<Verdict>(1), rows.get<std::int64_t>(2));
    return true;
  });
  if (!fits) {
    return Error{ErrorCode::QueryInvalid,
                 fmt::format("there are more than {} groups; narrow the filter", max_groups)};
  }
  std::vector<SummaryGroup> summary;
  summary.reserve(groups.size());
  for (auto& [value, gathered] : groups) summary.push_back(gathered.finish(value));
  return summary;
}

}  // namespace fitgauge::store
