#include "db/store/pair_statistics.hpp"

#include <utility>

namespace fitgauge::store {

std::size_t count_of(const PairStatistics& pairs) {
  std::size_t count = 0;
  for (const auto& [value, by_values] : pairs) {
    for (const auto& [by_value, kinds] : by_values) count += kinds.size();
  }
  return count;
}

std::string encode(const PairStatistics& pairs) {
  std::string bytes;
  for (const auto& [value, by_values] : pairs) {
    std::string section;
    for (const auto& [by_value, kinds] : by_values) {
      append_text(section, by_value);
      append_number(section, kinds.size());
      for (const auto& [kind, statistics] : kinds) {
        append_number(section, static_cast<unsigned>(kind));
        statistics.pack(section);
      }
    }
    append_text(bytes, value);
    append_number(bytes, section.size());
    bytes += section;
  }
  return bytes;
}

void PairCounter::add(const BlockColumns& block) {
  for (std::size_t column = 0; column < kBlockColumns; ++column) add(block, column);
  for (std::size_t row = 0; row < kBlockRows; ++row) {
    const std::size_t kind = block.kind_of_row(row);
    if (!block.is_current(kind)) continue;
    kinds_.push_back(static_cast<std::uint8_t>(block.kind(kind)));
    measured_nm_.push_back(block.measured_nm(row));
  }
}

void PairCounter::add(const BlockColumns& block, std::size_t column) {
  NumberedColumn& all = columns_[column];
  BlockColumns::Column found;
  if (!all.fits()) return;
  if (!block.read(column, found)) return all.give_up();
  const std::vector<std::uint16_t> numbers = all.numbers_of(found.values);
  for (std::size_t row = 0; row < kBlockRows; ++row) {
    if (block.is_current(block.kind_of_row(row))) all.add(numbers[found.rows[row]]);
  }
}

void PairCounter::visit_pairs(std::size_t most, const Visitor& visit) const {
  for (std::size_t a = 0; a < kBlockColumns; ++a) {
    for (std::size_t b = a + 1; b < kBlockColumns; ++b) {
      if (columns_[a].fits() && columns_[b].fits()) visit_pair(a, b, most, visit);
    }
  }
}

void PairCounter::visit_pair(std::size_t a, std::size_t b, std::size_t most,
                             const Visitor& visit) const {
  const NumberedColumn& of = columns_[a];
  const NumberedColumn& by = columns_[b];
  struct Slot {
    std::size_t place = 0;
    ExactStatistics statistics{};
  };
  std::vector<Slot> slots;
  std::vector<std::uint32_t> slot_at(of.values().size() * by.values().size() * kKinds);  // and one
  for (std::size_t row = 0; row < measured_nm_.size(); ++row) {
    const std::size_t place =
        (of.rows()[row] * by.values().size() + by.rows()[row]) * kKinds + kinds_[row];
    std::uint32_t& slot = slot_at[place];
    if (slot == 0) {
      if (slots.size() == most) return;
      slots.push_back({.place = place});
      slot = static_cast<std::uint32_t>(slots.size());
    }
    slots[slot - 1].statistics.add(measured_nm_[row]);
  }
  PairStatistics pairs, back;
  for (const auto& [place, statistics] : slots) {
    const auto kind = static_cast<int>(place % kKinds);
    const auto& value = *of.values()[place / kKinds / by.values().size()];
    const auto& by_value = *by.values()[place / kKinds % by.values().size()];
    if (value) pairs[*value][by_value][kind] = statistics;
    if (by_value) back[*by_value][value][kind] = statistics;
  }
  visit(a, b, std::move(pairs));
  visit(b, a, std::move(back));
}

TupleWriter PairCounter::tuples(std::size_t most) const {
  TupleWriter tuples(columns_, kinds_, most);
  for (std::size_t row = 0; row < measured_nm_.size(); ++row) tuples.add(row, measured_nm_[row]);
  return tuples;
}

}  // namespace fitgauge::store
