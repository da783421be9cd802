#include "db/store/block_columns.hpp"

namespace fitgauge::store {
namespace {

// A column has its size in bytes, the number of its values, the values, and for each row the number
// of its value. Then come the kinds, a byte each, the smallest length, the bits of a distance, the
// distance of each row from that length, and padding.

unsigned bits_for(std::size_t count) { return static_cast<unsigned>(std::bit_width(count - 1)); }

/// @returns false unless there are `count` numbers, each below it.
bool read_rows(PackedNumbers& in, std::size_t count, NumberRow& rows) {
  const unsigned bits = bits_for(count);
  const std::string_view bytes = in.bytes(NumberRow::size(kBlockRows, bits));
  if (!in.is_sound()) return false;
  rows = NumberRow(bytes.data(), bits);
  if (std::has_single_bit(count)) return true;
  for (std::size_t row = 0; row < kBlockRows; ++row) {
    if (rows[row] >= count) return false;
  }
  return true;
}

}  // namespace

template <class Value>
void BlockColumnsWriter::Column<Value>::add(const Value& value) {
  if (numbers.size() > kMostColumnValues) return;
  const auto [found, is_new] =
      numbers.try_emplace(value, static_cast<std::uint16_t>(numbers.size()));
  if (is_new) values.push_back(&found->first);
  rows.push_back(found->second);
}

void BlockColumnsWriter::add_text(std::size_t column, std::optional<std::string_view> value) {
  texts_.at(column).add(value ? std::optional(std::string(*value)) : std::nullopt);
}

void BlockColumnsWriter::repeat_text(std::size_t column) {
  auto& rows = texts_.at(column).rows;
  rows.push_back(rows.back());
}

void BlockColumnsWriter::add(int kind, bool is_current, std::int64_t measured_nm) {
  kinds_.add(static_cast<std::uint8_t>(kind | (is_current ? 0 : 0x80)));
  measured_nm_.push_back(measured_nm);
}

std::optional<std::string> BlockColumnsWriter::encode() const {
  if (measured_nm_.size() != kBlockRows) return std::nullopt;
  const auto [least, greatest] = std::ranges::minmax_element(measured_nm_);
  const auto distance_of = [from = *least](std::int64_t nm) {
    return static_cast<std::uint64_t>(nm) - static_cast<std::uint64_t>(from);
  };
  const auto bits = static_cast<unsigned>(std::bit_width(distance_of(*greatest)));
  if (bits > NumberRow::kMostBits) return std::nullopt;

  std::string bytes;
  for (const auto& column : texts_) {
    std::string section;
    const bool fits = column.numbers.size() <= kMostColumnValues;
    append_number<std::uint64_t>(section, fits ? column.values.size() : 0);
    if (fits) {
      for (const auto* value : column.values) append_text(section, *value);
      NumberRow::append<std::uint16_t>(section, column.rows, bits_for(column.values.size()));
    }
    append_number<std::uint64_t>(bytes, section.size());
    bytes += section;
  }
  append_number<std::uint64_t>(bytes, kinds_.values.size());
  for (const std::uint8_t* kind : kinds_.values) bytes += static_cast<char>(*kind);
  NumberRow::append<std::uint16_t>(bytes, kinds_.rows, bits_for(kinds_.values.size()));
  append_difference(bytes, *least, 0);
  append_number(bytes, bits);
  std::vector<std::uint64_t> distances(measured_nm_.size());
  std::ranges::transform(measured_nm_, distances.begin(), distance_of);
  NumberRow::append<std::uint64_t>(bytes, distances, bits);
  return bytes.append(NumberRow::kPadding, '\0');
}

bool BlockColumns::read(std::string_view bytes) {
  if (bytes.size() < NumberRow::kPadding) return false;
  PackedNumbers in(bytes.substr(0, bytes.size() - NumberRow::kPadding));
  for (std::string_view& column : columns_) {
    column = in.bytes(in.number());
    if (!in.is_sound()) return false;
  }
  const std::uint64_t count = in.number();
  kinds_ = in.bytes(count);
  if (kinds_.empty() || !read_rows(in, kinds_.size(), kind_rows_)) return false;
  least_nm_ = in.above(0);
  const std::uint64_t bits = in.number();
  if (!in.is_sound() || bits > NumberRow::kMostBits) return false;
  const std::string_view distances =
      in.bytes(NumberRow::size(kBlockRows, static_cast<unsigned>(bits)));
  distances_ = NumberRow(distances.data(), static_cast<unsigned>(bits));
  return in.is_at_end();
}

bool BlockColumns::read(std::size_t column, Column& into) const {
  PackedNumbers in(columns_.at(column));
  const std::uint64_t count = in.number();
  into.values.clear();
  for (std::uint64_t i = 0; i < count && in.is_sound(); ++i) into.values.push_back(in.text());
  return count > 0 && in.is_sound() && read_rows(in, count, into.rows) && in.is_at_end();
}

// First the kinds of rows: their number, and of each the lower limit, the distance of the upper
// limit, and the subgroup. Then the kind of each row, unless there is only one, then the distance
// of each value from its lower limit.

void ValueBlockWriter::add(const MeasuredValue& value) {
  Kind kind{value.lower_limit_nm, value.upper_limit_nm, value.subgroup};
  const auto [found, is_new] = numbers_.try_emplace(std::move(kind), numbers_.size());
  if (is_new) {
    append_difference(kinds_, value.lower_limit_nm, 0);
    append_difference(kinds_, value.upper_limit_nm, value.lower_limit_nm);
    append_text(kinds_, value.subgroup);
  }
  kind_of_row_.push_back(found->second);
  append_difference(distances_, value.measured_nm, value.lower_limit_nm);
}

std::string ValueBlockWriter::encode() const {
  std::string bytes;
  append_number<std::uint64_t>(bytes, numbers_.size());
  bytes += kinds_;
  if (numbers_.size() > 1) {
    for (const std::uint64_t kind : kind_of_row_) append_number(bytes, kind);
  }
  return bytes + distances_;
}

bool ValueBlock::read(std::string_view bytes) {
  PackedNumbers in(bytes);
  const std::uint64_t count = in.number();
  kinds_.clear();
  for (std::uint64_t i = 0; i < count && in.is_sound(); ++i) {
    Kind& kind = kinds_.emplace_back();
    kind.lower_limit_nm = in.above(0);
    kind.upper_limit_nm = in.above(kind.lower_limit_nm);
    kind.subgroup = in.text();
  }
  if (kinds_.empty() || !in.is_sound()) return false;
  for (Row& row : rows_) {
    const std::uint64_t kind = count > 1 ? in.number() : 0;
    if (kind >= count) return false;
    row.kind = static_cast<std::uint32_t>(kind);
  }
  for (Row& row : rows_) row.measured_nm = in.above(kinds_[row.kind].lower_limit_nm);
  return in.is_at_end();
}

std::string designation_key(std::int64_t nominal_nm, std::string_view tolerance_class) {
  return fmt::format("{} {}", nominal_nm, tolerance_class);
}

RowSet RowSet::all() {
  RowSet set;
  set.rows_.set();
  return set;
}

static_assert(std::endian::native == std::endian::little, "a bitset has its first rows first");
using BitsOfRows = std::array<char, kBlock / 8>;

std::string RowSet::encode() const {
  if (2 * rows_.count() >= sizeof(BitsOfRows)) {
    const auto bits = std::bit_cast<BitsOfRows>(rows_);
    return {bits.begin(), bits.end()};
  }
  std::string rows;
  for (std::size_t row = rows_._Find_first(); row < kBlockRows; row = rows_._Find_next(row)) {
    rows += static_cast<char>(row & 0xFFU);
    rows += static_cast<char>(row >> 8U);
  }
  return rows;
}

RowSet RowSet::decode(std::string_view bytes) {
  RowSet set;
  if (bytes.size() == sizeof(BitsOfRows)) {
    BitsOfRows bits;
    std::ranges::copy(bytes, bits.begin());
    set.rows_ = std::bit_cast<std::bitset<kBlock>>(bits);
    return set;
  }
  const auto byte = [&](std::size_t i) -> unsigned { return static_cast<unsigned char>(bytes[i]); };
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    const std::int64_t row = byte(i) | byte(i + 1) << 8U;
    if (row < kBlock) set.add(row);
  }
  return set;
}

}  // namespace fitgauge::store
