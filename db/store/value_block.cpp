#include "store/value_block.hpp"

namespace fitgauge::store {
namespace {

// Numbers are written seven bits a byte, the lowest first, the eighth bit set where another
// follows; of signed ones the sign is the lowest bit. First stand the kinds of rows: how many, and
// of each the lower limit, how far the upper one is above it, the length of the subgroup's name
// and one, or 0 for none, and the name. Then come the kinds of the rows, unless there is one kind
// alone, then how far each value is above its lower limit.

void append(std::string& out, std::uint64_t number) {
  constexpr std::uint64_t kMore = 0x80;
  for (; number >= kMore; number >>= 7U) out += static_cast<char>(number | kMore);
  out += static_cast<char>(number);
}

/// Differences wrap around as unsigned ones do, and so come back whatever they are.
void append_difference(std::string& out, std::int64_t of, std::int64_t from) {
  const std::uint64_t difference =
      static_cast<std::uint64_t>(of) - static_cast<std::uint64_t>(from);
  append(out, difference >> 63U == 0 ? difference << 1U : ~(difference << 1U));
}

class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : at_(bytes.data()), end_(at_ + bytes.size()) {}

  std::uint64_t number() {
    std::uint64_t number = 0;
    for (unsigned shift = 0; at_ != end_ && shift < 64; shift += 7) {
      const auto byte = static_cast<unsigned char>(*at_++);
      number |= std::uint64_t{byte & 0x7FU} << shift;
      if (byte < 0x80U) return number;
    }
    is_sound_ = false;
    return 0;
  }
  std::int64_t above(std::int64_t from) {
    const std::uint64_t bits = number();
    const std::uint64_t difference = (bits & 1U) == 0 ? bits >> 1U : ~(bits >> 1U);
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(from) + difference);
  }
  std::string_view text(std::uint64_t size) {
    if (size > static_cast<std::uint64_t>(end_ - at_)) {
      is_sound_ = false;
      return {};
    }
    const std::string_view text(at_, size);
    at_ += size;
    return text;
  }

  bool is_sound() const { return is_sound_; }
  bool is_at_end() const { return is_sound_ && at_ == end_; }

 private:
  const char* at_;
  const char* end_;
  bool is_sound_ = true;
};

}  // namespace

void ValueBlockWriter::add(const MeasuredValue& value) {
  Kind kind{value.lower_limit_nm, value.upper_limit_nm, value.subgroup};
  const auto [found, is_new] = numbers_.try_emplace(std::move(kind), numbers_.size());
  if (is_new) {
    append_difference(kinds_, value.lower_limit_nm, 0);
    append_difference(kinds_, value.upper_limit_nm, value.lower_limit_nm);
    append(kinds_, value.subgroup ? value.subgroup->size() + 1 : 0);
    kinds_ += value.subgroup.value_or("");
  }
  kind_of_row_.push_back(found->second);
  append_difference(distances_, value.measured_nm, value.lower_limit_nm);
}

std::string ValueBlockWriter::encode() const {
  std::string bytes;
  append(bytes, numbers_.size());
  bytes += kinds_;
  if (numbers_.size() > 1) {
    for (const std::uint64_t kind : kind_of_row_) append(bytes, kind);
  }
  return bytes + distances_;
}

bool ValueBlock::read(std::string_view bytes) {
  Bytes in(bytes);
  const std::uint64_t count = in.number();
  kinds_.clear();
  for (std::uint64_t i = 0; i < count && in.is_sound(); ++i) {
    Kind& kind = kinds_.emplace_back();
    kind.lower_limit_nm = in.above(0);
    kind.upper_limit_nm = in.above(kind.lower_limit_nm);
    if (const std::uint64_t size = in.number(); size > 0) kind.subgroup = in.text(size - 1);
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
