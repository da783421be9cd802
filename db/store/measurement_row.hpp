#pragma once

#include "base/digest.hpp"
#include "record/fields.hpp"

namespace fitgauge::store {

using app::Source;
using gauging::Quantity;
using gauging::Verdict;
using iso286::Feature;
using Basis = app::LimitsBasis;
using Rule = gauging::DecisionRule::Kind;
enum class RunStatus : std::uint8_t;

// Returns the greatest value of a stored enumeration.
constexpr Source last_of(Source) { return Source::Simulation; }
constexpr Feature last_of(Feature) { return Feature::Shaft; }
constexpr Basis last_of(Basis) { return Basis::Bare; }
constexpr Verdict last_of(Verdict) { return Verdict::Unjudged; }
constexpr Quantity last_of(Quantity) { return Quantity::Deviation; }
constexpr Rule last_of(Rule) { return Rule::Conformance; }

template <class Value, class... Those>
inline constexpr bool kIsOneOf = (std::is_same_v<Value, Those> || ...);

/// The code of a value in the database: never change one, never use one again. Codes count from 1,
/// also of an enumeration that counts from 0.
template <class Value>
constexpr std::int64_t code_of(Value value) {
  constexpr bool kIsFromZero =
      kIsOneOf<Value, Source, Feature, Basis, Verdict, Quantity, Rule, RunStatus>;
  return static_cast<std::int64_t>(value) + (kIsFromZero ? 1 : 0);
}
static_assert(code_of(Verdict::Unjudged) == 5 && code_of(Quantity::Deviation) == 8);

/// One stored measurement. Lengths in nm, times in ns since 1970 (UTC), scaled numbers in
/// millionths. Texts are views. In an append they point to the caller's memory until the job is
/// done. In a visitor they point to the database's memory while it runs.
struct MeasurementRow : app::MeasurementFields {
  std::int64_t id = 0;  ///< rising without gaps
  std::int64_t measured_at_ns = 0;
  std::int64_t received_at_ns = 0;

  std::int64_t nominal_nm = 0;                        ///< 0 when the basis is Bare
  std::optional<std::string_view> tolerance_class{};  ///< none unless the basis is a standard
  std::int64_t upper_deviation_nm = 0;                ///< without that limit: 2e15
  std::int64_t lower_deviation_nm = 0;                ///< and here -2e15
  std::optional<std::int64_t> size_over_nm{};         ///< the step of the standard tolerance
  std::optional<std::int64_t> size_up_to_nm{};        ///< both or neither
  std::optional<std::int64_t> table_revision{};       ///< TableRevision::number; none for Explicit

  std::int64_t measured_nm = 0;
  Verdict verdict = Verdict::Good;
  Rule rule = Rule::Simple;
  std::optional<std::int64_t> uncertainty_nm{};   ///< standard uncertainty u
  std::optional<std::int64_t> coverage_factor{};  ///< k in millionths: 2'000'000 is k = 2

  std::optional<std::int64_t> correction_of{};  ///< id of the row this one replaces
  // Only for rule Conformance:
  std::optional<std::int64_t> probability{};  ///< asked for, in millionths
  std::optional<std::int64_t> conformance{};  ///< found, in 1e-9
  std::optional<std::int64_t> guard_band{};   ///< in fm

  std::optional<std::int64_t> corrected_nm{};  ///< the size at 20 °C, if the verdict uses it
  // Only for rows that another folder has forwarded, and for rows stored with them:
  std::optional<std::int64_t> origin{};  ///< OriginsStore::Origin::number; 0 is this folder
  std::optional<std::int64_t> seq{};     ///< in the log of its origin; none: equals the id
  std::optional<std::int64_t> number{};  ///< in its id there; none: equals the seq
  /// The id of correction_of in the folder that stored it; none: this folder.
  std::optional<std::int64_t> corrected_origin{};
  std::optional<std::int64_t> corrected_number{};

  Digest hash{};  ///< of its leaf in the log

  bool is_forwarded() const { return origin.value_or(0) > 0; }
  /// Place in the log of its origin, from 1.
  std::int64_t place_in_log() const { return seq.value_or(id); }
  /// The number in its public id.
  std::int64_t public_number() const { return is_forwarded() ? number.value_or(*seq) : id; }

  std::int64_t upper_limit_nm() const { return nominal_nm + upper_deviation_nm; }
  std::int64_t lower_limit_nm() const { return nominal_nm + lower_deviation_nm; }
};

/// The input of figures: a measured value, its limits and its group.
struct MeasuredValue {
  std::int64_t measured_nm = 0;  ///< at 20 °C if it was corrected
  std::int64_t lower_limit_nm = 0;
  std::int64_t upper_limit_nm = 0;
  std::optional<std::string_view> subgroup{};  ///< memory of the database while a visitor runs
};

/// Values of one folder, in storage order, that share their limits and their subgroup.
struct MeasuredRun {
  struct Value {
    std::int64_t id = 0;
    std::int64_t number = 0;  ///< in its public id
    std::int64_t measured_nm = 0;
  };

  std::int64_t lower_limit_nm = 0;
  std::int64_t upper_limit_nm = 0;
  std::optional<std::string_view> subgroup{};
  std::int64_t origin = 0;  ///< 0: of this folder
  std::span<const Value> values{};
};

/// Counts and statistics of one group, from exact integer sums.
struct SummaryGroup {
  std::optional<std::string> value{};  ///< none: the rows without the field
  std::int64_t count = 0;
  std::array<std::int64_t, 5> verdicts{};              ///< by Verdict, Good first
  std::string mean_mm{};                               ///< to 1e-12 mm, shortest decimal
  std::optional<std::string> standard_deviation_mm{};  ///< of n - 1; none for a single value
  std::int64_t min_nm = 0;
  std::int64_t max_nm = 0;
};

/// Calls `field(column, value)` for every field of a measurement except its id and hash. The only
/// place that maps rows to columns.
template <class Row, class Field>
constexpr void for_each_field(Row&& row, Field&& field) {
  field("source", row.source);
  field("measured_at", row.measured_at_ns);
  field("received_at", row.received_at_ns);
  field("nominal_nm", row.nominal_nm);
  field("tolerance_class", row.tolerance_class);
  field("feature", row.feature);
  field("upper_deviation_nm", row.upper_deviation_nm);
  field("lower_deviation_nm", row.lower_deviation_nm);
  field("size_over_nm", row.size_over_nm);
  field("size_up_to_nm", row.size_up_to_nm);
  field("basis", row.basis);
  field("table_revision", row.table_revision);
  field("measured_nm", row.measured_nm);
  field("verdict", row.verdict);
  field("rule", row.rule);
  field("uncertainty_nm", row.uncertainty_nm);
  field("coverage_factor", row.coverage_factor);
  field("run_id", row.run_id);
  field("correction_of", row.correction_of);
  field("probability", row.probability);
  field("conformance", row.conformance);
  field("guard_band", row.guard_band);
  field("corrected_nm", row.corrected_nm);
  field("origin", row.origin);
  field("seq", row.seq);
  field("number", row.number);
  field("corrected_origin", row.corrected_origin);
  field("corrected_number", row.corrected_number);
  field("quantity", row.quantity);
  field("form_nm", row.form);
  app::for_each_plain(
      [&](const app::MeasurementField& plain, auto member) { field(plain.column, row.*member); });
}

/// `id, source, …, hash`
inline std::string measurement_columns() {
  std::string columns = "id";
  const MeasurementRow row;
  for_each_field(row, [&](std::string_view column, const auto&) {
    columns += ", ";
    columns += column;
  });
  return columns + ", hash";
}

}  // namespace fitgauge::store
