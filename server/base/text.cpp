namespace fitgauge {
namespace {

unsigned byte_at(std::string_view text, std::size_t i) {
  return static_cast<unsigned char>(text[i]);
}

/// The length of the UTF-8 sequence at `i`, or 0 when it is not one (Unicode 15, table 3-7).
std::size_t sequence_length(std::string_view text, std::size_t i) {
  const unsigned lead = byte_at(text, i);
  if (lead < 0x80) return 1;
  std::size_t length = 0;
  unsigned low = 0x80;
  unsigned high = 0xBF;
  if (lead >= 0xC2 && lead <= 0xDF) {
    length = 2;
  } else if (lead >= 0xE0 && lead <= 0xEF) {
    length = 3;
    if (lead == 0xE0) low = 0xA0;
    if (lead == 0xED) high = 0x9F;
  } else if (lead >= 0xF0 && lead <= 0xF4) {
    length = 4;
    if (lead == 0xF0) low = 0x90;
    if (lead == 0xF4) high = 0x8F;
  } else {
    return 0;
  }
  if (i + length > text.size()) return 0;
  if (byte_at(text, i + 1) < low || byte_at(text, i + 1) > high) return 0;
  for (std::size_t k = i + 2; k < i + length; ++k) {
    if ((byte_at(text, k) & 0xC0) != 0x80) return 0;
  }
  return length;
}

/// 0x80 to 0x9F of Windows-1252; the rest is Latin-1.
constexpr std::array<std::uint16_t, 32> kWindows1252 = {
    0x20AC, 0x0081, 0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160,
    0x2039, 0x0152, 0x008D, 0x017D, 0x008F, 0x0090, 0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
    0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0x009D, 0x017E, 0x0178};

constexpr std::string_view kNoCharacters[] = {"\xEF\xBF\xBE", "\xEF\xBF\xBF"};  // U+FFFE, U+FFFF

bool is_no_character(char c) {
  return static_cast<unsigned char>(c) < ' ' && c != '\t' && c != '\n' && c != '\r';
}

/// Longer words are not compared.
constexpr std::size_t kLongestWord = 40;

/// The smallest number of letters to insert, remove, replace or swap, in words of kLongestWord.
std::size_t edits(std::string_view a, std::string_view b) {
  std::array<std::array<std::size_t, kLongestWord + 1>, kLongestWord + 1> cost;
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        cost[i][j] = i + j;
        continue;
      }
      const std::size_t exchange = cost[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, exchange});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
    }
  }
  return cost[a.size()][b.size()];
}

}  // namespace

std::size_t find_invalid_utf8(std::string_view text) {
  for (std::size_t i = 0;;) {
    // Eight bytes at a time: nearly every text is plain ASCII.
    std::uint64_t bytes = 0;
    for (; i + sizeof bytes <= text.size(); i += sizeof bytes) {
      std::memcpy(&bytes, text.data() + i, sizeof bytes);
      if ((bytes & 0x8080808080808080) != 0) break;
    }
    if (i == text.size()) return std::string_view::npos;
    const std::size_t length = sequence_length(text, i);
    if (length == 0) return i;
    i += length;
  }
}

void append_utf8(std::string& out, char32_t point) {
  const auto put = [&out](char32_t byte) { out += static_cast<char>(byte); };
  if (point < 0x80) return put(point);
  int more = point < 0x800 ? 1 : point < 0x10000 ? 2 : 3;  // bytes after the first
  put(0xFFU << (7 - more) | point >> (6 * more));
  while (more-- > 0) put(0x80U | (point >> (6 * more) & 0x3FU));
}

char32_t take_character(std::string_view& text) {
  const unsigned first = byte_at(text, 0);
  const std::size_t size = first < 0xC0 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  char32_t character = size == 1 ? first : first & (0xFFU >> (size + 1));
  for (const char byte : text.substr(1, size - 1))
    character = character << 6 | (static_cast<unsigned char>(byte) & 0x3FU);
  text.remove_prefix(std::min(size, text.size()));
  return character;
}

std::string utf8_from_windows1252(std::string_view bytes) {
  std::string out;
  out.reserve(bytes.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const unsigned byte = byte_at(bytes, i);
    const bool mapped = byte >= 0x80 && byte < 0xA0;
    append_utf8(out, mapped ? kWindows1252[byte - 0x80] : byte);
  }
  return out;
}

std::string ascii_upper(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = ascii_upper(c);
  return out;
}

std::string ascii_lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = ascii_lower(c);
  return out;
}

bool ascii_iequals(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return x == y || ascii_lower(x) == ascii_lower(y); });
}

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

// Without backtracking beyond the last star: linear in name times stars.
bool matches_glob(std::string_view pattern, std::string_view name) {
  std::size_t p = 0;
  std::size_t n = 0;
  std::size_t star = std::string_view::npos;
  std::size_t after = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      after = n;
    } else if (p < pattern.size() &&
               (pattern[p] == '?' || ascii_lower(pattern[p]) == ascii_lower(name[n]))) {
      ++p;
      ++n;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      n = ++after;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

bool globs_overlap(std::string_view one, std::string_view other) {
  // Whether their ends from `i` (or `i` + 1) and `j` on have a common name.
  std::vector<bool> here(other.size() + 1);
  std::vector<bool> next;
  for (std::size_t i = one.size() + 1; i-- > 0;) {
    next = std::exchange(here, std::vector<bool>(other.size() + 1));
    for (std::size_t j = other.size() + 1; j-- > 0;) {
      const bool has_one = i < one.size();
      const bool has_other = j < other.size();
      if (has_one && one[i] == '*') {
        here[j] = next[j] || (has_other && here[j + 1]);
      } else if (has_other && other[j] == '*') {
        here[j] = here[j + 1] || (has_one && next[j]);
      } else if (has_one && has_other) {
        const bool is_equal =
            one[i] == '?' || other[j] == '?' || ascii_lower(one[i]) == ascii_lower(other[j]);
        here[j] = is_equal && next[j + 1];
      } else {
        here[j] = has_one == has_other;
      }
    }
  }
  return here[0];
}

bool is_xml_text(std::string_view text) {
  return std::none_of(text.begin(), text.end(), is_no_character) &&
         std::none_of(std::begin(kNoCharacters), std::end(kNoCharacters),
                      [text](std::string_view none) { return text.find(none) != text.npos; });
}

std::string xml_text(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    const std::string_view rest = text.substr(at);
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      case '\t': out += "&#9;"; break;
      case '\n': out += "&#10;"; break;
      case '\r': out += "&#13;"; break;
      default:
        if (rest.starts_with(kNoCharacters[0]) || rest.starts_with(kNoCharacters[1])) {
          out += ' ';
          at += 2;
        } else {
          out += is_no_character(c) ? ' ' : c;
        }
    }
  }
  return out;
}

SpellingHint::SpellingHint(std::string_view word)
    : word_(ascii_upper(word)), distance_(word.size() > 4 ? 3 : 2) {}

void SpellingHint::consider(std::string_view known) {
  // One letter is near to every other.
  if (word_.size() < 2 || word_.size() > kLongestWord || known.size() < 2 ||
      known.size() > kLongestWord) {
    return;
  }
  // At least as many edits as one is longer.
  if (std::max(word_.size(), known.size()) - std::min(word_.size(), known.size()) >= distance_)
    return;
  const std::size_t distance = edits(word_, ascii_upper(known));
  if (distance >= distance_ || distance >= known.size()) return;
  distance_ = distance;
  best_ = known;
}

std::string SpellingHint::text() const {
  return best_.empty() ? std::string() : "; did you mean " + best_ + "?";
}

}  // namespace fitgauge
