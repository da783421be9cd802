#include "cli/json_value.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace fitgauge::cli {
namespace {

using Json = nlohmann::json;
using Kind = JsonValue::Kind;

/// Builds the tree from the parser's calls.
class TreeBuilder final : public nlohmann::json_sax<Json> {
 public:
  explicit TreeBuilder(JsonValue& root) : root_(root) {}

  bool null() override { return add({.kind = Kind::Null}) != nullptr; }
  bool boolean(bool value) override { return scalar(Kind::Boolean, value ? "true" : "false"); }
  bool number_integer(number_integer_t value) override {
    return scalar(Kind::Number, std::to_string(value));
  }
  bool number_unsigned(number_unsigned_t value) override {
    return scalar(Kind::Number, std::to_string(value));
  }
  bool number_float(number_float_t, const string_t& digits) override {
    return scalar(Kind::Number, digits);
  }
  bool string(string_t& value) override { return scalar(Kind::String, std::move(value)); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(Kind::Object); }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(Kind::Array); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    name_ = std::move(name);
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
    return false;
  }

 private:
  JsonValue* add(JsonValue value) {
    if (open_.empty()) return &(root_ = std::move(value));
    JsonValue& parent = *open_.back();
    if (parent.kind == Kind::Array) return &parent.items.emplace_back(std::move(value));
    return &parent.members.emplace_back(std::move(name_), std::move(value)).second;
  }
  bool scalar(Kind kind, std::string text) {
    return add({.kind = kind, .text = std::move(text)}) != nullptr;
  }
  bool open(Kind kind) {
    // A parent grows only after its open child is closed, so the pointers stay valid.
    open_.push_back(add({.kind = kind}));
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  JsonValue& root_;
  std::vector<JsonValue*> open_;
  std::string name_;
};

}  // namespace

const JsonValue* JsonValue::find(std::string_view name) const {
  const auto found = std::find_if(members.begin(), members.end(),
                                  [name](const auto& member) { return member.first == name; });
  return found == members.end() ? nullptr : &found->second;
}

std::string_view JsonValue::text_of(std::string_view name) const {
  const JsonValue* value = find(name);
  return value == nullptr ? std::string_view() : std::string_view(value->text);
}

const std::vector<JsonValue>& JsonValue::items_of(std::string_view name) const {
  return object(name).items;
}

const JsonValue& JsonValue::object(std::string_view name) const {
  static const JsonValue kNone;
  const JsonValue* value = find(name);
  return value == nullptr ? kNone : *value;
}

std::optional<JsonValue> parse_json(std::string_view text) {
  JsonValue root;
  TreeBuilder builder(root);
  if (!Json::sax_parse(text, &builder)) return std::nullopt;
  return root;
}

std::string json_quoted(std::string_view text) { return Json(text).dump(); }

JsonObject& JsonObject::add(std::string_view name, std::string_view value) {
  return add_raw(name, json_quoted(value));
}

JsonObject& JsonObject::add_given(std::string_view name, std::string_view value) {
  return value.empty() ? *this : add(name, value);
}

JsonObject& JsonObject::add_raw(std::string_view name, std::string_view json) {
  if (!members_.empty()) members_ += ',';
  members_.append(json_quoted(name)).append(":").append(json);
  return *this;
}

}  // namespace fitgauge::cli
