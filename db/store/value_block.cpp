#include "db/store/value_block.hpp"

#include "db/store/packed_numbers.hpp"

namespace fitgauge::store {
// First stand the kinds of rows: how many, and of each the lower limit, how far the upper one is
// above it, and the subgroup. Then come the kinds of the rows, unless there is one kind alone, then
// how far each value is above its lower limit.

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

}  // namespace fitgauge::store
