#include "api/statistics/value_selection.hpp"

#include "base/allowance.hpp"

namespace fitgauge::api {
namespace {

using metrology::Decimals;
using metrology::Wide;

constexpr int kDecimalsOfMm = 6;  // a nanometre in mm

Error none_selected() {
  return {ErrorCode::StatisticsTooFew,
          "no stored value matches: check the list of GET /v1/measurements with these filters"};
}

Error unbalanced(std::string what) {
  return {ErrorCode::StatisticsUnbalanced,
          std::move(what) + "; narrow the selection, or use single values with subgroups=ignore"};
}

}  // namespace

metrology::Exact exact_mm(Length length) {
  return {metrology::Integer(length.count()), metrology::power_of_ten(kDecimalsOfMm)};
}

void MeasurementIds::add(std::int64_t number, std::string_view origin) {
  constexpr std::int64_t kMost = std::numeric_limits<std::uint32_t>::max();
  const auto fits = [&](const Part& part) {
    return part.origin == origin && number >= part.base && number - part.base <= kMost;
  };
  if (parts_.empty() || !fits(parts_.back())) parts_.push_back({offsets_.size(), number, origin});
  offsets_.push_back(static_cast<std::uint32_t>(number - parts_.back().base));
}

const MeasurementIds::Part& MeasurementIds::part_of(std::size_t index) const {
  const auto later = [](std::size_t at, const Part& part) { return at < part.begin; };
  return *std::prev(std::upper_bound(parts_.begin(), parts_.end(), index, later));
}

std::string MeasurementIds::text(std::size_t index) const {
  const Part& part = part_of(index);
  return app::measurement_id_text(part.base + offsets_.at(index), part.origin);
}

MeasurementIds MeasurementIds::in_order(const std::vector<std::uint32_t>& order) const {
  MeasurementIds ids;
  ids.offsets_.reserve(order.size());
  for (const std::uint32_t index : order) {
    const Part& part = part_of(index);
    ids.add(part.base + offsets_[index], part.origin);
  }
  return ids;
}

std::string ValueSelection::text_of(const Limits& limits) {
  if (!limits.lower) return fmt::format("up to {} mm", format_mm(*limits.upper));
  if (!limits.upper) return fmt::format("{} mm or more", format_mm(*limits.lower));
  return fmt::format("{} to {} mm", format_mm(*limits.lower), format_mm(*limits.upper));
}

Result<void> ValueSelection::read(app::MeasurementService& measurements,
                                  const app::MeasurementQuery& query) {
  auto values = TRY(
      measurements.read_values(query, [this](const app::MeasuredRun& run) { return add(run); }));
  move(values.moves);
  as_of_ = std::move(values.as_of);
  return {};
}

Result<void> ValueSelection::add(const app::MeasuredRun& run) {
  if (Allowance::of_thread().is_spent()) {
    return Error{ErrorCode::FiguresLimit,
                 "the selection needs more time or memory than one request may use"};
  }
  Limits limits{run.lower_limit, run.upper_limit};
  // Early versions stored the longest length for a limit that was absent.
  if (limits.lower == -kLongest) limits.lower.reset();
  if (limits.upper == kLongest) limits.upper.reset();
  if (!limits.lower && !limits.upper) {
    return Error::of(ErrorCode::LimitsNone,
                     "{} has no limits: select judged values, by verdict or characteristic",
                     app::measurement_id_text(run.values.front().id, run.origin));
  }
  if (!limits_) limits_ = limits;
  if (limits != *limits_) {
    return Error::of(ErrorCode::LimitsMixed,
                     "{} has the limits {}, {} has {}: select values of one size by "
                     "characteristic or designation",
                     ids_.text(0), text_of(*limits_),
                     app::measurement_id_text(run.values.front().id, run.origin), text_of(limits));
  }
  names_subgroups_ = names_subgroups_ || run.subgroup.has_value();
  if (!run.subgroup && !ungrouped_)
    ungrouped_ = app::measurement_id_text(run.values.front().id, run.origin);
  if (!ungrouped_) join(*run.subgroup, run.values.size());
  if (bytes_ + ids_.bytes() + counts_.size() * sizeof(Wide) > most_bytes_) {
    return Error::of(ErrorCode::StatisticsTooMany,
                     "more than {} values match, the most for one figure: narrow the "
                     "selection, for example by from and to",
                     counts_.size());
  }
  if (counts_.empty())
    counts_.reserve(most_bytes_ / sizeof(Wide));  // only written pages need memory
  for (const auto& value : run.values) {
    counts_.push_back(value.measured.count());
    ids_.add(value.id, run.origin);
  }
  return {};
}

void ValueSelection::join(std::string_view subgroup, std::size_t values) {
  constexpr std::size_t kOfAName = 96;  // its places in the map and in the lists
  bytes_ += values * sizeof(std::uint32_t);
  if (groups_.empty() || *names_[groups_.back()] != subgroup) {
    const auto [found, is_new] =
        numbers_.try_emplace(std::string(subgroup), static_cast<std::uint32_t>(names_.size()));
    if (is_new) {
      names_.push_back(&found->first);
      bytes_ += kOfAName + 2 * subgroup.size();
    }
    groups_.push_back(found->second);
    --values;
  }
  groups_.insert(groups_.end(), values, groups_.back());
}

void ValueSelection::move(const std::vector<app::MovedValue>& moves) {
  if (moves.empty()) return;
  std::vector<bool> is_moved(counts_.size());
  for (const app::MovedValue& value : moves) is_moved[value.from] = true;
  std::vector<std::uint32_t> order;
  order.reserve(counts_.size());
  auto next = moves.begin();
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    for (; next != moves.end() && next->to <= i; ++next)
      order.push_back(static_cast<std::uint32_t>(next->from));
    if (!is_moved[i]) order.push_back(static_cast<std::uint32_t>(i));
  }
  const auto in_order = [&order](const auto& of) {
    std::remove_cvref_t<decltype(of)> sorted;
    sorted.reserve(order.size());
    for (const std::uint32_t index : order) sorted.push_back(of[index]);
    return sorted;
  };
  counts_ = in_order(counts_);
  ids_ = ids_.in_order(order);
  if (ungrouped_) return;
  groups_ = in_order(groups_);
  // The subgroups are in the order of their first value.
  constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(names_.size(), kNone);
  std::vector<const std::string*> names;
  for (std::uint32_t& group : groups_) {
    if (number[group] == kNone) {
      number[group] = static_cast<std::uint32_t>(names.size());
      names.push_back(names_[group]);
    }
    group = number[group];
  }
  names_ = std::move(names);
}

Result<SelectedValues> ValueSelection::described() {
  if (counts_.empty()) return none_selected();
  const auto exact = [](const std::optional<Length>& limit) {
    return limit ? std::optional(exact_mm(*limit)) : std::nullopt;
  };
  SelectedValues made;
  made.limits = {.lower = exact(limits_->lower), .upper = exact(limits_->upper)};
  made.lower_limit = limits_->lower;
  made.upper_limit = limits_->upper;
  made.count = counts_.size();
  made.first_id = ids_.text(0);
  made.last_id = ids_.text(ids_.size() - 1);
  made.as_of = as_of_;
  return made;
}

Result<SelectedValues> ValueSelection::one_by_one() && {
  auto made = described();
  if (!made) return made;
  made->data = {.values = Decimals(std::move(counts_), kDecimalsOfMm)};
  made->ids = std::move(ids_);
  return made;
}

Result<SelectedValues> ValueSelection::by_subgroup() && {
  auto made = described();
  if (!made) return made;
  if (ungrouped_) return unbalanced(fmt::format("measurement {} names no subgroup", *ungrouped_));
  std::vector<std::size_t> sizes(names_.size());
  for (const std::uint32_t group : groups_) ++sizes[group];
  const std::size_t size = sizes.front();
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (sizes[i] == size) continue;
    return unbalanced(fmt::format("subgroup '{}' has {} values, subgroup '{}' has {}", *names_[i],
                                  sizes[i], *names_.front(), size));
  }
  if (size < 2) {
    return Error{ErrorCode::StatisticsTooFew,
                 "each subgroup has one value: use single values with subgroups=ignore"};
  }
  std::vector<std::size_t> ends(names_.size());
  for (std::size_t i = 0; i < ends.size(); ++i) ends[i] = i * size;
  std::vector<Wide> sorted(counts_.size());
  for (std::size_t i = 0; i < counts_.size(); ++i) sorted[ends[groups_[i]]++] = counts_[i];
  counts_ = {};
  made->data = {.values = Decimals(std::move(sorted), kDecimalsOfMm), .size = size};
  made->subgroup_count = names_.size();
  made->subgroups.reserve(names_.size());
  for (const std::string* name : names_) made->subgroups.push_back(*name);
  return made;
}

Result<SelectedValues> ValueSelection::selected(bool ignores_subgroups) && {
  return names_subgroups_ && !ignores_subgroups ? std::move(*this).by_subgroup()
                                                : std::move(*this).one_by_one();
}

Parameter subgroups_parameter() {
  return query("subgroups", http::Words{{"use", "ignore"}},
               "use: by `subgroup` if the values name one; ignore: one by one (default: use)");
}

bool ignores_subgroups(const Request& request) { return request.text("subgroups") == "ignore"; }

}  // namespace fitgauge::api
