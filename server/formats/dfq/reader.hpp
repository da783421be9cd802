#pragma once

#include "formats/dfq/description.hpp"

namespace fitgauge::aqdef {

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
  Result<bool> read_set(const Lines::Line& first, ValueSet& set);
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
