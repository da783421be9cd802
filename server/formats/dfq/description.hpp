#pragma once

#include "base/length.hpp"
#include "formats/dfq/lines.hpp"

namespace fitgauge::aqdef {

/// A field of the description and its line.
struct Described {
  int number = 0;
  std::uint32_t line = 0;
  std::string text;  ///< UTF-8
};

/// The fields of a part, of a characteristic, or of all of them.
class FieldList {
 public:
  /// Returns null if the field is absent or empty.
  const Described* find(int number) const;
  std::string_view text(int number) const {
    const Described* const field = find(number);
    return field == nullptr ? std::string_view() : std::string_view(field->text);
  }
  /// @errors kMalformed: the field has a different text already.
  Result<void> add(const FieldLine& field, std::uint32_t line, std::string text);

 private:
  std::vector<Described> fields_;
};

struct Characteristic {
  std::uint32_t index = 0;  ///< from 1, over all parts
  std::uint32_t part = 0;   ///< 0: the file has no part
  std::uint32_t line = 0;   ///< its first line
  FieldList fields{};
  bool has_values = false;
};

/// The parts, characteristics and catalogues of a file. Bounded in memory.
class Description {
 public:
  static constexpr std::size_t kMostCharacteristics = 20'000;
  static constexpr std::size_t kMostBytes = std::size_t{8} << 20;  ///< of all texts

  explicit Description(sheet::Encoding encoding) : encoding_(encoding) {}

  /// Reads a line that is not a value. @errors kMalformed
  Result<void> add(const FieldLine& field, std::uint32_t line);
  /// Checks for missing lines at the end. @errors kMalformed
  Result<void> check() const;

  std::size_t count() const { return count_; }
  /// Returns null if the file has none of that index. @param index from 1
  Characteristic* characteristic(std::uint32_t index);
  const Characteristic* characteristic(std::uint32_t index) const;

  /// The field of a characteristic, else of all (`/0`). Null if both are absent or empty.
  const Described* find(const Characteristic& characteristic, int number) const {
    const Described* const own = characteristic.fields.find(number);
    return own == nullptr ? all_characteristics_.find(number) : own;
  }
  std::string_view text(const Characteristic& characteristic, int number) const {
    const Described* const field = find(characteristic, number);
    return field == nullptr ? std::string_view() : std::string_view(field->text);
  }
  /// Returns a text of the characteristic's part.
  std::string_view part_text(const Characteristic& characteristic, int number) const;
  /// Returns a text of a catalogue's entry.
  std::string_view catalogue_text(int number, std::uint32_t entry) const {
    const auto found = catalogues_.find({number, entry});
    return found == catalogues_.end() ? std::string_view() : std::string_view(found->second);
  }

  /// Returns the text in UTF-8. @errors kMalformed, without a place
  Result<std::string> decoded(std::string_view bytes) const;

 private:
  Result<void> add_to_characteristics(const FieldLine& field, std::uint32_t line, std::string text);

  sheet::Encoding encoding_;
  std::size_t bytes_ = 0;
  std::optional<std::uint32_t> stated_count_{};
  std::uint32_t part_ = 0;  ///< that the next characteristics belong to
  FieldList all_parts_{};
  FieldList all_characteristics_{};
  std::map<std::uint32_t, FieldList> parts_{};
  std::vector<Characteristic> characteristics_{};  ///< by index - 1; of index 0: not described
  std::size_t count_ = 0;                          ///< of those that are
  std::map<std::pair<int, std::uint32_t>, std::string> catalogues_{};
};

/// A unit of length, as K2142 names it.
enum class LengthUnit : std::uint8_t { Millimetre, Micrometre, Centimetre, Metre, Inch };

/// `mm`, `µm`, `cm`, `m`, `inch` and other usual names, in either case.
std::optional<LengthUnit> length_unit(std::string_view name);

/// To the nearest nanometre, as measured values are read. A decimal comma and an exponent are.
/// @errors LengthMalformed, LengthOutOfRange
Result<Length> parse_length(std::string_view text, LengthUnit unit);

struct SizeLimits {
  std::optional<Length> upper{};
  std::optional<Length> lower{};

  friend bool operator==(const SizeLimits&, const SizeLimits&) = default;
};

/// Limits of a class for a nominal size, from the tables.
using LimitsOfClass = std::function<Result<SizeLimits>(Length nominal, const std::string& name)>;

/// The size of a characteristic.
struct Toleranced {
  LengthUnit unit = LengthUnit::Millimetre;
  Length nominal{};
  std::string class_name{};  ///< `H7`; empty: limits of a drawing
  SizeLimits limits{};       ///< of a class too, if the file has them
};

/// The user field of fitgauge in a characteristic (K2800 to K2802): `name=…`, or nothing.
std::string_view user_text(const Description& description, const Characteristic& characteristic,
                           std::string_view name);

/// Reads K2101 to K2142 of a characteristic. A natural limit counts as no limit.
/// @param fallback unit if K2142 is absent. @param limits_of may be null: then limits of a class
/// are not compared with the tables.
/// @errors kMalformed with the line: it is not a length, or its fields contradict each other.
Result<Toleranced> read_tolerance(const Description& description,
                                  const Characteristic& characteristic,
                                  std::optional<LengthUnit> fallback,
                                  const LimitsOfClass& limits_of);

}  // namespace fitgauge::aqdef
