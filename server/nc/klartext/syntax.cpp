#include "nc/klartext/syntax.hpp"

#include "tables/tabfile/characters.hpp"

namespace fitgauge::klartext {
namespace {

template <class T>
std::size_t bytes_of(const std::vector<T>& pool) {
  return sizeof(T) * pool.size();
}

/// In place; the text up to the first CR stays untouched.
void unify_line_ends(std::string& text) {
  std::size_t in = text.find('\r');
  if (in == std::string::npos) return;
  std::size_t out = in;
  while (in < text.size()) {
    // text[in] is a CR.
    text[out++] = '\n';
    in += in + 1 < text.size() && text[in + 1] == '\n' ? 2U : 1U;
    const std::size_t next = std::min(text.find('\r', in), text.size());
    std::memmove(text.data() + out, text.data() + in, next - in);
    out += next - in;
    in = next;
  }
  text.resize(out);
}

/// In the order of Letter.
constexpr std::string_view kSpellings[] = {
#define FITGAUGE_LETTER(letter, spelling) spelling,
#include "nc/klartext/letters.inc"
#undef FITGAUGE_LETTER
};
static_assert(std::size(kSpellings) <= 128, "LetterSet holds 128 letters");

/// The rows of names that begin with each character, so that a look-up compares few.
constexpr std::array<Letter, 26> kFirstRow = [] {
  std::array<Letter, 26> first{};
  first.fill(static_cast<Letter>(std::size(kSpellings)));
  for (std::size_t i = std::size(kSpellings); i > 0; --i) {
    const std::string_view name = kSpellings[i - 1];
    if (!name.empty()) first[static_cast<std::size_t>(name[0] - 'A')] = static_cast<Letter>(i - 1);
  }
  return first;
}();

}  // namespace

std::size_t ProgramParts::memory_bytes() const {
  constexpr std::size_t kGrown = 2;
  return source.size() + bytes_of(line_starts) + bytes_of(blocks) + bytes_of(words) +
         kGrown *
             (bytes_of(cycle_parameters) + bytes_of(nodes) + bytes_of(operands) + texts.size());
}

Program Program::translated(std::string&& source,
                            const std::function<Slice<char>(Slice<char>)>& place) && {
  for (Block& block : parts_.blocks) block.written = place(block.written);
  for (CycleParameter& row : parts_.cycle_parameters) row.written = place(row.written);
  parts_.source = std::move(source);
  parts_.line_starts = {0};
  for (std::size_t at = parts_.source.find('\n'); at != std::string::npos;
       at = parts_.source.find('\n', at + 1)) {
    parts_.line_starts.push_back(static_cast<std::uint32_t>(at + 1));
  }
  return std::move(*this);
}

SourceRange Program::range(Slice<char> place) const {
  return {position_of(parts_.source, parts_.line_starts, place.first),
          position_of(parts_.source, parts_.line_starts, std::size_t{place.first} + place.count)};
}

std::string_view Program::line(std::uint32_t number) const {
  return line_of(parts_.source, parts_.line_starts, number);
}

Unit Program::unit() const {
  for (const Block& block : parts_.blocks) {
    if (const auto* begin = block.as<BeginProgram>()) return begin->unit;
    if (!block.is<Empty>()) break;  // comments may precede BEGIN PGM
  }
  return Unit::Millimetre;
}

std::string decode_source(std::string bytes) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (bytes.starts_with(kByteOrderMark)) bytes.erase(0, kByteOrderMark.size());
  bytes = as_utf8(bytes);
  unify_line_ends(bytes);
  return bytes;
}

std::size_t count_lines(std::string_view source) {
  return static_cast<std::size_t>(std::count(source.begin(), source.end(), '\n')) + 1;
}

SourcePosition position_of(std::string_view source, const std::vector<std::uint32_t>& line_starts,
                           std::size_t offset) {
  if (line_starts.empty()) return {};
  const auto next = std::upper_bound(line_starts.begin() + 1, line_starts.end(), offset);
  const std::uint32_t start = *std::prev(next);
  const std::size_t before = tabfile::count_characters(source.substr(start, offset - start));
  return {static_cast<std::uint32_t>(next - line_starts.begin()),
          static_cast<std::uint32_t>(before) + 1};
}

std::string_view line_of(std::string_view source, const std::vector<std::uint32_t>& line_starts,
                         std::uint32_t number) {
  if (number == 0 || number > line_starts.size()) return {};
  const std::string_view rest = source.substr(line_starts[number - 1]);
  return rest.substr(0, rest.find('\n'));
}

constinit const std::array<Letter, 26> kSingleLetters = [] {
  std::array<Letter, 26> singles{};
  singles.fill(Letter::Value);
  for (std::size_t i = 0; i < std::size(kSpellings); ++i) {
    const std::string_view name = kSpellings[i];
    if (name.size() == 1) singles[static_cast<std::size_t>(name[0] - 'A')] = static_cast<Letter>(i);
  }
  return singles;
}();

std::optional<Letter> find_letter(std::string_view letters) {
  if (letters.empty()) return std::nullopt;
  if (letters.size() == 1) {
    const Letter letter = single_letter(letters.front());
    return letter == Letter::Value ? std::nullopt : std::optional(letter);
  }
  const auto initial = static_cast<std::size_t>(ascii_upper(letters.front()) - 'A');
  for (auto i = static_cast<std::size_t>(kFirstRow[initial]); i < std::size(kSpellings); ++i) {
    if (ascii_iequals(kSpellings[i], letters)) return static_cast<Letter>(i);
  }
  return std::nullopt;
}

std::string_view spelling(Letter letter) { return kSpellings[static_cast<std::size_t>(letter)]; }

bool is_bare(Letter letter) {
  constexpr LetterSet kBare(Letter::FMax, Letter::FAuto, Letter::FMaxT, Letter::MbMax, Letter::DimR,
                            Letter::DimD, Letter::TableRot, Letter::CoordRot);
  return kBare.contains(letter);
}

}  // namespace fitgauge::klartext
