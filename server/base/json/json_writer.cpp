#include "base/json/json_writer.hpp"

namespace fitgauge {

char* write_escape(char* to, char c) {
  constexpr std::string_view kHex = "0123456789abcdef";
  const auto byte = static_cast<unsigned char>(c);
  *to++ = '\\';
  switch (byte) {
    case '"':
    case '\\': *to++ = c; break;
    case '\b': *to++ = 'b'; break;
    case '\t': *to++ = 't'; break;
    case '\n': *to++ = 'n'; break;
    case '\f': *to++ = 'f'; break;
    case '\r': *to++ = 'r'; break;
    default:
      for (const char digit : {'u', '0', '0', kHex[byte >> 4], kHex[byte & 15]}) *to++ = digit;
  }
  return to;
}

void append_json_string(std::string& out, std::string_view text) {
  out += '"';
  std::size_t copied = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!needs_escape(text[i])) continue;
    out += text.substr(copied, i - copied);
    copied = i + 1;
    char escape[kEscapeRoom];
    out.append(escape, write_escape(escape, text[i]));
  }
  out += text.substr(copied);
  out += '"';
}

std::string json_string(std::string_view text) {
  std::string out;
  append_json_string(out, text);
  return out;
}

}  // namespace fitgauge

namespace fitgauge::api {
namespace {

template <class Number>
void append_number(std::string& out, Number value) {
  char digits[32];
  const auto end = std::to_chars(std::begin(digits), std::end(digits), value).ptr;
  out.append(std::begin(digits), end);
}

}  // namespace

void JsonWriter::separate() {
  if (!first_ && !after_key_) out_ += ',';
  first_ = false;
  after_key_ = false;
}

JsonWriter& JsonWriter::open(char bracket) {
  separate();
  out_ += bracket;
  first_ = true;
  return *this;
}

JsonWriter& JsonWriter::close(char bracket) {
  out_ += bracket;
  first_ = false;
  return *this;
}

JsonWriter& JsonWriter::key(std::string_view name) {
  separate();
  append_json_string(out_, name);
  out_ += ':';
  after_key_ = true;
  return *this;
}

JsonWriter& JsonWriter::value(std::int64_t value) {
  separate();
  append_number(out_, value);
  return *this;
}

JsonWriter& JsonWriter::value(std::uint64_t value) {
  separate();
  append_number(out_, value);
  return *this;
}

JsonWriter& JsonWriter::value(double value) {
  if (!std::isfinite(value)) return null();
  separate();
  append_number(out_, value);
  return *this;
}

JsonWriter& JsonWriter::figure(long double value) {
  if (!std::isfinite(value)) return null();
  separate();
  char digits[40];
  const auto end =
      std::to_chars(std::begin(digits), std::end(digits), value, std::chars_format::general, 17)
          .ptr;
  out_.append(std::begin(digits), end);
  return *this;
}

JsonWriter& JsonWriter::significant(double value, int digits) {
  if (!std::isfinite(value)) return null();
  separate();
  fmt::format_to(std::back_inserter(out_), "{:.{}g}", value == 0 ? 0.0 : value, digits);
  return *this;
}

JsonWriter& JsonWriter::fixed(double value, int decimals) {
  if (!std::isfinite(value)) return null();
  separate();
  const std::size_t start = out_.size();
  fmt::format_to(std::back_inserter(out_), "{:.{}f}", value, decimals);
  if (decimals > 0) {
    out_.erase(out_.find_last_not_of('0') + 1);
    if (out_.back() == '.') out_.pop_back();
  }
  if (std::string_view(out_).substr(start) == "-0") out_.replace(start, std::string::npos, "0");
  return *this;
}

JsonWriter& JsonWriter::value(std::string_view text) {
  separate();
  append_json_string(out_, text);
  return *this;
}

JsonWriter& JsonWriter::mm(Length length) {
  separate();
  append_mm(out_, length);
  return *this;
}

JsonWriter& JsonWriter::um(Length length) {
  separate();
  append_um(out_, length);
  return *this;
}

JsonWriter& JsonWriter::decimal(std::int64_t value, int scale) {
  separate();
  append_decimal(out_, value, scale);
  return *this;
}

JsonWriter& JsonWriter::raw(std::string_view json) {
  separate();
  out_ += json;
  return *this;
}

void write_json(JsonWriter& json, const JsonValue& value) {
  switch (value.kind) {
    case JsonValue::Kind::Null: json.null(); break;
    case JsonValue::Kind::Boolean: json.value(value.boolean); break;
    case JsonValue::Kind::Number: json.raw(value.text); break;
    case JsonValue::Kind::String: json.value(value.text); break;
    case JsonValue::Kind::Array:
      json.begin_array();
      for (const JsonValue& item : value.items) write_json(json, item);
      json.end_array();
      break;
    case JsonValue::Kind::Object:
      json.begin_object();
      for (const auto& [name, member] : value.members) write_json(json.key(name), member);
      json.end_object();
      break;
  }
}

std::string json_text(const JsonValue& value) {
  return json_by([&](JsonWriter& json) { write_json(json, value); });
}

}  // namespace fitgauge::api
