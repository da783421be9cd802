#include "record/measurement_batch.hpp"

#include "base/csv.hpp"
#include "base/json/json_value.hpp"
#include "base/thread.hpp"
#include "record/measurement_row_reader.hpp"

namespace fitgauge::api {
namespace {

std::optional<Timestamp> parse_date(std::string_view text, std::string_view time_of_day) {
  if (const auto time = parse_rfc3339(text)) return *time;
  const auto time = parse_rfc3339(std::string(text).append(time_of_day));
  return time ? std::optional(*time) : std::nullopt;
}

/// A row that cannot be read is listed as a wrong field is: by its number, with its line if any.
Error at_row(Error error, std::size_t row, std::optional<std::size_t> line) {
  FieldErrors listed;
  listed.add(error.code, pointer_to("", row), error.message, line);
  error.details = listed.take()->details;
  return error;
}

/// @param line of the first row too many
Error too_many_rows(std::optional<std::size_t> line = {}) {
  return at_row(
      {ErrorCode::RequestInvalid,
       fmt::format("a request must have at most {} rows: send the rest in another request",
                   kMostRows)},
      kMostRows, line);
}

Error no_rows(std::string_view what) {
  return listed(
      ErrorCode::RequestInvalid,
      {{ErrorCode::RequestInvalid, fmt::format("{} must have at least one measurement", what)}});
}

/// The members of a parsed object as one row.
void read_row(const JsonValue& object, MeasurementRowReader& reader, MeasurementBatch& batch) {
  if (!object.is(JsonValue::Kind::Object)) {
    reader.report_row(ErrorCode::FieldType,
                      fmt::format("a measurement must be an object; got {}", name_of(object.kind)));
    return;
  }
  for (const auto& [name, value] : object.members) {
    RawValue raw = raw_value(value);
    if (value.is(JsonValue::Kind::String)) raw.text = batch.keep(raw.text);
    if (!reader.field(name, raw)) reader.report_unknown(name);
  }
  if (const app::Measurement* row = reader.end()) batch.rows.push_back(*row);
}

Result<void> finish(FieldErrors& errors) {
  if (auto error = errors.take()) return *std::move(error);
  return {};
}

/// Decodes any JSON, with every error in its place: for input that the fast reader does not accept.
Result<void> decode_json(std::string_view body, const BatchContext& context,
                         MeasurementBatch& batch) {
  FieldErrors errors;
  MeasurementRowReader reader(context, errors);
  batch.rows.clear();
  std::size_t row = 0;
  const auto parsed = parse_json(body, [&](const JsonValue& item) {
    if (row == kMostRows || context.stop.stop_requested()) return false;
    reader.begin(row++);
    read_row(item, reader, batch);
    if (!errors.empty()) batch.rows.clear();  // none is stored
    take_full(batch, context, errors);
    return true;
  });
  if (!parsed && row == kMostRows) return too_many_rows();
  if (!parsed) return parsed.error();
  batch.single = !parsed->is(JsonValue::Kind::Array);
  if (batch.single) {
    reader.begin(std::nullopt);
    read_row(*parsed, reader, batch);
  } else if (row == 0) {
    return no_rows("the array");
  }
  return finish(errors);
}

Result<void> decode_ndjson(std::string_view body, const BatchContext& context,
                           MeasurementBatch& batch) {
  FieldErrors errors;
  MeasurementRowReader reader(context, errors);
  std::size_t row = 0;
  std::size_t line = 0;
  for (std::string_view rest = body; !rest.empty() && !context.stop.stop_requested();) {
    std::string_view text = take_field(rest, '\n');
    ++line;
    if (text.ends_with('\r')) text.remove_suffix(1);
    if (text.find_first_not_of(" \t") == std::string_view::npos) continue;
    if (row == kMostRows) return too_many_rows(line);
    reader.begin(row, line);
    const FieldErrors::Mark mark = errors.mark();
    if (read_object_fast(text, reader, batch)) {
      ++row;
      take_full(batch, context, errors);
      continue;
    }
    errors.rollback(mark);
    auto parsed = parse_json(text);
    if (!parsed) {
      Error error = std::move(parsed).error();
      error.where = fmt::format("line {}", line);
      constexpr std::string_view kAlone = "at line 1";  // the text that was read is one line
      if (error.message.starts_with(kAlone)) {
        error.message.replace(0, kAlone.size(), error.where);
      } else {
        error.message.insert(0, error.where + ": ");
      }
      return at_row(std::move(error), row, line);
    }
    reader.begin(row++, line);
    read_row(*parsed, reader, batch);
    take_full(batch, context, errors);
  }
  if (row == 0) return no_rows("the file");
  return finish(errors);
}

/// The header names each field once; an unknown name is reported for every row.
Result<void> check_header(std::vector<std::string> header) {
  std::ranges::sort(header);
  const auto name = std::ranges::adjacent_find(header);
  if (name == header.end()) return {};
  return Error{ErrorCode::CsvMalformed, fmt::format("the header line names {} twice", *name),
               "line 1"};
}

Result<void> decode_csv(std::string_view body, const BatchContext& context,
                        MeasurementBatch& batch) {
  auto opened = TRY(CsvReader::open(body));
  const auto csv = std::make_shared<CsvReader>(std::move(opened));
  TRY(check_header(csv->header()));
  FieldErrors errors;
  MeasurementRowReader reader(context, errors);
  batch.texts = csv;
  const bool semicolon = csv->separator() == ';';
  for (const std::string& name : csv->header()) {
    if (MeasurementRowReader::knows(name)) continue;
    reader.begin(std::nullopt, 1);
    reader.report_unknown(name);
  }
  std::size_t row = 0;
  for (; !context.stop.stop_requested(); ++row) {
    const auto cells = csv->next();
    if (!cells) return at_row(cells.error(), row, csv->line());
    if (*cells == nullptr) break;
    if (row == kMostRows) return too_many_rows(csv->line());
    reader.begin(row, csv->line());
    for (std::size_t i = 0; i < (*cells)->size(); ++i) {
      const CsvCell& cell = (**cells)[i];
      // An empty cell is a field that is not given; unknown names were reported once.
      if (cell.text.empty() || !MeasurementRowReader::knows(csv->header()[i])) continue;
      reader.field(csv->header()[i], {.kind = RawValue::Kind::String,
                                      .text = sheet::without_formula_guard(cell.text),
                                      .decimal_comma = semicolon || cell.quoted});
    }
    if (const app::Measurement* m = reader.end()) batch.rows.push_back(*m);
    take_full(batch, context, errors);
  }
  if (row == 0) return no_rows("the file");
  return finish(errors);
}

Result<void> decode(std::string_view body, std::string_view media_type, const BatchContext& context,
                    MeasurementBatch& batch) {
  if (media_type == "text/csv") return decode_csv(body, context, batch);
  if (media_type == "application/x-ndjson") return decode_ndjson(body, context, batch);
  FieldErrors errors;
  if (context.is_exact) return decode_json(body, context, batch);
  if (read_body_fast(body, context, batch, errors)) return finish(errors);
  if (batch.has_too_many) return too_many_rows();
  batch.wants_whole = batch.is_begun;
  if (batch.wants_whole) return Error{ErrorCode::RequestInvalid, "the body must be read whole"};
  return decode_json(body, context, batch);
}

}  // namespace

const GaugePeriod* GaugeInUse::at(Timestamp time) const {
  if (deleted_at && *deleted_at <= time) return nullptr;
  const auto next = std::upper_bound(
      periods.begin() + 1, periods.end(), time,
      [](Timestamp wanted, const GaugePeriod& period) { return wanted < period.from; });
  return &*(next - 1);
}

std::optional<Timestamp> parse_from(std::string_view text) {
  return parse_date(text, "T00:00:00Z");
}
std::optional<Timestamp> parse_due(std::string_view text) {
  return parse_date(text, "T23:59:59.999999999Z");
}

std::optional<std::string> due_in_utc(std::string_view text) {
  if (const auto time = parse_rfc3339(text)) return format_rfc3339(*time);
  return parse_due(text) ? std::optional(std::string(text)) : std::nullopt;
}

void take_full(MeasurementBatch& batch, const BatchContext& context, const FieldErrors& errors) {
  if (!context.take || batch.rows.size() < kRowsAtATime || !errors.empty()) return;
  batch.is_begun = true;
  context.take(std::exchange(batch.rows, {}));
  batch.rows.reserve(kRowsAtATime);
}

Result<void> decode_measurements(std::string_view body, std::string_view media_type,
                                 const BatchContext& context, MeasurementBatch& batch) {
  auto decoded = decode(body, media_type, context, batch);
  if (context.stop.stop_requested()) return shutting_down();
  return decoded;
}

}  // namespace fitgauge::api
