#include "record/measurement_row_reader.hpp"

#include <simdjson.h>

namespace fitgauge::api {
namespace {

namespace ondemand = simdjson::ondemand;

/// One parser a thread, so that a small body allocates nothing.
ondemand::parser& thread_parser() {
  static thread_local ondemand::parser parser;
  return parser;
}

std::string_view without_trailing_blanks(std::string_view token) {
  const std::size_t last = token.find_last_not_of(" \t\r\n");
  return token.substr(0, last == std::string_view::npos ? 0 : last + 1);
}

const char* skip_digits(const char* at, const char* end) {
  return std::find_if_not(at, end, [](char c) { return c >= '0' && c <= '9'; });
}

/// The number grammar of RFC 8259, of the whole token.
bool is_json_number(std::string_view token) {
  const char* at = token.data();
  const char* const end = at + token.size();
  if (at != end && *at == '-') ++at;
  const char* const integer = at;
  at = skip_digits(at, end);
  if (at == integer || (*integer == '0' && at - integer > 1)) return false;
  if (at != end && *at == '.') {
    const char* const fraction = ++at;
    at = skip_digits(at, end);
    if (at == fraction) return false;
  }
  if (at != end && (*at == 'e' || *at == 'E')) {
    ++at;
    if (at != end && (*at == '+' || *at == '-')) ++at;
    const char* const exponent = at;
    at = skip_digits(at, end);
    if (at == exponent) return false;
  }
  return at == end;
}

/// The characters of a string; simdjson has checked UTF-8 and controls, and checks escapes here.
bool string(ondemand::value& content, std::string_view token, MeasurementBatch& batch,
            std::string_view& text) {
  if (token.size() < 2 || token.back() != '"') return false;
  text = token.substr(1, token.size() - 2);
  if (text.find('\\') == std::string_view::npos) return true;
  if (content.get_string().get(text) != simdjson::SUCCESS) return false;
  text = batch.keep(text);
  return true;
}

bool scalar(ondemand::value& content, MeasurementBatch& batch, RawValue& value) {
  const std::string_view token = without_trailing_blanks(content.raw_json_token());
  if (token.empty()) return false;
  if (token.front() == '"') {
    value.kind = RawValue::Kind::String;
    return string(content, token, batch, value.text);
  }
  if (token == "null") {
    value.kind = RawValue::Kind::Null;
    return true;
  }
  if (token == "true" || token == "false") {
    value.kind = RawValue::Kind::Boolean;
    value.text = token;
    return true;
  }
  value.kind = RawValue::Kind::Number;
  value.text = token;
  return is_json_number(token);
}

bool read_fields(ondemand::object& object, MeasurementRowReader& reader, MeasurementBatch& batch) {
  for (auto field : object) {
    ondemand::raw_json_string key;
    ondemand::value content;
    if (field.key().get(key) != simdjson::SUCCESS ||
        field.value().get(content) != simdjson::SUCCESS) {
      return false;
    }
    // A key has no length: it ends at the quote, and a key with an escape is not accepted.
    const char* const name = key.raw();
    const char* name_end = name;
    while (*name_end != '"' && *name_end != '\\') ++name_end;
    RawValue value;
    if (*name_end != '"' || !scalar(content, batch, value) ||
        !reader.field({name, static_cast<std::size_t>(name_end - name)}, value)) {
      return false;
    }
  }
  if (const app::Measurement* row = reader.end()) batch.rows.push_back(*row);
  return true;
}

bool at_end(ondemand::document& document) {
  return document.current_location().error() == simdjson::OUT_OF_BOUNDS;
}

/// Room for all rows, or for kRowsAtATime of them, if all are as long as the first.
void make_room(std::string_view body, ondemand::document& document, const BatchContext& context,
               MeasurementBatch& batch) {
  const char* at = nullptr;
  if (document.current_location().get(at) != simdjson::SUCCESS) return;
  const std::size_t first = std::max<std::size_t>(static_cast<std::size_t>(at - body.data()), 1);
  batch.rows.reserve(std::min(body.size() / first + 1, context.take ? kRowsAtATime : kMostRows));
}

bool read_array(std::string_view body, ondemand::document& document, MeasurementRowReader& reader,
                const BatchContext& context, MeasurementBatch& batch, const FieldErrors& errors) {
  ondemand::array array;
  if (document.get_array().get(array) != simdjson::SUCCESS) return false;
  std::size_t row = 0;
  for (auto element : array) {
    if (context.stop.stop_requested()) return false;
    ondemand::object object;
    batch.has_too_many = row == kMostRows;
    if (batch.has_too_many || element.get_object().get(object) != simdjson::SUCCESS) return false;
    reader.begin(row++);
    if (!read_fields(object, reader, batch)) return false;
    if (row == 1) make_room(body, document, context, batch);
    take_full(batch, context, errors);
  }
  return row != 0;
}

}  // namespace

bool read_body_fast(std::string_view body, const BatchContext& context, MeasurementBatch& batch,
                    FieldErrors& errors) {
  const simdjson::padded_string_view padded(body.data(), body.size(),
                                            body.size() + simdjson::SIMDJSON_PADDING);
  ondemand::document document;
  ondemand::json_type type{};
  if (body.starts_with('\xEF') ||
      thread_parser().iterate(padded).get(document) != simdjson::SUCCESS ||
      document.type().get(type) != simdjson::SUCCESS) {
    return false;
  }
  MeasurementRowReader reader(context, errors);
  if (type == ondemand::json_type::array) {
    return read_array(body, document, reader, context, batch, errors) && at_end(document);
  }
  ondemand::object object;
  batch.single = true;
  reader.begin(std::nullopt);
  return document.get_object().get(object) == simdjson::SUCCESS &&
         read_fields(object, reader, batch) && at_end(document);
}

bool read_object_fast(std::string_view text, MeasurementRowReader& reader,
                      MeasurementBatch& batch) {
  const simdjson::padded_string_view padded(text.data(), text.size(),
                                            text.size() + simdjson::SIMDJSON_PADDING);
  ondemand::document document;
  ondemand::object object;
  const std::size_t rows = batch.rows.size();
  if (thread_parser().iterate(padded).get(document) == simdjson::SUCCESS &&
      document.get_object().get(object) == simdjson::SUCCESS &&
      read_fields(object, reader, batch) && at_end(document)) {
    return true;
  }
  batch.rows.resize(rows);
  return false;
}

}  // namespace fitgauge::api
