#include "formats/step/part21.hpp"

#include <unordered_map>

#include "base/allowance.hpp"

namespace fitgauge::step {
namespace {

/// Bytes that may be read again for the sizes of a file.
constexpr std::size_t kMostWalked = std::size_t{256} << 20;
constexpr std::string_view kEnd = "END-ISO-10303-21";
/// Schemas whose files may have sizes begin so: AP203, AP214 and AP242.
constexpr std::array<std::string_view, 6> kSchemas = {
    "AP242_",           "AP203_", "AP214_", "AUTOMOTIVE_DESIGN", "CONFIG_CONTROL_DESIGN",
    "CONFIG_CONTROL_3D"};

/// The number of some hexadecimal digits, none for other characters.
std::optional<std::uint32_t> hexadecimal(std::string_view digits, std::size_t count) {
  std::uint32_t code = 0;
  if (digits.size() < count) return std::nullopt;
  const auto read = std::from_chars(digits.data(), digits.data() + count, code, 16);
  return read.ptr == digits.data() + count ? std::optional(code) : std::nullopt;
}

/// `\X2\…\X0\` and `\X4\…\X0\`: passes them.
void append_wide(std::string& to, std::string_view& text, std::size_t width) {
  std::uint32_t high = 0;
  while (const auto code = hexadecimal(text, width)) {
    text.remove_prefix(width);
    if (*code >= 0xD800 && *code < 0xDC00) {
      high = *code;
    } else if (high != 0 && *code >= 0xDC00 && *code < 0xE000) {
      append_utf8(to, 0x10000 + ((high - 0xD800) << 10) + (*code - 0xDC00));
      high = 0;
    } else {
      const bool is_character = *code < 0x110000 && (*code < 0xD800 || *code >= 0xE000);
      append_utf8(to, is_character ? *code : 0xFFFD);
    }
  }
  if (text.starts_with("\\X0\\")) text.remove_prefix(4);
}

}  // namespace

std::string text_of(const Parameter& parameter) {
  if (!parameter.is(Parameter::Kind::Text) || parameter.text.size() < 2) return {};
  std::string_view text = parameter.text.substr(1, parameter.text.size() - 2);
  const bool has_utf8 = is_utf8(text);
  std::string out;
  while (!text.empty()) {
    const auto c = static_cast<unsigned char>(text[0]);
    if (text.starts_with("\\X2\\") || text.starts_with("\\X4\\")) {
      const std::size_t width = text[2] == '2' ? 4 : 8;
      text.remove_prefix(4);
      append_wide(out, text, width);
    } else if (text.starts_with("\\X\\") && hexadecimal(text.substr(3), 2)) {
      const std::uint32_t code = *hexadecimal(text.substr(3), 2);
      append_utf8(out, code < ' ' ? ' ' : code);
      text.remove_prefix(5);
    } else if (text.starts_with("\\S\\") && text.size() > 3) {
      append_utf8(out, 0x80U + (static_cast<unsigned char>(text[3]) & 0x7FU));
      text.remove_prefix(4);
    } else if (text.size() > 3 && text[0] == '\\' && text[1] == 'P' && text[3] == '\\') {
      text.remove_prefix(4);
    } else if (text.starts_with("''") || text.starts_with("\\\\")) {
      out += text[0];
      text.remove_prefix(2);
    } else {
      if (c >= 0x80 && !has_utf8)
        append_utf8(out, c);
      else if (c >= ' ')
        out += text[0];
      text.remove_prefix(1);
    }
  }
  return out;
}

double number_of(const Parameter& parameter) {
  const std::string_view digits = parameter.text.substr(parameter.text.starts_with('+') ? 1 : 0);
  double number = 0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const bool is_tiny = digits.find("E-") != std::string_view::npos;
  return read.ec == std::errc::result_out_of_range && !is_tiny ? HUGE_VAL : number;
}

/// Reads a whole file in one pass.
class Part21Scanner {
 public:
  Part21Scanner(Part21& file, std::span<const std::string_view> names, std::size_t most)
      : file_(file), lexer_(file.text_), most_(most) {
    file.by_name_.resize(names.size());
    for (std::size_t i = 0; i < names.size(); ++i) places_.emplace(names[i], i);
  }

  const std::optional<Error>& error() const { return lexer_.error(); }

  bool scan() {
    lexer_.skip();
    if (!expect("ISO-10303-21") || !expect("HEADER") || !header()) return false;
    for (;;) {
      const std::string_view section = lexer_.keyword();
      if (section == kEnd) return lexer_.end() && signatures();
      const bool is_data = section == "DATA";
      if (!is_data && section != "ANCHOR" && section != "REFERENCE")
        return lexer_.fail("DATA or END-ISO-10303-21 expected");
      if (is_data && lexer_.peek() == '(' && !lexer_.list(Part21::kDeepest)) return false;
      if (!lexer_.end()) return false;
      if (is_data ? !instances() : !statements()) return false;
    }
  }

 private:
  bool expect(std::string_view word) {
    if (lexer_.keyword() != word) return lexer_.fail("{} expected", word);
    return lexer_.end();
  }
  bool record(std::string_view& name) {
    name = lexer_.keyword();
    return !name.empty() ? lexer_.list(Part21::kDeepest)
                         : lexer_.fail("the name of an entity expected");
  }

  bool header() {
    bool has_schema = false;
    while (!lexer_.is_at_end()) {
      const std::size_t begin = lexer_.at();
      if (lexer_.keyword() == "ENDSEC") {
        if (!has_schema) return lexer_.fail("the header has no FILE_SCHEMA");
        return lexer_.end();
      }
      lexer_.go_to(begin);
      std::string_view name;
      if (!record(name)) return false;
      if (name == "FILE_SCHEMA") {
        const std::string_view schemas = lexer_.from(begin);
        has_schema = std::ranges::any_of(kSchemas, [&](std::string_view known) {
          return schemas.find(fmt::format("'{}", known)) != std::string_view::npos;
        });
        if (!has_schema) return lexer_.fail("FILE_SCHEMA is not AP203, AP214 or AP242");
      }
      if (!lexer_.end()) return false;
    }
    return lexer_.fail("ENDSEC expected");
  }

  /// Reads the statements of a section that has no sizes: anchors and references (edition 3).
  bool statements() {
    for (;;) {
      const std::size_t begin = lexer_.at();
      if (lexer_.keyword() == "ENDSEC") return lexer_.end();
      lexer_.go_to(begin);
      while (!lexer_.take(';')) {
        Parameter token;
        if (lexer_.take('=') || lexer_.take('{') || lexer_.take('}') || lexer_.take(':')) continue;
        const bool is_tag = lexer_.peek() >= 'a' && lexer_.peek() <= 'z';
        if (is_tag)
          lexer_.go_to(lexer_.at() + 1);
        else if (!lexer_.parameter(token, Part21::kDeepest))
          return false;
      }
    }
  }

  bool signatures() {
    while (!lexer_.is_at_end()) {
      if (!expect("SIGNATURE")) return false;
      const std::size_t end = file_.text_.text.find("ENDSEC", lexer_.at());
      if (end == std::string_view::npos) return lexer_.fail("a signature has no ENDSEC");
      lexer_.go_to(end);
      if (!expect("ENDSEC")) return false;
    }
    return !lexer_.error();
  }

  bool instances() {
    for (;;) {
      if (lexer_.peek() == '#') {
        if (!instance()) return false;
        continue;
      }
      if (lexer_.keyword() != "ENDSEC") return lexer_.fail("an instance or ENDSEC expected");
      return lexer_.end();
    }
  }

  bool instance() {
    Parameter name;
    if (!lexer_.parameter(name, 1)) return false;
    if (!name.is(Parameter::Kind::Reference) || !lexer_.take('=')) {
      return lexer_.fail("an instance must be #number=NAME(…);");
    }
    if (file_.instances_.size() == most_)
      return lexer_.fail("more than {} instances: use fitgauge plan from for larger files", most_);
    const std::size_t at = lexer_.at();
    file_.instances_.push_back({name.id, static_cast<std::uint32_t>(at)});
    if (at - let_go_ > FileText::kStretch) file_.text_.let_go(std::exchange(let_go_, at), at);
    const bool is_complex = lexer_.take('(');
    do {
      std::string_view entity;
      if (!record(entity) || ++records_ > 4 * most_) return lexer_.fail("too many records");
      if (const auto place = places_.find(entity); place != places_.end())
        file_.by_name_[place->second].push_back(name.id);
    } while (is_complex && !lexer_.take(')'));
    return lexer_.end();
  }

  Part21& file_;
  Lexer lexer_;
  const std::size_t most_;
  std::size_t records_ = 0;
  std::size_t let_go_ = 0;
  std::unordered_map<std::string_view, std::size_t> places_;
};

Result<Part21> Part21::read(const FileText& text, std::span<const std::string_view> names,
                            std::size_t most_instances) {
  Part21 file;
  file.text_ = text;
  if (text.text.size() > std::numeric_limits<std::uint32_t>::max()) {
    return Error{ErrorCode::DrawingMalformed,
                 "the file has more than 4294967295 bytes: export a part of it"};
  }
  Part21Scanner scanner(file, names, most_instances);
  if (!scanner.scan()) return *scanner.error();
  auto& all = file.instances_;
  const auto by_id = [](const Instance& a, const Instance& b) { return a.id < b.id; };
  if (!std::ranges::is_sorted(all, by_id)) std::ranges::stable_sort(all, by_id);
  const auto twice = std::ranges::adjacent_find(
      all, [](const Instance& a, const Instance& b) { return a.id == b.id; });
  if (twice != all.end()) {
    return error_at(text, std::next(twice)->at,
                    fmt::format("#{} occurs twice: export the file again", twice->id));
  }
  return file;
}

const Part21::Instance* Part21::find(std::uint32_t id) const {
  const auto found = std::lower_bound(instances_.begin(), instances_.end(), id,
                                      [](const Instance& a, std::uint32_t b) { return a.id < b; });
  return found != instances_.end() && found->id == id ? &*found : nullptr;
}

void Part21::fail(std::uint32_t id, std::string message) const {
  if (error_) return;
  const Instance* instance = find(id);
  error_ = error_at(text_, instance != nullptr ? instance->at : 0, message);
}

bool Part21::walk(std::string_view text) const {
  walked_ += text.size();
  if (walked_ > kMostWalked || Allowance::of_thread().is_spent())
    fail(0, "the sizes refer to too many entities: export fewer parts");
  return !error_;
}

std::vector<Record> Part21::records(std::uint32_t id, std::uint32_t from) const {
  std::vector<Record> found;
  if (error_) return found;
  const Instance* instance = find(id);
  if (instance == nullptr) {
    fail(from, fmt::format("#{} refers to #{}, which is missing: export the file again", from, id));
    return found;
  }
  // Far from each other, and pages are mapped some at a time.
  constexpr std::size_t kBetween = 256;
  if (++records_ % kBetween == 0) text_.let_go(0, text_.text.size());
  Lexer lexer(text_);
  lexer.go_to(instance->at);
  const bool is_complex = lexer.take('(');
  do {
    const std::string_view name = lexer.keyword();
    const std::size_t begin = lexer.at();
    lexer.list(kDeepest);
    found.push_back({name, lexer.from(begin)});
    if (!walk(found.back().list) || found.size() > kMostItems) return {};
  } while (is_complex && !lexer.take(')'));
  return found;
}

std::vector<Parameter> Part21::parameters(std::string_view list) const {
  std::vector<Parameter> found;
  const std::size_t begin = list.find('(');
  if (begin == std::string_view::npos || !walk(list)) return found;
  Lexer lexer(list);
  lexer.go_to(begin);
  lexer.list(kDeepest + 1, [&found](const Parameter& item) {
    found.push_back(item);
    return found.size() < kMostItems;
  });
  if (found.size() == kMostItems) fail(0, "a list has more than 65535 items: export fewer parts");
  return found;
}

}  // namespace fitgauge::step
