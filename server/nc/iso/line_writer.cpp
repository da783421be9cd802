#include "nc/iso/translation.hpp"

namespace fitgauge::iso {

void LineWriter::begin_block(klartext::Slice<char> place, std::string prefix) {
  place_ = place;
  prefix_ = std::move(prefix);
  is_written_ = false;
}

void LineWriter::start_line() {
  if (!out_.lines.empty()) out_.klartext += '\n';
  out_.lines.push_back(place_);
  ++out_.blocks;
  out_.klartext += prefix_;
  is_written_ = true;
}

void LineWriter::continue_line(klartext::Slice<char> place) {
  out_.klartext += " ~\n";
  out_.lines.push_back(place);
}

LineWriter& LineWriter::put(std::string_view piece) {
  if (piece.find('~') == std::string_view::npos) {
    out_.klartext += piece;
  } else {
    out_.klartext += klartext::free_text(piece);
  }
  return *this;
}

LineWriter& LineWriter::put(const Word& word) {
  const bool has_dimension =
      word.is_axis() || word.name == "PR" || word.name == "PA" || word.name == "ROT";
  return put(word.incremental && has_dimension && !word.value.empty() ? " I" : " ")
      .put(word.name)
      .put(word.value);
}

void LineWriter::put_rest(BlockWords& words) {
  for (Word& word : words.words) {
    if (!std::exchange(word.used, true)) put(word);
  }
}

void LineWriter::comment(std::string_view comment) {
  out_.klartext += " ;" + klartext::comment_text(comment);
}

std::string LineWriter::pattern(std::string_view pattern, BlockWords& words, char tool_axis) {
  std::string error;
  std::size_t used_p = 0;
  start_line();
  for (std::size_t i = 0; i < pattern.size() && error.empty(); ++i) {
    const char c = pattern[i];
    if (c == '|') {
      start_line();
    } else if (c == '$') {
      const char key = pattern[++i];
      if (key == 'p') used_p = words.p.size();
      if (klartext::is_digit(key)) used_p = std::max(used_p, static_cast<std::size_t>(key - '0'));
      if (key == 'r') used_p = std::max<std::size_t>(used_p, 1);
      error = value(key, words, tool_axis);
    } else {
      put({&c, 1});
    }
  }
  if (error.empty() && used_p < words.p.size())
    error = fmt::format("P{:02} is not allowed in this block", used_p + 1);
  return error;
}

std::string LineWriter::value(char key, BlockWords& words, char tool_axis) {
  if (klartext::is_digit(key) || key == 'r') {
    const auto number = key == 'r' ? std::size_t{1} : static_cast<std::size_t>(key - '0');
    if (number > words.p.size()) return fmt::format("P{:02} is missing", number);
    const std::string_view text = words.p[number - 1];
    put(key == 'r' && !text.empty() && klartext::is_digit(text.front()) ? "Q" : "").put(text);
    return {};
  }
  if (key == 'p') {
    if (words.p.empty()) return "P01 is missing";
    for (const std::string_view& text : words.p) put(&text == words.p.data() ? "" : "/").put(text);
    return {};
  }
  if (key == 'w') return put_rest(words), std::string();
  if (key == 't') return put(words.text), std::string();
  if (key == 'a') return put({&tool_axis, 1}), std::string();
  if (key == 'q')
    return put(words.text),
           words.text.empty() ? "a Q parameter is missing after the function" : std::string();
  Word* word = words.find({&key, 1});
  if (word == nullptr || word->value.empty())
    return fmt::format("{} is missing in this block", key);
  put(word->value);
  word->used = true;
  return {};
}

}  // namespace fitgauge::iso
