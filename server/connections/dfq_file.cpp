#include "connections/dfq_file.hpp"

#include <fmt/format.h>

#include <charconv>

#include "api/measurements/measurement_batch.hpp"
#include "aqdef/measurement_csv.hpp"
#include "base/text.hpp"
#include "qif/qif_csv.hpp"

namespace fitgauge::connections {
namespace {

aqdef::LimitsOfClass limits_by(const iso286::ToleranceTables& tables) {
  return [&tables](Length nominal, const std::string& name) -> Result<aqdef::SizeLimits> {
    const auto size = iso286::NominalSize::make(nominal);
    if (!size) return size.error();
    const auto limits = tables.limits_of_size(*size, name);
    if (!limits) return limits.error();
    return aqdef::SizeLimits{.upper = limits->upper_limit(), .lower = limits->lower_limit()};
  };
}

Result<void> append_all(aqdef::MeasurementCsv& csv, DfqText& text) {
  for (;;) {
    const auto more = csv.append(text.csv, text.lines);
    if (!more) return more.error();
    if (!*more) return {};
    if (text.lines.size() > api::kMostRows) {
      return Error{
          ErrorCode::BodyTooLarge,
          fmt::format("it has more than {} values: cut it into several files", api::kMostRows)};
    }
  }
}

}  // namespace

bool is_dfq(std::string_view file_name) {
  const std::string name = ascii_lower(file_name);
  return name.ends_with(".dfq") || name.ends_with(".dfx");
}

bool is_values_alone(std::string_view file_name) {
  return ascii_lower(file_name).ends_with(".dfx");
}

bool is_description(std::string_view file_name) { return ascii_lower(file_name).ends_with(".dfd"); }

Result<DfqText> read_dfq(const FolderInOptions& options, const iso286::ToleranceTables& tables,
                         std::string_view description, std::string_view values) {
  aqdef::MeasurementCsv csv(aqdef::read_text(description.empty() ? values : description),
                            {.encoding = options.csv.encoding,
                             .columns = options.csv.columns,
                             .constants = options.csv.constants,
                             .zone = options.csv.zone,
                             .length_unit = options.length_unit,
                             .leaves_out_others = options.csv.leaves_out_others,
                             .limits_of = limits_by(tables)});
  DfqText text{.csv = csv.header(), .lines = {}};
  // Room that is not written to takes no memory; a text that grows is there twice.
  text.csv.reserve(2 * values.size());
  if (const auto appended = append_all(csv, text); !appended) {
    Error error = appended.error();
    if (!description.empty()) error.message = "the DFD: " + error.message;
    return error;
  }
  if (!description.empty()) {
    csv.go_on_with(aqdef::read_text(values));
    if (const auto appended = append_all(csv, text); !appended) return appended.error();
  }
  if (const auto checked = csv.check(); !checked) return checked.error();
  return text;
}

Result<DfqText> read_qif_file(const FolderInOptions& options, const iso286::ToleranceTables& tables,
                              std::string_view text) {
  auto read = qif::read_qif(text, {.constants = options.csv.constants,
                                   .zone = options.csv.zone,
                                   .length_unit = options.length_unit,
                                   .leaves_out_others = options.csv.leaves_out_others,
                                   .limits_of = limits_by(tables),
                                   .most_rows = api::kMostRows});
  if (!read) return read.error();
  return DfqText{.csv = std::move(read->csv), .lines = std::move(read->lines)};
}

Error at_lines_of(const DfqText& text, Error error) {
  for (Error& field : error.details) {
    for (Error& place : field.details) {
      std::size_t line = 0;
      std::from_chars(place.where.data(), place.where.data() + place.where.size(), line);
      if (line >= 2 && line - 2 < text.lines.size()) {
        place.where = std::to_string(text.lines[line - 2]);
      }
    }
  }
  return error;
}

}  // namespace fitgauge::connections
