#include "api/statistics/value_selection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace fitgauge::api {
namespace {

using metrology::Decimals;
using metrology::Wide;

constexpr int kDecimals = 6;  // a nanometre in mm

Error none_selected() {
  return {ErrorCode::StatisticsTooFew,
          "no stored value matches; look at what GET /v1/measurements lists with these filters"};
}

Error unbalanced(std::string what) {
  return {ErrorCode::StatisticsUnbalanced,
          std::move(what) +
              "; narrow the selection, or take the values one by one with "
              "subgroups=ignore"};
}

}  // namespace

metrology::Exact exact_mm(Length length) {
  return {metrology::Integer(length.count()), metrology::power_of_ten(kDecimals)};
}

void MeasurementIds::add(std::int64_t number, std::string_view origin) {
  constexpr std::int64_t kMost = std::numeric_limits<std::uint32_t>::max();
  const auto fits = [&](const Part& part) {
    return part.origin == origin && number >= part.base && number - part.base <= kMost;
  };
  if (parts_.empty() || !fits(parts_.back())) parts_.push_back({offsets_.size(), number, origin});
  offsets_.push_back(static_cast<std::uint32_t>(number - parts_.back().base));
}

std::string MeasurementIds::text(std::size_t index) const {
  const auto later = [](std::size_t at, const Part& part) { return at < part.begin; };
  const Part& part = *std::prev(std::upper_bound(parts_.begin(), parts_.end(), index, later));
  return app::measurement_id_text(part.base + offsets_.at(index), part.origin);
}

std::string ValueSelection::text_of(const Limits& limits) {
  if (!limits.lower) return fmt::format("up to {} mm", format_mm(*limits.upper));
  if (!limits.upper) return fmt::format("{} mm or more", format_mm(*limits.lower));
  return fmt::format("{} to {} mm", format_mm(*limits.lower), format_mm(*limits.upper));
}

Result<void> ValueSelection::add(const app::MeasuredRun& run) {
  const Limits limits{run.lower_limit, run.upper_limit};
  if (!limits_) limits_ = limits;
  if (limits != *limits_) {
    return Error{
        ErrorCode::LimitsMixed,
        fmt::format("{} has the limits {}, {} has {}: select values of one size by "
                    "characteristic or designation",
                    ids_.text(0), text_of(*limits_),
                    app::measurement_id_text(run.values.front().id, run.origin), text_of(limits))};
  }
  names_subgroups_ = names_subgroups_ || run.subgroup.has_value();
  if (!run.subgroup && !ungrouped_) {
    ungrouped_ = app::measurement_id_text(run.values.front().id, run.origin);
  }
  if (!ungrouped_) join(*run.subgroup, run.values.size());
  if (bytes_ + ids_.bytes() + counts_.size() * sizeof(Wide) > most_bytes_) {
    return Error{ErrorCode::StatisticsTooMany,
                 fmt::format("more than {} values match, which is what one figure takes: narrow "
                             "the selection, by from and to for instance",
                             counts_.size())};
  }
  if (counts_.empty())
    counts_.reserve(most_bytes_ / sizeof(Wide));  // only what is written to is memory
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

Result<SelectedValues> ValueSelection::selected() {
  if (counts_.empty()) return none_selected();
  const auto exact = [](const std::optional<Length>& limit) {
    return limit ? std::optional(exact_mm(*limit)) : std::nullopt;
  };
  return SelectedValues{.data = {},
                        .limits = {.lower = exact(limits_->lower), .upper = exact(limits_->upper)},
                        .lower_limit = limits_->lower,
                        .upper_limit = limits_->upper,
                        .count = counts_.size(),
                        .first_id = ids_.text(0),
                        .last_id = ids_.text(ids_.size() - 1)};
}

Result<SelectedValues> ValueSelection::one_by_one() && {
  auto made = selected();
  if (!made) return made;
  made->data = {.values = Decimals(std::move(counts_), kDecimals)};
  made->ids = std::move(ids_);
  return made;
}

Result<SelectedValues> ValueSelection::by_subgroup() && {
  auto made = selected();
  if (!made) return made;
  if (ungrouped_) {
    return unbalanced(fmt::format("measurement {} names no subgroup", *ungrouped_));
  }
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
                 "each subgroup has one value; take the values one by one with subgroups=ignore"};
  }
  std::vector<std::size_t> ends(names_.size());
  for (std::size_t i = 0; i < ends.size(); ++i) ends[i] = i * size;
  std::vector<Wide> sorted(counts_.size());
  for (std::size_t i = 0; i < counts_.size(); ++i) sorted[ends[groups_[i]]++] = counts_[i];
  counts_ = {};
  made->data = {.values = Decimals(std::move(sorted), kDecimals), .size = size};
  made->subgroups.reserve(names_.size());
  for (const std::string* name : names_) made->subgroups.push_back(*name);
  return made;
}

}  // namespace fitgauge::api
