#include "formats/dfq/reader.hpp"

namespace fitgauge::aqdef {
namespace {

/// Place of a field of a value between the separators; npos for any other.
std::size_t place_of(int number) {
  const auto* const found = std::ranges::find(kCells, number);
  return found == kCells.end() ? std::string_view::npos
                               : static_cast<std::size_t>(found - kCells.begin());
}

/// Whether a text that is cut in it makes another measurement.
bool must_be_whole(int number) {
  return number == k::kText || number == k::kPartIdent || number == k::kOrder ||
         number == k::kGuid || place_of(number) != std::string_view::npos;
}

/// Gives a value room for all cells, and keeps the cells it has.
void set_apart(Value& value, ValueSet& set) {
  const auto first = static_cast<std::uint32_t>(set.apart.size());
  const auto cells = std::max<std::uint32_t>(value.cells, kCells.size());
  for (std::size_t place = 0; place < cells; ++place) set.apart.push_back(set.cell(value, place));
  value.first_cell = first;
  value.cells = cells;
  value.is_apart = true;
}

Result<FieldLine> parse(const Lines::Line& line) {
  auto field = parse_field_line(line.text);
  if (!field) return at_line(line.number, field.error().message);
  return field;
}

bool begins_value(char c) {
  return (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.' || c == ',' || c == ' ' ||
         c == kFieldSeparator || c == kValueSeparator;
}

}  // namespace

std::string_view ValueSet::field(const Value& value, int number) const {
  std::string_view of_all;
  for (const ValueField& field : fields) {
    if (field.number != number) continue;
    if (field.characteristic == value.characteristic) return field.text;
    if (field.characteristic == 0) of_all = field.text;
  }
  return of_all;
}

Result<bool> Reader::next(ValueSet& set) {
  Lines::Line line;
  for (;;) {
    lines_.mark();
    if (!lines_.next(line)) {
      if (lines_.failure()) return *lines_.failure();
      return false;
    }
    if (!is_field_line(line.text)) break;
    const auto field = TRY(parse(line));
    if (level_of(field.number) == Level::Value) break;
    TRY(check_end(line, &field));
    if (const auto added = description_.add(field, line.number); !added)
      return at_line(line.number, added.error().message);
  }
  for (;;) {
    const std::size_t moves = lines_.moves();
    TRY(read_set(line, set));
    if (moves == lines_.moves()) break;
    // The buffer has moved, so the views are of the old place of the lines.
    lines_.rewind();
    lines_.next(line);
  }
  TRY(count_values(set));
  return true;
}

Result<void> Reader::read_set(const Lines::Line& first, ValueSet& set) {
  set.values.clear();
  set.starts.clear();
  set.apart.clear();
  set.fields.clear();
  Lines::Line line = first;
  const bool is_of_fields = is_field_line(first.text);
  if (!is_of_fields) {
    TRY(add_values(first, set));
  } else {
    const auto field = TRY(parse(first));
    if (field.number != k::kValue && field.number != k::kSubgroupSize) {
      return at_line(first.number, "has K{:04} before any value: write it after its value",
                     field.number);
    }
    TRY(add_field(field, first, set));
  }
  while (lines_.next(line)) {
    bool is_of_set = is_field_line(line.text);
    if (is_of_set) {
      const auto field = TRY(parse(line));
      is_of_set = level_of(field.number) == Level::Value && TRY(add_field(field, line, set));
    }
    if (is_of_set) continue;
    lines_.unread();
    return {};
  }
  if (lines_.failure()) return *lines_.failure();
  return {};
}

Result<void> Reader::check_end(const Lines::Line& line, const FieldLine* field) const {
  if (line.is_ended) return {};
  if (field != nullptr && !must_be_whole(field->number)) return {};
  return at_line(line.number,
                 "has no line end, so the file may be cut: end its last line, or send it again");
}

Result<void> Reader::add_values(const Lines::Line& line, ValueSet& set) {
  TRY(check_end(line, nullptr));
  std::string_view rest = line.text;
  if (!begins_value(rest[0])) {
    return at_line(line.number, "begins with '{}', and is neither a field nor a value",
                   first_characters(rest, 20));
  }
  // A separator may follow the last value.
  if (rest.back() == kValueSeparator) rest.remove_suffix(1);
  const std::size_t count = description_.count();
  set.text = rest.data();
  const std::size_t most = rest.size() + kSeparateRoom;
  std::uint32_t* const starts = set.starts.room_for(1 + most + 1);
  std::uint32_t* const ends = ends_.room_for(most + 1);
  starts[0] = 0;
  Separated found = separate(rest, starts + 1, ends);
  *found.starts++ = static_cast<std::uint32_t>(rest.size()) + 1;
  *found.values++ = static_cast<std::uint32_t>(found.starts - starts) - 1;
  const auto values = static_cast<std::size_t>(found.values - ends);
  if (values > count) {
    return at_line(line.number, "has more values than the {} characteristics described above it",
                   count);
  }
  Value* value = set.values.room_for(values);
  std::uint32_t first = 0;
  for (std::uint32_t index = 0; index < values; ++index) {
    *value++ = {.characteristic = index + 1,
                .line = line.number,
                .first_cell = first,
                .cells = ends[index] - first};
    first = ends[index];
  }
  set.starts.add_up_to(found.starts);
  set.values.add_up_to(value);
  return {};
}

Result<bool> Reader::add_field(const FieldLine& field, const Lines::Line& line, ValueSet& set) {
  TRY(check_end(line, &field));
  const bool is_value = field.number == k::kValue || field.number == k::kSubgroupSize;
  const auto* const of_field = std::ranges::find_if(
      set.values, [&](const Value& value) { return value.characteristic == field.index; });
  if (is_value) {
    if (field.index == 0) {
      return at_line(line.number,
                     "has K{:04} for all characteristics: write the number of its characteristic, "
                     "such as K{:04}/1",
                     field.number, field.number);
    }
    if (of_field != set.values.end()) return false;
    Value& value = *set.values.room_for(1);
    value = {.characteristic = field.index, .line = line.number};
    set.values.add_up_to(&value + 1);
    set_apart(value, set);
    set.apart[value.first_cell] = field.text;
    if (field.number == k::kSubgroupSize)
      set.fields.push_back({field.index, field.number, field.text});
    return true;
  }
  if (field.index != 0 && of_field == set.values.end()) {
    return at_line(line.number, "has K{:04} of characteristic {}, which has no value above it",
                   field.number, field.index);
  }
  if (field.value_index != 0) {
    const std::uint32_t last =
        field.index == 0 || field.index >= counts_.size() ? 1 : counts_[field.index] + 1;
    if (field.index == 0 || field.value_index != last) {
      return at_line(line.number, "is for value {}: write it after this value, without the number",
                     field.value_index);
    }
  }
  const std::size_t place = place_of(field.number);
  if (place == std::string_view::npos) {
    set.fields.push_back({field.index, field.number, field.text});
    return true;
  }
  for (Value& value : set.values) {
    if (field.index != 0 && value.characteristic != field.index) continue;
    if (field.index == 0 && !set.cell(value, place).empty()) continue;
    if (!value.is_apart) set_apart(value, set);
    set.apart[value.first_cell + place] = field.text;
  }
  return true;
}

Result<void> Reader::count_values(const ValueSet& set) {
  for (const Value& value : set.values) {
    Characteristic* const characteristic = description_.characteristic(value.characteristic);
    if (characteristic == nullptr) {
      return at_line(value.line, "has a value of characteristic {}, which no line above describes",
                     value.characteristic);
    }
    characteristic->has_values = true;
    if (counts_.size() <= value.characteristic) counts_.resize(value.characteristic + 1);
    ++counts_[value.characteristic];
  }
  return {};
}

}  // namespace fitgauge::aqdef
