#include "base/json/json_value.hpp"

#include <simdjson.h>

#include <nlohmann/json.hpp>

namespace fitgauge {
namespace {

constexpr std::size_t kDeepest = 32;

std::string place(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, std::min(offset, text.size()));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t start = before.rfind('\n');
  const std::size_t column = before.size() - (start == std::string_view::npos ? 0 : start + 1) + 1;
  return fmt::format("line {}, column {}", line, column);
}

/// A repeated name. Sorted, because an object may have as many members as fit into a body.
std::optional<std::string_view> repeated_name(const JsonValue& object) {
  std::vector<std::string_view> names;
  names.reserve(object.members.size());
  for (const auto& [name, value] : object.members) names.push_back(name);
  std::sort(names.begin(), names.end());
  const auto twice = std::adjacent_find(names.begin(), names.end());
  return twice == names.end() ? std::nullopt : std::optional(*twice);
}

/// Uses long double for floating-point numbers: nlohmann::json refuses numbers that overflow
/// double, but 1e999 is readable JSON whose value the field must judge.
using WideJson = nlohmann::basic_json<std::map, std::vector, std::string, bool, std::int64_t,
                                      std::uint64_t, long double>;

/// Builds a JsonValue from the library's events, which carry the digits of a number.
class Builder final : public nlohmann::json_sax<WideJson> {
 public:
  Builder(std::string_view text, const JsonItemHandler& handle_item, std::size_t most)
      : text_(text), handle_item_(handle_item), most_(most) {}

  bool null() override { return add({}); }
  bool boolean(bool value) override {
    return add({.kind = JsonValue::Kind::Boolean, .boolean = value});
  }
  bool number_integer(number_integer_t value) override { return number(std::to_string(value)); }
  bool number_unsigned(number_unsigned_t value) override { return number(std::to_string(value)); }
  bool number_float(number_float_t, const string_t& digits) override { return number(digits); }
  bool string(string_t& value) override {
    return add({.kind = JsonValue::Kind::String, .text = std::move(value)});
  }
  bool binary(binary_t&) override { return false; }

  bool start_object(std::size_t) override { return open(JsonValue::Kind::Object); }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(JsonValue::Kind::Array); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    open_.back().members.emplace_back(std::move(name), JsonValue{});
    return true;
  }

  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::detail::exception& exception) override {
    // The text after the library's prefix names the read and the expected token.
    constexpr std::size_t kLongestReason = 160;
    std::string_view reason = exception.what();
    if (const auto at = reason.find(": "); at != std::string_view::npos)
      reason.remove_prefix(at + 2);
    const std::string where = place(text_, position == 0 ? 0 : position - 1);
    error_ =
        Error{ErrorCode::JsonMalformed,
              fmt::format("at {}: {}", where, first_characters(reason, kLongestReason)), where};
    return false;
  }

  const Error& error() const { return error_; }
  JsonValue take() { return std::move(root_); }

 private:
  bool number(std::string digits) {
    return add({.kind = JsonValue::Kind::Number, .text = std::move(digits)});
  }

  bool open(JsonValue::Kind kind) {
    if (open_.size() == kDeepest) {
      error_ = Error::of(ErrorCode::JsonTooDeep, "more than {} levels", kDeepest);
      return false;
    }
    open_.push_back({.kind = kind});
    return true;
  }
  bool close() {
    JsonValue value = std::move(open_.back());
    open_.pop_back();
    if (const auto name = repeated_name(value)) {
      error_ = Error::of(ErrorCode::JsonDuplicateKey, "the key \"{}\" occurs twice", *name);
      return false;
    }
    return add(std::move(value));
  }
  bool add(JsonValue value) {
    if (++count_ > most_) {
      error_ = Error::of(ErrorCode::BodyTooLarge, "more than {} values", most_);
      return false;
    }
    if (open_.empty()) {
      root_ = std::move(value);
    } else if (handle_item_ && open_.size() == 1 && open_.back().is(JsonValue::Kind::Array)) {
      count_ = 0;
      return handle_item_(value);
    } else if (open_.back().is(JsonValue::Kind::Array)) {
      open_.back().items.push_back(std::move(value));
    } else {
      open_.back().members.back().second = std::move(value);
    }
    return true;
  }

  std::string_view text_;
  const JsonItemHandler& handle_item_;
  const std::size_t most_;
  std::vector<JsonValue> open_;
  JsonValue root_;
  std::size_t count_ = 0;
  Error error_{ErrorCode::JsonMalformed, "the JSON cannot be read"};
};

/// @param most values of the tree that is built; items handed over are counted each by itself.
Result<JsonValue> read(std::string_view text, const JsonItemHandler& handle_item,
                       std::size_t most) {
  if (text.starts_with("\xEF\xBB\xBF"))
    return Error{ErrorCode::TextEncoding, "JSON begins with a byte-order mark: remove it"};
  if (const std::size_t at = find_invalid_utf8(text); at != std::string_view::npos)
    return Error{ErrorCode::TextEncoding, fmt::format("byte {} is not UTF-8", at), place(text, at)};
  // The library regards a NUL as the end of the text.
  if (const std::size_t at = text.find('\0'); at != std::string_view::npos) {
    const std::string where = place(text, at);
    return Error{ErrorCode::JsonMalformed, fmt::format("at {}: a NUL character", where), where};
  }
  Builder builder(text, handle_item, most);
  if (!WideJson::sax_parse(text, &builder)) return builder.error();
  return builder.take();
}

}  // namespace

const JsonValue* JsonValue::find(std::string_view name) const {
  const auto found = std::find_if(members.begin(), members.end(),
                                  [&](const auto& member) { return member.first == name; });
  return found == members.end() ? nullptr : &found->second;
}

const JsonValue& JsonValue::member(std::string_view name) const {
  static const JsonValue kNone;
  const JsonValue* value = find(name);
  return value == nullptr ? kNone : *value;
}

std::string_view JsonValue::text_of(std::string_view name) const {
  const JsonValue& value = member(name);
  if (value.is(Kind::Boolean)) return value.boolean ? "true" : "false";
  return value.text;
}

std::string_view name_of(JsonValue::Kind kind) {
  constexpr std::string_view kNames[] = {"null",     "a boolean", "a number",
                                         "a string", "an array",  "an object"};
  return kNames[static_cast<std::size_t>(kind)];
}

Result<JsonValue> parse_json(std::string_view text, std::size_t most) {
  return read(text, {}, most);
}

Result<JsonValue> parse_json(std::string_view text, const JsonItemHandler& handle_item) {
  return read(text, handle_item, kMostRequestValues);
}

Result<JsonValue> parse_stored_json(std::string_view text, std::string_view what,
                                    const JsonItemHandler& handle_item) {
  auto value = parse_json(text, handle_item);
  if (value) return value;
  return Error::of(ErrorCode::StorageCorrupt,
                   "the stored {} cannot be read ({}): restore a backup, or delete it", what,
                   value.error().message);
}

std::string pointer_to(std::string_view pointer, std::string_view token) {
  std::string out(pointer);
  out += '/';
  for (const char c : token) {
    if (c == '~') {
      out += "~0";
    } else if (c == '/') {
      out += "~1";
    } else {
      out += c;
    }
  }
  return out;
}

std::string pointer_to(std::string_view pointer, std::size_t index) {
  return fmt::format("{}/{}", pointer, index);
}

}  // namespace fitgauge

namespace fitgauge::api {
namespace {

namespace ondemand = simdjson::ondemand;

simdjson::error_code find(ondemand::document& document, std::string_view name,
                          std::string_view& text) {
  ondemand::value value;
  if (const auto failure = document.find_field(name).get(value)) return failure;
  ondemand::array list;
  if (value.get_array().get(list) == simdjson::SUCCESS) return list.raw_json().get(text);
  ondemand::object members;
  if (const auto failure = value.get_object().get(members)) return failure;
  return members.raw_json().get(text);
}

}  // namespace

Result<std::string> stored_member(std::string_view object, std::string_view name,
                                  std::string_view what) {
  ondemand::parser parser;
  const simdjson::padded_string padded(object);
  ondemand::document document;
  std::string_view found;
  auto failure = parser.iterate(padded).get(document);
  if (failure == simdjson::SUCCESS) failure = find(document, name, found);
  if (failure == simdjson::NO_SUCH_FIELD) return std::string();
  if (failure == simdjson::SUCCESS) return std::string(found);
  return Error::of(ErrorCode::StorageCorrupt,
                   "the stored {} cannot be read ({}): restore a backup, or delete it", what,
                   simdjson::error_message(failure));
}

}  // namespace fitgauge::api
