#include "db/store/tuple_statistics.hpp"

#include <boost/unordered/unordered_flat_map.hpp>

namespace fitgauge::store {

// A field has the number of its values, the values, and for each tuple the number of its value, a
// byte. A group of tuples has their count, the kind of each, a byte, the size of the statistics of
// each, a byte, and then the statistics.

std::vector<std::uint16_t> NumberedColumn::numbers_of(
    std::span<const std::optional<std::string_view>> values) {
  std::vector<std::uint16_t> numbers;
  numbers.reserve(values.size());
  for (const auto& value : values) {
    const auto next = static_cast<std::uint16_t>(numbers_.size());
    const auto [known, is_new] =
        numbers_.try_emplace(value ? std::optional<std::string>(*value) : std::nullopt, next);
    if (is_new) values_.push_back(&known->first);
    numbers.push_back(known->second);
  }
  fits_ = fits_ && values_.size() <= kMostColumnValues;
  return numbers;
}

TupleWriter::TupleWriter(std::span<const NumberedColumn> columns,
                         std::span<const std::uint8_t> kinds, std::size_t most)
    : columns_(columns), kinds_(kinds), tuple_of_row_(kinds.size()) {
  std::array<std::uint32_t, kKinds> tuple_of_kind{};  // and one
  for (std::size_t row = 0; row < kinds.size(); ++row) {
    std::uint32_t& tuple = tuple_of_kind.at(kinds[row]);
    if (tuple == 0) {
      row_of_tuple_.push_back(row);
      tuple = static_cast<std::uint32_t>(row_of_tuple_.size());
    }
    tuple_of_row_[row] = tuple - 1;
  }
  std::vector<std::size_t> order(columns.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return columns[a].values().size() < columns[b].values().size();
  });
  for (const std::size_t column : order) {
    if (columns[column].fits() && split_by(columns[column], most)) taken_.push_back(column);
  }
  sort();
  std::ranges::sort(taken_);
  statistics_.resize(row_of_tuple_.size());
}

/// By the fields in the order of their addition.
void TupleWriter::sort() {
  std::vector<std::uint32_t> order(row_of_tuple_.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
    const std::size_t row = row_of_tuple_[a], other = row_of_tuple_[b];
    for (const std::size_t column : taken_) {
      const std::uint16_t value = columns_[column].rows()[row];
      const std::uint16_t other_value = columns_[column].rows()[other];
      if (value != other_value) return value < other_value;
    }
    return kinds_[row] < kinds_[other];
  });
  std::vector<std::uint32_t> place(order.size());
  std::vector<std::size_t> row_of_tuple(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    place[order[i]] = static_cast<std::uint32_t>(i);
    row_of_tuple[i] = row_of_tuple_[order[i]];
  }
  for (std::uint32_t& tuple : tuple_of_row_) tuple = place[tuple];
  row_of_tuple_ = std::move(row_of_tuple);
}

/// @returns false, without a change, if there would be more than `most` tuples.
bool TupleWriter::split_by(const NumberedColumn& column, std::size_t most) {
  if (column.values().size() == 1) return true;
  boost::unordered_flat_map<std::uint64_t, std::uint32_t> parts;
  std::vector<std::uint32_t> tuple_of_row(tuple_of_row_.size());
  std::vector<std::size_t> row_of_tuple;
  for (std::size_t row = 0; row < tuple_of_row.size(); ++row) {
    const std::uint64_t part =
        std::uint64_t{tuple_of_row_[row]} * kMostColumnValues + column.rows()[row];
    const auto [found, is_new] =
        parts.try_emplace(part, static_cast<std::uint32_t>(row_of_tuple.size()));
    if (is_new) {
      if (row_of_tuple.size() == most) return false;
      row_of_tuple.push_back(row);
    }
    tuple_of_row[row] = found->second;
  }
  tuple_of_row_ = std::move(tuple_of_row);
  row_of_tuple_ = std::move(row_of_tuple);
  return true;
}

std::string TupleWriter::encode(const NumberedColumn& column) const {
  std::string bytes;
  append_number(bytes, column.values().size());
  for (const auto* value : column.values()) append_text(bytes, *value);
  for (const std::size_t row : row_of_tuple_) bytes += static_cast<char>(column.rows()[row]);
  return bytes;
}

std::string TupleWriter::encode_sums(std::size_t first) const {
  const std::size_t last = std::min(first + kTuplesTogether, row_of_tuple_.size());
  std::string bytes;
  append_number(bytes, last - first);
  for (std::size_t i = first; i < last; ++i) bytes += static_cast<char>(kinds_[row_of_tuple_[i]]);
  std::string statistics;
  for (std::size_t i = first; i < last; ++i) {
    const std::size_t before = statistics.size();
    statistics_[i].pack(statistics);
    bytes += static_cast<char>(statistics.size() - before);
  }
  return bytes + statistics;
}

bool TupleColumn::read(std::string_view bytes) {
  PackedNumbers in(bytes);
  const std::uint64_t count = in.number();
  values.clear();
  for (std::uint64_t i = 0; i < count && in.is_sound(); ++i) values.push_back(in.text());
  numbers = in.rest();
  return in.is_sound() && std::ranges::all_of(numbers, [&](char number) {
           return static_cast<unsigned char>(number) < count;
         });
}

bool TupleColumn::keep(std::string_view value, std::span<std::uint8_t> tuples) const {
  const auto found = std::ranges::find(values, value);
  if (found == values.end()) return false;
  const auto wanted = static_cast<char>(found - values.begin());
  for (std::size_t i = 0; i < tuples.size(); ++i) {
    tuples[i] = static_cast<std::uint8_t>(tuples[i] & (numbers[i] == wanted ? 1U : 0U));
  }
  return true;
}

bool TupleSums::read(std::string_view bytes) {
  PackedNumbers in(bytes);
  const std::uint64_t size = in.number();
  kinds_ = in.bytes(size);
  sizes_ = in.bytes(size);
  const auto is_kind = [](char kind) { return static_cast<unsigned char>(kind) < kKinds; };
  const auto add = [](std::size_t sum, char n) { return sum + static_cast<unsigned char>(n); };
  statistics_ = in.bytes(std::accumulate(sizes_.begin(), sizes_.end(), std::size_t{0}, add));
  return in.is_at_end() && size > 0 && std::ranges::all_of(kinds_, is_kind);
}

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
