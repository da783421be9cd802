#include "formats/dfq/lines.hpp"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

// One form for processors that count and clear bits in one instruction, which all do since 2013;
// the loader chooses. Sanitizers are not up yet when it does.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define FITGAUGE_IN_BOTH_FORMS __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define FITGAUGE_IN_BOTH_FORMS
#endif

namespace fitgauge::aqdef {
namespace {

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

constexpr std::size_t kFieldName = 5;  ///< K0000

/// Bytes of short lines that are kept at a time: few enough to stay in the cache.
constexpr std::size_t kPiece = std::size_t{1} << 18;

/// A number of up to six digits from the front of a text.
std::optional<std::uint32_t> take_index(std::string_view& text) {
  constexpr std::ptrdiff_t kMostDigits = 6;
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const std::ptrdiff_t digits = end - text.data();
  if (error != std::errc() || digits > kMostDigits) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(digits));
  return number;
}

/// Number of bytes that are scanned together. Fields of a DFQ are short: a branch for each byte or
/// field would be predicted wrong too often.
constexpr std::size_t kBlock = 64;

/// Bit i: the byte i of a block is a separator, and one of values.
struct Masks {
  std::uint64_t all = 0;
  std::uint64_t of_values = 0;
};

#if defined(__SSE2__)
[[gnu::always_inline]] inline std::uint64_t where(__m128i bytes, char separator) {
  const int found = _mm_movemask_epi8(_mm_cmpeq_epi8(bytes, _mm_set1_epi8(separator)));
  return static_cast<std::uint32_t>(found);
}
#endif

[[gnu::always_inline]] inline Masks masks_of(const char* block) {
  Masks masks;
#if defined(__SSE2__)
#pragma GCC unroll 4
  for (std::size_t at = 0; at < kBlock; at += sizeof(__m128i)) {
    const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(block + at));
    masks.all |= where(bytes, kFieldSeparator) << at;
    masks.of_values |= where(bytes, kValueSeparator) << at;
  }
#else
  for (std::size_t at = 0; at < kBlock; ++at) {
    masks.all |= std::uint64_t{block[at] == kFieldSeparator} << at;
    masks.of_values |= std::uint64_t{block[at] == kValueSeparator} << at;
  }
#endif
  masks.all |= masks.of_values;
  return masks;
}

using enum FieldType;

constexpr std::array kFields = {
#define FITGAUGE_FIELD(name, ...) FieldInfo{__VA_ARGS__},
#include "formats/dfq/fields.inc"
#undef FITGAUGE_FIELD
};

static_assert(std::ranges::is_sorted(kFields, {}, &FieldInfo::number));

constexpr char kBar = '|';

/// Fields of a text that begins after the first bar and ends with one.
std::optional<std::vector<CarriedField>> parse_fields(std::string_view text) {
  std::vector<CarriedField> fields;
  while (!text.empty()) {
    if (!is_field_line(text) || text.size() < 7 || text[5] != ' ') return std::nullopt;
    const auto field = parse_field_line(text.substr(0, 5));
    if (!field) return std::nullopt;
    const Level level = level_of(field->number);
    if (level != Level::Value && level != Level::Part) return std::nullopt;
    text.remove_prefix(6);
    CarriedField carried{.number = field->number, .text = {}};
    for (;;) {
      if (text.empty()) return std::nullopt;  // no bar at its end
      const char c = text[0];
      text.remove_prefix(1);
      if (c == kBar && !text.starts_with(kBar)) break;
      if (c == kBar) text.remove_prefix(1);
      carried.text += c;
    }
    fields.push_back(std::move(carried));
  }
  return fields;
}

}  // namespace

bool is_field_line(std::string_view line) {
  return line.size() >= kFieldName && line[0] == 'K' && is_digit(line[1]) && is_digit(line[2]) &&
         is_digit(line[3]) && is_digit(line[4]);
}

Result<FieldLine> parse_field_line(std::string_view line) {
  FieldLine field;
  field.number =
      (line[1] - '0') * 1000 + (line[2] - '0') * 100 + (line[3] - '0') * 10 + (line[4] - '0');
  line.remove_prefix(kFieldName);
  if (line.starts_with('/')) {
    line.remove_prefix(1);
    const auto index = take_index(line);
    bool is_right = index.has_value();
    if (is_right && line.starts_with('/')) {
      line.remove_prefix(1);
      const auto value = take_index(line);
      is_right = value && *value > 0 && level_of(field.number) == Level::Value;
      field.value_index = value.value_or(0);
    }
    if (!is_right || !(line.empty() || line[0] == ' ')) {
      return Error{kMalformed,
                   fmt::format("has an index after K{:04} that is not a number: write K{:04}/1",
                               field.number, field.number)};
    }
    field.index = *index;
  } else if (!line.empty() && line[0] != ' ') {
    return Error{kMalformed, fmt::format("has no blank after K{:04}", field.number)};
  }
  field.text = trim(line);
  return field;
}

std::string guid_of(std::string_view origin, std::int64_t number) {
  std::string digits = fmt::format("{:0>16}{:016x}", origin, static_cast<std::uint64_t>(number));
  for (const std::size_t at : {20U, 16U, 12U, 8U}) digits.insert(at, "-");
  return digits;
}

Error at_line(std::uint32_t line, std::string_view what) {
  return {kMalformed, fmt::format("line {} {}", line, what), fmt::format("line {}", line)};
}

Lines::Lines(Read read) : read_(std::move(read)), room_(kPiece, '\0') {}

void Lines::go_on_with(Read read) {
  read_ = std::move(read);
  at_ = last_at_ = mark_ = size_ = 0;
  number_ = last_number_ = marked_number_ = 0;
  ++moves_;
  is_at_start_ = true;
  is_at_end_ = false;
}

bool Lines::next(Line& line) {
  while (!failure_) {
    const char* const from = room_.data() + at_;
    const auto* const end =
        static_cast<const char*>(at_ == size_ ? nullptr : std::memchr(from, '\n', size_ - at_));
    if (end == nullptr && !is_at_end_) {
      fill();
      continue;
    }
    if (at_ == size_) return false;
    last_at_ = at_;
    last_number_ = number_;
    line.is_ended = end != nullptr;
    auto size = static_cast<std::size_t>((end == nullptr ? room_.data() + size_ : end) - from);
    at_ += size + (end == nullptr ? 0 : 1);
    ++number_;
    if (size > 0 && from[size - 1] == '\r') --size;
    line.text = {from, size};
    line.number = number_;
    if (has_nul_ && std::memchr(from, '\0', size) != nullptr)
      return fail("has a byte 0: the file is damaged, or not a DFQ");
    if (!trim(line.text).empty()) return true;
  }
  return false;
}

bool Lines::fill() {
  if (mark_ > 0) {
    std::memmove(room_.data(), room_.data() + mark_, size_ - mark_);
    size_ -= mark_;
    at_ -= mark_;
    last_at_ -= std::min(last_at_, mark_);
    mark_ = 0;
    ++moves_;
  }
  if (size_ == kRoom) {
    ++number_;
    return fail(fmt::format(
        "is in a value of more than {} KiB: the file is not a DFQ, or its line ends are lost",
        kRoom >> 10));
  }
  if (size_ == room_.size()) {
    room_.resize(std::min(2 * size_, kRoom));
    ++moves_;
  }
  const auto count = read_(std::span(room_).subspan(size_));
  if (!count) {
    failure_ = count.error();
    return false;
  }
  is_at_end_ = *count == 0;
  has_nul_ = has_nul_ || std::memchr(room_.data() + size_, '\0', *count) != nullptr;
  size_ += *count;
  if (!is_at_start_ || (size_ < 3 && !is_at_end_)) return true;
  is_at_start_ = false;
  const std::string_view start(room_.data(), size_);
  if (start.starts_with("\xFF\xFE") || start.starts_with("\xFE\xFF")) {
    ++number_;
    return fail("is UTF-16: save the file as UTF-8 or Windows-1252");
  }
  if (start.starts_with("\xEF\xBB\xBF")) at_ = mark_ = 3;
  return true;
}

FITGAUGE_IN_BOTH_FORMS Separated separate(std::string_view text, std::uint32_t* starts,
                                          std::uint32_t* values) {
  constexpr std::uint32_t kAtOnce = kSeparateRoom;
  std::uint32_t found = 0;
  std::array<char, kBlock> last{};  // rest at the end, and zeros
  for (std::size_t at = 0; at < text.size(); at += kBlock) {
    const char* block = text.data() + at;
    if (text.size() - at < kBlock) {
      text.copy(last.data(), kBlock, at);
      block = last.data();
    }
    const Masks masks = masks_of(block);
    for (std::uint64_t left = masks.of_values; left != 0; left &= left - 1) {
      const std::uint64_t up_to = left ^ (left - 1);
      *values++ = found + static_cast<std::uint32_t>(std::popcount(masks.all & up_to));
    }
    // Eight at a time, some of them unused, so that no branch is predicted wrong.
    const auto count = static_cast<std::uint32_t>(std::popcount(masks.all));
    const auto behind = static_cast<std::uint32_t>(at) + 1;
    std::uint64_t left = masks.all;
    for (std::uint32_t done = 0; done < count; done += kAtOnce) {
#pragma GCC unroll 8
      for (std::uint32_t i = 0; i < kAtOnce; ++i) {
        starts[found + done + i] = behind + static_cast<std::uint32_t>(std::countr_zero(left));
        left &= left - 1;
      }
    }
    found += count;
  }
  return {.starts = starts + found, .values = values};
}

Level level_of(int number) {
  if (number == k::kCount || number == 101 || number == 999) return Level::File;
  switch (number / 1000) {
    case 0: return Level::Value;
    case 1: return Level::Part;
    case 4: return Level::Catalogue;
    case 5: return Level::Group;
    case 2:
    case 3:
    case 8: return Level::Characteristic;
    default: return Level::Other;
  }
}

const FieldInfo* field_info(int number) {
  const auto* const found = std::ranges::lower_bound(kFields, number, {}, &FieldInfo::number);
  return found != kFields.end() && found->number == number ? found : nullptr;
}

std::string format_comment(const Comment& comment) {
  std::string text = comment.text;
  if (comment.fields.empty()) return text;
  if (!text.empty()) text += ' ';
  for (const CarriedField& field : comment.fields) {
    text += fmt::format("|K{:04} ", field.number);
    for (const char c : field.text) {
      text += c;
      if (c == kBar) text += c;
    }
  }
  return text += kBar;
}

Comment parse_comment(std::string_view comment) {
  for (std::size_t at = comment.find("|K"); at != std::string_view::npos && comment.ends_with(kBar);
       at = comment.find("|K", at + 1)) {
    if (at > 0 && comment[at - 1] != ' ') continue;
    auto fields = parse_fields(comment.substr(at + 1));
    if (fields && !fields->empty()) {
      return {.text = std::string(comment.substr(0, at == 0 ? 0 : at - 1)),
              .fields = *std::move(fields)};
    }
  }
  return {.text = std::string(comment)};
}

}  // namespace fitgauge::aqdef
