#pragma once

#include "formats/dfq/reader.hpp"
#include "formats/sheet/shop_csv.hpp"

namespace fitgauge::aqdef {

/// Whether a file name ends with `.dfq`.
inline bool is_dfq(std::string_view file_name) { return ascii_lower(file_name).ends_with(".dfq"); }

/// As for a table; columns are `K0054` and the field of a measurement that it is, constants are for
/// a file without that field, others are characteristics and values that are not measurements.
struct MeasurementOptions : sheet::ShopCsvOptions {
  std::optional<sheet::LengthUnit> length_unit{};  ///< if the file has none
};

/// Converts a DFQ to CSV for /v1/measurements: a header, and a line for each value. K0053 is order,
/// K0014 part_id, K0009 comment, K0006 subgroup; machine, operator and gauge are the texts of the
/// catalogues, else their numbers; K2002 is characteristic, K1086 operation, K1303 unit. Other
/// fields of a value, and K1001 and K1002, are stored in the comment (carried.hpp). Values with
/// attribute 255 or 256 are skipped. Not thread-safe; unusable after an error.
class MeasurementCsv {
 public:
  MeasurementCsv(Read read, MeasurementOptions options);

  /// The first line, with its end.
  const std::string& header() const { return header_; }
  /// The values of another file, below the description of the first: a DFX.
  void go_on_with(Read read) { reader_.go_on_with(std::move(read)); }

  /// Appends the rows of the next values, some 64 KiB at most, and the line of the file that each
  /// is from.
  /// @returns false at the end. @errors kMalformed, TimeMalformed with the line
  Result<bool> append(std::string& rows, std::vector<std::uint32_t>& lines);
  /// Checks the file after the last value. @errors kMalformed: counts differ, or there is no value.
  Result<void> check() const;

 private:
  /// Fields that all values of a characteristic share.
  struct Prepared {
    bool is_left_out = false;
    sheet::LengthUnit unit = sheet::LengthUnit::Millimetre;
    std::vector<std::string> fields{};  ///< by their places in the header
    std::vector<CarriedField> carried{};
  };

  Result<const Prepared*> prepared(std::uint32_t index);
  Result<Prepared> prepare(const Characteristic& characteristic) const;
  /// Returns why it is not a measurement; empty if it is one.
  std::string reason_against(const Characteristic& characteristic) const;
  Result<void> prepare_size(const Characteristic& characteristic, Prepared& made) const;
  std::string described_name(const Characteristic& characteristic) const;

  /// @returns whether there is a value to append.
  Result<bool> is_measured(const ValueSet& set, const Value& value) const;
  Result<void> append_value(const ValueSet& set, const Value& value, const Prepared& prepared,
                            std::string& rows);
  Result<void> take_value_fields(const ValueSet& set, const Value& value);
  void take_comment(const ValueSet& set, const Value& value, const Prepared& prepared);
  Result<std::string_view> time_of(std::string_view text);
  /// The text of an entry of a catalogue, or its number; empty for 0.
  std::string_view entry(int first_field, int second_field, std::string_view number) const;
  /// Returns the text in UTF-8, valid until the next value.
  Result<std::string_view> utf8(std::string_view text);
  std::optional<std::size_t> mapped_place(int number) const;
  void set(std::size_t place, std::string_view text) {
    if (!text.empty()) row_[place] = text;
  }

  MeasurementOptions options_;
  Reader reader_;
  std::string header_;
  std::vector<std::pair<int, std::size_t>> mapped_{};  ///< numbers of fields, and places
  std::vector<std::optional<Prepared>> prepared_{};    ///< by index
  std::size_t prepared_bytes_ = 0;
  ValueSet set_;
  std::size_t next_value_ = 0;         ///< of the set
  std::vector<std::string_view> row_;  ///< of the value that is appended
  std::deque<std::string> texts_;      ///< of that value, converted from the file's form
  std::string last_time_;              ///< as in the file, and as read
  std::string last_instant_;
  bool has_values_ = false;
  bool has_left_out_ = false;
};

}  // namespace fitgauge::aqdef
