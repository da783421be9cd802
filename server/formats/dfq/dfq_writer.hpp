#pragma once

#include "formats/dfq/reader.hpp"
#include "formats/sheet/time_zone.hpp"
#include "record/measurement.hpp"

namespace fitgauge::aqdef {

struct DfqOptions {
  std::string part_number = "-";          ///< K1001 of measurements without one
  std::string part_description = "-";     ///< K1002 of measurements without one
  std::optional<sheet::TimeZone> zone{};  ///< of the times; none: UTC
};

/// Whether a text fits a field. @errors FieldTooLong, FieldInvalid
Result<void> check_text(int number, std::string_view text);

/// Makes a DFQ: K0100, parts with their characteristics, catalogues of machines, operators and
/// gauges, then the values in their order, each with its K0097. Lines end with CR LF. The text is
/// Windows-1252, or UTF-8 with a mark if it has other characters. The format has no fractions of a
/// second. The same measurements give the same bytes, also after an import. Not thread-safe.
class DfqWriter {
 public:
  explicit DfqWriter(DfqOptions options) : options_(std::move(options)) {}

  /// @errors FieldTooLong, FieldInvalid: a text does not fit its field, or the measurement is
  /// simulated; nothing is added.
  Result<void> add(const app::Measurement& measurement);
  bool is_empty() const { return values_.empty(); }
  /// The whole file.
  std::string text() const;

 private:
  using Fields = std::vector<std::pair<int, std::string>>;

  struct Described {
    std::size_t part = 0;
    Fields fields{};
    int decimals = 0;
  };
  struct Written {
    std::size_t characteristic = 0;
    std::string part_id{};
    std::array<std::string, kCells.size()> cells{};
    Fields fields{};  ///< in ascending order
  };
  struct Catalogue {
    int field = 0;
    std::vector<std::string> entries{};
  };

  Fields part_fields(const app::Measurement& m, const Comment& comment) const;
  static Fields characteristic_fields(const app::Measurement& m);
  static Fields value_fields(const app::Measurement& m, const Comment& comment);
  std::size_t place_of_part(const Fields& fields) {
    const auto [known, is_new] = known_parts_.try_emplace(fields, parts_.size());
    if (is_new) parts_.push_back(fields);
    return known->second;
  }
  std::size_t place_of_characteristic(std::size_t part, const Fields& fields);
  static std::string entry(Catalogue& catalogue, std::string_view text);
  std::string time_text(Timestamp time) const;
  /// The index of each characteristic, from 1, part by part.
  std::vector<std::size_t> indices() const;
  void append_description(std::string& out, const std::vector<std::size_t>& indices) const;
  void append_values(std::string& out, const std::vector<std::size_t>& indices) const;

  DfqOptions options_;
  std::vector<Fields> parts_{};
  std::vector<Described> characteristics_{};
  std::map<Fields, std::size_t> known_parts_{};
  std::map<std::pair<std::size_t, Fields>, std::size_t> known_characteristics_{};
  Catalogue machines_{.field = k::kMachineNumber};
  Catalogue operators_{.field = k::kOperatorName};
  Catalogue gauges_{.field = k::kGaugeNumber};
  std::vector<Written> values_{};
};

}  // namespace fitgauge::aqdef
