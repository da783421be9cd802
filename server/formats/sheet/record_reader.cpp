#include "formats/sheet/record_reader.hpp"

#include "tables/standards/standard.hpp"

namespace fitgauge::sheet {
namespace {

bool is_exported(const JsonValue& record) {
  return record.is(JsonValue::Kind::Object) &&
         std::ranges::all_of(
             kOfExport, [&record](std::string_view name) { return record.find(name) != nullptr; });
}

Result<std::optional<Length>> length_in(std::string_view member, std::string_view text) {
  if (text.empty()) return std::optional<Length>();
  const auto read = parse_length(text, LengthUnit::Millimetre);
  if (read) return std::optional(*read);
  return Error::of(ErrorCode::CsvMalformed, "has '{}' in {}, which must be a length",
                   first_characters(text, 40), member);
}

}  // namespace

Result<ExportedRow> read_exported(
    const std::function<std::string_view(std::string_view member)>& text_of,
    const LimitsOfClass& limits_of) {
  const auto wrong = [](std::string message) {
    return Error{ErrorCode::CsvMalformed, std::move(message)};
  };
  if (text_of("source") != "gauge")
    return wrong("is simulated, and cannot be imported: export with source=gauge");
  if (const std::string_view corrected = text_of("correction_of"); !corrected.empty()) {
    return wrong(
        fmt::format("is a correction of {}: remove the row and use `fitgauge correct`, or "
                    "remove its correction_of to store it as a new measurement",
                    first_characters(corrected, 40)));
  }
  const std::string_view basis = text_of("basis");
  const std::string name(text_of("tolerance_class"));
  ExportedRow row{.has_drawn_limits = basis == "explicit"};
  row.has_feature = row.has_drawn_limits || standards::is_class(name);
  if (name.empty()) return row;
  const auto nominal = TRY(length_in("nominal_mm", text_of("nominal_mm")));
  if (!nominal) return row;  // the reader of fields reports it
  if (basis == "standard") {
    standards::append_designation(row.designation, *nominal, name);
  } else if (limits_of) {
    const auto limits = limits_of(*nominal, name);
    if (!limits) return wrong("has a tolerance class: " + limits.error().message);
    for (const auto& [member, of_class] :
         {std::pair("lower_limit_mm", limits->lower), std::pair("upper_limit_mm", limits->upper)}) {
      const auto in_file = TRY(length_in(member, text_of(member)));
      if (auto differs = difference(member, in_file, of_class, *nominal, name))
        return wrong(*differs + " here: set the same class, or correct the row");
    }
  }
  return row;
}

std::string_view field_of_export(std::string_view member, const ExportedRow& row) {
  const auto if_so = [](bool has, std::string_view field) {
    return has ? field : std::string_view();
  };
  if (member == "upper_deviation_um") return if_so(row.has_drawn_limits, "upper_um");
  if (member == "lower_deviation_um") return if_so(row.has_drawn_limits, "lower_um");
  if (member == "feature") return if_so(row.has_feature, member);
  if (member == "nominal_mm" || member == "tolerance_class")
    return if_so(row.designation.empty(), member);
  return if_so(member != kDesignation && aqdef::place_of(member) < kMeasurementFields.size(),
               member);
}

Error at_table_line(ErrorCode code, std::size_t line, std::string_view what) {
  return {code, fmt::format("line {} {}", line, what), fmt::format("line {}", line)};
}

std::string_view bare(std::string_view text) {
  constexpr std::string_view kNoBreak = "\xC2\xA0";
  for (;;) {
    text = trim(text);
    if (text.starts_with(kNoBreak)) {
      text.remove_prefix(kNoBreak.size());
    } else if (text.ends_with(kNoBreak)) {
      text.remove_suffix(kNoBreak.size());
    } else {
      return text;
    }
  }
}

Result<std::string_view> RecordReader::peek_line() {
  for (;;) {
    const std::string_view ahead = std::string_view(room_).substr(at_);
    const std::size_t end = std::min(ahead.find_first_of("\r\n"), ahead.size());
    // An LF may follow a CR.
    if (is_at_end_ || end + 1 < ahead.size()) return ahead.substr(0, end);
    TRY(fill());
  }
}

Result<bool> RecordReader::next(Record& record) {
  for (;;) {
    rest_ = std::string_view(room_).substr(at_);
    if (rest_.empty() && is_at_end_) return false;
    record.line = line_;
    record.lines = 0;
    record.cells.clear();
    const auto read = read_record(record);
    // A row that reaches the end of the buffer may continue after it.
    if (!rest_.empty() || is_at_end_) {
      if (!read) return read.error();
      at_ = room_.size() - rest_.size();
      line_ += record.lines;
      return true;
    }
    TRY(fill());
  }
}

Result<void> RecordReader::fill() {
  room_.erase(0, at_);
  at_ = 0;
  if (room_.size() > kLongestRecord) {
    const bool is_table = separator_ != kNone;
    return at_table_line(
        ErrorCode::CsvMalformed, line_,
        fmt::format("{} more than {} KiB: is {}?", is_table ? "begins a row of" : "has",
                    kLongestRecord >> 10, is_table ? "a quote open" : "it NDJSON"));
  }
  const auto more = TRY(input_.append(room_));
  is_at_end_ = !more;
  return {};
}

Result<void> RecordReader::read_record(Record& record) {
  for (;;) {
    if (record.cells.size() == kMostCells) {
      return at_table_line(ErrorCode::CsvMalformed, line_,
                           fmt::format("has more than {} cells", kMostCells));
    }
    TRY(read_cell(record.cells.emplace_back(), record));
    if (rest_.empty() || rest_.front() != separator_) break;
    rest_.remove_prefix(1);
  }
  if (take_line_end()) ++record.lines;
  return {};
}

Result<void> RecordReader::read_cell(std::string& cell, Record& record) {
  const std::size_t blanks = std::min(rest_.find_first_not_of(' '), rest_.size());
  if (!rest_.substr(blanks).starts_with('"')) {
    const char stops[] = {separator_, '\r', '\n'};
    const std::size_t end =
        std::min(rest_.find_first_of(std::string_view(stops, sizeof stops)), rest_.size());
    cell = rest_.substr(0, end);
    rest_.remove_prefix(end);
    return {};
  }
  rest_.remove_prefix(blanks + 1);
  for (;;) {
    const std::size_t end = rest_.find('"');
    if (end == std::string_view::npos) {
      rest_ = {};
      return at_table_line(ErrorCode::CsvMalformed, record.line, "has a quote without its end");
    }
    for (const char c : rest_.substr(0, end)) record.lines += c == '\n' ? 1 : 0;
    cell += rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    if (!rest_.starts_with('"')) break;
    cell += '"';
    rest_.remove_prefix(1);
  }
  while (rest_.starts_with(' ')) rest_.remove_prefix(1);
  if (rest_.empty() || rest_.front() == separator_ || rest_.front() == '\r' ||
      rest_.front() == '\n') {
    return {};
  }
  return at_table_line(ErrorCode::CsvMalformed, record.line, "has text after a closing quote");
}

Result<void> NdjsonRows::append_as_given(std::string& out, std::string_view line) const {
  const auto record = parse_json(line);
  if (!record || !is_exported(*record)) {
    out += line;
    return {};
  }
  const auto row = TRY(read_exported(
      [&record](std::string_view member) { return record->text_of(member); }, limits_of_));
  char before = '{';
  const auto append = [&](std::string_view field, const api::RawValue& value) {
    out += std::exchange(before, ',');
    append_json_string(out, field);
    out += ':';
    if (value.kind == JsonValue::Kind::String) {
      append_json_string(out, value.text);
    } else {
      out += value.text;
    }
  };
  for (const auto& [member, value] : record->members) {
    const std::string_view field = field_of_export(member, row);
    if (!field.empty()) append(field, api::raw_value(value));
  }
  if (!row.designation.empty())
    append(kDesignation, {.kind = JsonValue::Kind::String, .text = row.designation});
  out += '}';
  return {};
}

bool is_ndjson(std::string_view file_name) {
  const std::string name = ascii_lower(file_name);
  return name.ends_with(".ndjson") || name.ends_with(".jsonl");
}

Result<bool> NdjsonRows::append(std::string& rows) {
  const auto line = TRY(lines_.peek_line());
  if (lines_.is_at_end()) return false;
  const std::size_t number = lines_.line();
  if (const auto given = append_as_given(rows, line); !given)
    return at_table_line(given.error().code, number, given.error().message);
  lines_.pass_line(line);
  if (lines_.line() > number) rows += '\n';
  return true;
}

}  // namespace fitgauge::sheet
