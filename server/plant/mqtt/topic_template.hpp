#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "record/measurement.hpp"

namespace fitgauge::connections {

/// A text as one level of a topic, or a part of one: `% + # /`, control characters and what MQTT
/// gives no place (1.5.4) become `%XX` of their bytes, and no two texts become alike. An empty text
/// is `-`, a text `-` is `%2D`.
std::string topic_level(std::string_view text);

/// A topic with the texts of a measurement in it: `plant/{machine}/{characteristic}`.
class TopicTemplate {
 public:
  /// @errors FieldInvalid: no topic, an unknown name, a `{` without its end.
  static Result<TopicTemplate> parse(std::string_view text);
  /// The same for one level that stands behind others: without `/`, and it may begin with a name.
  static Result<TopicTemplate> parse_level(std::string_view text);

  /// A text that the measurement lacks is `-`. @returns at most 65,535 bytes: the fields are short.
  std::string topic_of(const app::Measurement& measurement) const;

 private:
  struct Part {
    bool is_name = false;
    std::string text{};
  };
  static Result<TopicTemplate> parse_parts(std::string_view text);

  std::vector<Part> parts_;
};

}  // namespace fitgauge::connections
