#pragma once

#include <random>

#include "fixture.hpp"

namespace fitgauge::store::test {

/// Few values, so that filters meet many rows.
inline const std::string kTexts[] = {"", "A", "B", "a", "C"};

inline std::optional<std::string> any_text(std::mt19937& random) {
  const auto choice = random() % 6;
  return choice == 5 ? std::nullopt : std::optional(kTexts[choice]);
}

/// Rows whose texts are kept here, as the row has views only.
struct Sample {
  Sample(unsigned seed, std::size_t size) {
    std::mt19937 random(seed);
    texts.reserve(size * kTextColumns.size());
    for (std::size_t i = 0; i < size; ++i) {
      MeasurementRow row = sample_row();
      for (const TextColumn& column : kTextColumns) {
        if (column.field == TextField::ToleranceClass) continue;
        texts.push_back(any_text(random));
        if (texts.back()) row.*column.text = *texts.back();
      }
      // The clocks go forth and back.
      row.measured_at_ns = static_cast<std::int64_t>(i + random() % 2000);
      row.received_at_ns = static_cast<std::int64_t>(i + random() % 300);
      row.source = random() % 4 == 0 ? Source::Simulation : Source::Gauge;
      if (row.source == Source::Simulation) row.run_id = 1 + random() % 5;
      row.nominal_nm += static_cast<std::int64_t>(random() % 2);
      row.measured_nm += static_cast<std::int64_t>(random() % 9000);
      row.verdict = row.measured_nm > row.upper_limit_nm() ? Verdict::Reject : Verdict::Good;
      if (i % 7 == 0) row.confirmed = 1;
      rows.push_back(row);
    }
  }

  /// Some of the later rows correct earlier ones, once each, and corrections are corrected too.
  void add_corrections(std::mt19937& random, std::size_t count) {
    while (count > 0) {
      const std::size_t later = random() % rows.size();
      const std::size_t earlier = random() % rows.size();
      if (earlier >= later || rows[later].correction_of || corrections.contains(earlier)) continue;
      correct(earlier, later);
      --count;
    }
  }

  /// The same, some of them twice and more often: made apart from each other.
  void add_rivals(std::mt19937& random, std::size_t count) {
    for (; count > 0; --count) {
      const std::size_t later = 1 + random() % (rows.size() - 1);
      if (rows[later].correction_of) continue;
      const auto known = std::next(
          corrections.begin(), static_cast<std::ptrdiff_t>(random() % (corrections.size() + 1)));
      // One that was corrected, or that corrects one, or any.
      const std::size_t choices[] = {random() % rows.size(),
                                     known == corrections.end() ? 0 : known->first,
                                     known == corrections.end() ? 0 : known->second};
      const std::size_t earlier = choices[random() % 3];
      if (earlier < later) correct(earlier, later);
    }
  }

  void correct(std::size_t earlier, std::size_t later) {
    rows[later].correction_of = static_cast<std::int64_t>(earlier) + 1;
    rows[later].correction_reason = "wrong";
    corrections.emplace(earlier, later);
  }

  /// When a row was received; its hash where that is the same.
  std::pair<std::int64_t, Digest> moment(std::size_t i) const {
    MeasurementRow row = rows[i];
    row.id = static_cast<std::int64_t>(i) + 1;
    return {row.received_at_ns, hash_of(row)};
  }

  /// @param end rows from here on are not there yet
  bool is_current(std::size_t i, std::size_t end) const {
    const auto is_there = [end](const auto& correction) { return correction.second < end; };
    const auto [first, last] = corrections.equal_range(i);
    if (std::any_of(first, last, is_there)) return false;
    for (std::size_t at = i; rows[at].correction_of;) {
      const auto target = static_cast<std::size_t>(*rows[at].correction_of - 1);
      const auto [rival, behind] = corrections.equal_range(target);
      const bool lost = std::any_of(rival, behind, [&](const auto& correction) {
        return is_there(correction) && moment(correction.second) > moment(at);
      });
      if (lost) return false;
      at = target;
    }
    return true;
  }

  bool matches(std::size_t i, const MeasurementFilter& filter) const {
    const MeasurementRow& row = rows[i];
    const auto id = static_cast<std::int64_t>(i) + 1;
    const auto as_of = filter.as_of_id.value_or(std::numeric_limits<std::int64_t>::max());
    return id <= as_of &&
           (filter.history ||
            is_current(i, static_cast<std::size_t>(std::min<std::int64_t>(as_of, 1'000'000)))) &&
           std::all_of(kTextColumns.begin(), kTextColumns.end(),
                       [&](const TextColumn& column) {
                         const auto& wanted = filter.text(column.field);
                         return !wanted || row.*column.text == wanted;
                       }) &&
           (!filter.run_id || row.run_id == filter.run_id) &&
           (!filter.verdict || row.verdict == filter.verdict) &&
           (!filter.source || row.source == filter.source) &&
           (!filter.from_ns || row.measured_at_ns >= *filter.from_ns) &&
           (!filter.to_ns || row.measured_at_ns < *filter.to_ns) &&
           (!filter.received_from_ns || row.received_at_ns >= *filter.received_from_ns) &&
           (!filter.received_to_ns || row.received_at_ns < *filter.received_to_ns) &&
           (!filter.has_notes || notes.contains(i)) &&
           (!filter.confirmed || row.confirmed.has_value() == *filter.confirmed) &&
           (!filter.set_aside || (set_aside.contains(i) && set_aside.at(i)) == *filter.set_aside) &&
           (!filter.cause || has_note(i, *filter.cause));
  }

  bool has_note(std::size_t i, const std::string& cause) const {
    const auto [first, last] = notes.equal_range(i);
    return std::any_of(first, last, [&](const auto& note) { return note.second == cause; });
  }

  std::vector<std::int64_t> ids(const MeasurementFilter& filter) const {
    std::vector<std::int64_t> found;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (matches(i, filter)) found.push_back(static_cast<std::int64_t>(i) + 1);
    }
    return found;
  }

  std::vector<std::optional<std::string>> texts;
  std::vector<MeasurementRow> rows;
  std::multimap<std::size_t, std::size_t> corrections;
  std::multimap<std::size_t, std::optional<std::string>> notes;  ///< causes
  std::map<std::size_t, bool> set_aside;  ///< by the newest note that decides
};

inline void add_notes(Fixture& fixture, Sample& sample, std::mt19937& random, std::size_t count) {
  for (; count > 0; --count) {
    Note note;
    const std::size_t i = random() % sample.rows.size();
    note.measurement = static_cast<std::int64_t>(i) + 1;
    note.cause = any_text(random);
    note.text = "seen";
    if (random() % 2 == 0) {
      // Most words decide nothing.
      const std::string measures[] = {"set aside", "counted again", "Set aside", "set aside "};
      note.measure = measures[random() % 4];
      if (note.measure == measures[0] || note.measure == measures[1])
        sample.set_aside[i] = note.measure == measures[0];
    }
    sample.notes.emplace(i, note.cause);
    fixture.change([&](Stores& stores) { stores.notes.append(note); });
  }
}

inline TextField any_field(std::mt19937& random) {
  return kTextColumns[random() % kTextColumns.size()].field;
}

inline MeasurementFilter any_filter(std::mt19937& random, std::size_t size) {
  MeasurementFilter filter;
  for (int i = 0; i < 2; ++i) {
    if (random() % 2 == 0) filter.text(any_field(random)) = any_text(random);
  }
  if (random() % 6 == 0) filter.run_id = 1 + random() % 6;
  if (random() % 3 == 0) filter.verdict = Verdict::Reject;
  if (random() % 2 == 0) filter.source.reset();
  const auto time = [&](auto& bound) {
    if (random() % 4 == 0) bound = static_cast<std::int64_t>(random() % (size + 2000));
  };
  time(filter.from_ns), time(filter.to_ns);
  time(filter.received_from_ns), time(filter.received_to_ns);
  filter.history = random() % 3 == 0;
  if (random() % 4 == 0) filter.as_of_id = random() % (size + 10);
  if (random() % 6 == 0) filter.cause = kTexts[random() % 5];
  filter.has_notes = random() % 8 == 0;
  if (random() % 6 == 0) filter.confirmed = random() % 2 == 0;
  if (random() % 4 == 0) filter.set_aside = random() % 3 == 0;
  return filter;
}

}  // namespace fitgauge::store::test
