#pragma once

namespace fitgauge {
struct JsonValue;
}

namespace fitgauge::connections {

/// A JSON text with `{{field}}` of an event in it: a member of its data, or `type`, `timestamp`,
/// `id`, `data`; a path of members has dots. In a longer text a field is its text. A text of only a
/// field becomes the value: a number, an object, null if it is absent.
class BodyTemplate {
 public:
  static constexpr std::size_t kLongest = 16'384;

  /// @param body the template as a JSON value, or as a string with its text.
  /// @errors FieldInvalid
  static Result<BodyTemplate> read(const JsonValue& body);

  bool is_empty() const { return parts_.empty(); }
  /// The body of one event. @param event JSON, as it would be sent without a template.
  std::string body_of(std::string_view id, std::string_view event) const;

 private:
  struct Part {
    enum class Kind { Literal, Text, Value } kind = Kind::Literal;
    std::string text{};  ///< or the name of the field
  };
  static Result<BodyTemplate> parse(std::string_view text);

  std::vector<Part> parts_;
};

/// The bytes of a secret: `whsec_` and 24 to 64 bytes in base64. @returns none for anything else.
std::optional<std::string> webhook_key(std::string_view secret);

/// The value of webhook-signature: `v1,` and the HMAC-SHA256 of `id.timestamp.body` in base64, one
/// for each key (Standard Webhooks, "Signature scheme").
std::string webhook_signature(const std::vector<std::string>& keys, std::string_view id,
                              std::string_view timestamp, std::string_view body);

}  // namespace fitgauge::connections
