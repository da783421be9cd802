#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"

namespace fitgauge {
struct JsonValue;
}

namespace fitgauge::connections {

/// A JSON text with `{{field}}` of an event in it: a member of its data, or `type`, `timestamp`,
/// `id`, `data`; a path of members has dots. Inside a longer text a field is its text. A text that
/// is a field alone becomes the value as it is: a number, an object, null where there is none.
class BodyTemplate {
 public:
  static constexpr std::size_t kLongest = 16'384;

  /// @param body the template as a JSON value, or as a string that holds its text.
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

}  // namespace fitgauge::connections
