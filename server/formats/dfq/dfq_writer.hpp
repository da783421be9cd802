#pragma once

#include "formats/dfq/reader.hpp"
#include "formats/sheet/time_zone.hpp"

namespace fitgauge::aqdef {

/// A measurement on its way into a DFQ.
struct OutgoingValue {
  std::string_view origin{};  ///< of its id: 16 hexadecimal digits
  std::int64_t number = 0;    ///< of its id
  Timestamp measured_at{};
  Length measured{};  ///< the judged size
  std::optional<Length> nominal{};
  SizeLimits limits{};
  std::string_view class_name{};  ///< empty: limits of a drawing
  std::string_view feature{};     ///< `hole` or `shaft`; empty: it is none
  std::string_view quantity{};    ///< empty: a diameter
  std::string_view rule{};        ///< `rule=guard_band;uncertainty_um=0.8`, or empty
  std::string_view part_id{};
  std::string_view characteristic{};
  std::string_view order{};
  std::string_view operation{};
  std::string_view machine{};
  std::string_view operator_name{};
  std::string_view gauge{};
  std::string_view unit{};
  std::string_view comment{};  ///< with the fields that travel in it
  std::string_view subgroup{};
};

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

  /// @errors FieldTooLong, FieldInvalid: a text does not fit its field; nothing is added.
  Result<void> add(const OutgoingValue& value);
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

  Fields part_fields(const OutgoingValue& value, const Comment& comment) const;
  static Fields characteristic_fields(const OutgoingValue& value);
  static Fields value_fields(const OutgoingValue& value, const Comment& comment);
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
