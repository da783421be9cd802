#pragma once

#include "formats/dfq/lines.hpp"
#include "formats/sheet/lengths.hpp"

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

/// The size of a characteristic.
struct Toleranced {
  sheet::LengthUnit unit = sheet::LengthUnit::Millimetre;
  Length nominal{};
  std::string class_name{};    ///< `H7`; empty: limits of a drawing
  sheet::SizeLimits limits{};  ///< of a class too, if the file has them
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
                                  std::optional<sheet::LengthUnit> fallback,
                                  const sheet::LimitsOfClass& limits_of);

/// The parts of a value between its separators, in this order.
inline constexpr std::array<int, 10> kCells = {
    k::kValue,  k::kAttribute, k::kTime,    k::kEvents,  k::kBatch,
    k::kCavity, k::kOperator,  k::kMachine, k::kProcess, k::kGauge};

/// A value with the fields after it. Its texts are views, valid until the next Reader::next.
struct Value {
  std::uint32_t characteristic = 0;
  std::uint32_t line = 0;
  std::uint32_t first_cell = 0;  ///< in ValueSet::starts, or in ValueSet::apart
  std::uint32_t cells = 0;
  bool is_apart = false;
};

/// `K0014/3 SN-7` below a line of values.
struct ValueField {
  std::uint32_t characteristic = 0;  ///< 0: all of the line
  int number = 0;
  std::string_view text;
};

/// A sequence that keeps its memory when emptied: a line of values needs no check for each.
template <class Thing>
class Row {
 public:
  std::size_t size() const { return size_; }
  Thing& operator[](std::size_t index) { return room_[index]; }
  const Thing& operator[](std::size_t index) const { return room_[index]; }
  Thing* begin() { return room_.data(); }
  Thing* end() { return room_.data() + size_; }
  const Thing* begin() const { return room_.data(); }
  const Thing* end() const { return room_.data() + size_; }
  void clear() { size_ = 0; }
  void push_back(const Thing& thing) {
    *room_for(1) = thing;
    ++size_;
  }
  /// Room for the next cells; they belong to the row after add_up_to() with their end.
  Thing* room_for(std::size_t most) {
    if (room_.size() - size_ < most) room_.resize(size_ + most);
    return room_.data() + size_;
  }
  void add_up_to(const Thing* end) { size_ = static_cast<std::size_t>(end - room_.data()); }

 private:
  std::vector<Thing> room_{};
  std::size_t size_ = 0;
};

/// The values of one line, or of K0001 of one characteristic after the other.
struct ValueSet {
  Row<Value> values{};
  const char* text = nullptr;     ///< the line of values
  Row<std::uint32_t> starts{};    ///< of its cells, in bytes, each after the last separator
  Row<std::string_view> apart{};  ///< cells with separate fields, at least kCells for each value
  std::vector<ValueField> fields{};

  /// Returns a text by its number of K0001 to K0012; empty if it is absent.
  std::string_view cell(const Value& value, std::size_t place) const {
    if (place >= value.cells) return {};
    const std::size_t index = value.first_cell + place;
    if (value.is_apart) return apart[index];
    return {text + starts[index], starts[index + 1] - starts[index] - 1};
  }
  /// Returns a field after the values: for the named value, or for all.
  std::string_view field(const Value& value, int number) const;
};

/// Reads a DFQ, or a DFD and then its DFX, in bounded memory. Not thread-safe; unusable after an
/// error.
class Reader {
 public:
  explicit Reader(Read read, sheet::Encoding encoding = sheet::Encoding::Detected)
      : lines_(std::move(read)), description_(encoding) {}

  /// The values of another file. @pre next() has returned false.
  void go_on_with(Read read) { lines_.go_on_with(std::move(read)); }

  /// The next values. @returns false at the end. @errors kMalformed with the line.
  Result<bool> next(ValueSet& set);

  /// The description before the last values.
  const Description& description() const { return description_; }

  /// Checks after the last value that counts agree. @errors kMalformed
  Result<void> check() const { return description_.check(); }

 private:
  Result<void> read_set(const Lines::Line& first, ValueSet& set);
  Result<void> add_values(const Lines::Line& line, ValueSet& set);
  /// @returns false when it begins the next set.
  Result<bool> add_field(const FieldLine& field, const Lines::Line& line, ValueSet& set);
  Result<void> check_end(const Lines::Line& line, const FieldLine* field) const;
  Result<void> count_values(const ValueSet& set);

  Lines lines_;
  Description description_;
  Row<std::uint32_t> ends_{};            ///< of the values of a line, counted in cells
  std::vector<std::uint32_t> counts_{};  ///< of values, by the index of the characteristic
};

}  // namespace fitgauge::aqdef
