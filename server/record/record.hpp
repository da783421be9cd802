#pragma once

#include "base/digest.hpp"
#include "base/json/json_value.hpp"
#include "base/json/text_arena.hpp"
#include "record/measurement.hpp"

namespace fitgauge::app {

/// Appends the record of a measurement: JSON in the form of RFC 8785 (members sorted, one spelling
/// of each number and text), so that the record as it is answered is also what the log holds of it.
/// Fields that were not given are left out. Numbers are exact decimals: the finest step, 0.001 µm,
/// is coarser than the doubles around the longest length, so RFC 8785 spells them alike.
void append_record(std::string& out, const Measurement& measurement);

/// Appends records. Equal times and limits are copied from the previous record. Each measurement
/// must stay in place until the next one is written.
class RecordWriter {
 public:
  explicit RecordWriter(std::string& out) : out_(out) {}

  void append(const Measurement& measurement);

 private:
  static constexpr std::size_t kMostMembers = 80;
  /// Place of a part of the previous record.
  struct Place {
    std::size_t at = 0;
    std::size_t size = 0;
  };
  std::string& out_;
  const Measurement* before_ = nullptr;
  std::array<Place, kMostMembers> parts_;  ///< of the members that records share
};

}  // namespace fitgauge::app

namespace fitgauge::api {

/// Returns the member's text; empty if it is not a text.
inline std::string text_of(const JsonValue& json, std::string_view name) {
  const JsonValue* value = json.find(name);
  return value != nullptr && value->is(JsonValue::Kind::String) ? value->text : std::string();
}

/// Reads the output of to_hex(); none for other texts.
inline std::optional<Digest> digest_from_hex(std::string_view hex) {
  Digest digest{};
  if (hex.size() != 2 * digest.size()) return std::nullopt;
  for (std::size_t i = 0; i < digest.size(); ++i) {
    const char* const at = hex.data() + 2 * i;
    if (std::from_chars(at, at + 2, digest.at(i), 16).ptr != at + 2) return std::nullopt;
  }
  return digest;
}

/// Reads a record of RecordWriter back into a measurement. `correction_of` and the digits of
/// `corrected_elsewhere` name the corrected measurement. Members that follow from others are
/// skipped. To check that a text was read completely, write the measurement again and compare the
/// two texts.
/// @param texts owns the texts that the measurement refers to.
/// @errors LogRecordInvalid.
Result<app::Measurement> read_record(const JsonValue& record, TextArena& texts);

}  // namespace fitgauge::api
