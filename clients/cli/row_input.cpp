#include "cli/row_input.hpp"

#include <fmt/format.h>

#include <limits>
#include <utility>
#include <variant>
#include <vector>

#include "aqdef/measurement_csv.hpp"
#include "base/length.hpp"
#include "base/text.hpp"
#include "cli/address.hpp"
#include "cli/input_file.hpp"
#include "cli/measure_table.hpp"
#include "cli/problem.hpp"
#include "qif/qif_csv.hpp"

namespace fitgauge::cli {
namespace {

/// The tables are the service's.
aqdef::LimitsOfClass limits_by(const Context& context) {
  return [&context](Length nominal, const std::string& name) -> Result<aqdef::SizeLimits> {
    const std::string target =
        "/v1/limits/" + percent_encoded(fmt::format("{} {}", format_mm(nominal), name));
    const auto answer = expect_ok(context.client.send({.target = target}), context.client.url());
    if (!answer) return Error{ErrorCode::ClassUnknown, answer.error().message};
    const auto document = read_document(*answer, context.client.url());
    if (!document) return Error{ErrorCode::ClassUnknown, document.error().message};
    const auto upper = parse_length_mm(document->text_of("upper_limit_mm"));
    const auto lower = parse_length_mm(document->text_of("lower_limit_mm"));
    if (!upper) return upper.error();
    if (!lower) return lower.error();
    return aqdef::SizeLimits{.upper = *upper, .lower = *lower};
  };
}

bool is_dfq(const std::string& path) { return ascii_lower(path).ends_with(".dfq"); }

Failure cannot_read(const std::string& path, const Error& error) {
  return {ExitCode::LocalFile, fmt::format("{}: {}", path, error.message)};
}

/// A file from its begin.
Outcome<aqdef::Read> reading(const std::string& path) {
  auto opened = InputFile::open(path);
  if (!opened) return opened.error();
  const auto file = std::make_shared<InputFile>(*std::move(opened));
  return aqdef::Read([file](std::span<char> into) -> Result<std::size_t> {
    auto count = file->read(into);
    if (!count) return Error{ErrorCode::Internal, count.error().message};
    return *count;
  });
}

}  // namespace

struct RowInput::State {
  std::string name;
  std::variant<aqdef::MeasurementCsv, qif::QifRows> source;
  std::string rows{};  ///< of which `taken` bytes are read
  std::size_t taken = 0;
  std::vector<std::uint32_t> lines{};

  template <class Source>
  State(std::string file, Source from) : name(std::move(file)), source(std::move(from)) {
    rows = std::get<Source>(source).header();
  }
};

bool RowInput::is_one(const std::string& path) { return is_dfq(path) || qif::is_qif(path); }

Outcome<RowInput> RowInput::open(const Context& context, const MeasureOptions& options) {
  auto table = table_options(options);
  if (!table) return table.error();
  const auto read = reading(options.input);
  if (!read) return read.error();
  const auto unit = aqdef::length_unit(options.length_unit);
  if (is_dfq(options.input)) {
    return RowInput(std::make_shared<State>(
        options.input, aqdef::MeasurementCsv(*read, {.encoding = table->encoding,
                                                     .columns = table->columns,
                                                     .constants = table->constants,
                                                     .zone = table->zone,
                                                     .length_unit = unit,
                                                     .leaves_out_others = table->leaves_out_others,
                                                     .limits_of = limits_by(context)})));
  }
  const auto again = reading(options.input);
  if (!again) return again.error();
  auto rows = qif::QifRows::open(*read, *again,
                                 {.constants = table->constants,
                                  .zone = table->zone,
                                  .length_unit = unit,
                                  .leaves_out_others = table->leaves_out_others,
                                  .limits_of = limits_by(context),
                                  .most_rows = std::numeric_limits<std::size_t>::max()});
  if (!rows) return cannot_read(options.input, rows.error());
  return RowInput(std::make_shared<State>(options.input, *std::move(rows)));
}

Outcome<bool> RowInput::fill() {
  State& state = *state_;
  state.rows.clear();
  state.lines.clear();
  state.taken = 0;
  return std::visit(
      [&state](auto& source) -> Outcome<bool> {
        const auto more = source.append(state.rows, state.lines);
        if (!more) return cannot_read(state.name, more.error());
        if (*more) return true;
        if (const auto checked = source.check(); !checked) {
          return cannot_read(state.name, checked.error());
        }
        return false;
      },
      state.source);
}

Outcome<std::size_t> RowInput::read(std::span<char> into) {
  State& state = *state_;
  while (state.taken == state.rows.size()) {
    const auto more = fill();
    if (!more) return more.error();
    if (!*more) return std::size_t{0};
  }
  const std::size_t count = state.rows.copy(into.data(), into.size(), state.taken);
  state.taken += count;
  return count;
}

std::uint64_t RowInput::line_of(const Context& context, const MeasureOptions& options,
                                std::uint64_t csv_line) {
  auto input = open(context, options);
  std::uint64_t before = 1;  // the header
  while (input) {
    const auto more = input->fill();
    if (!more || !*more) break;
    const auto& lines = input->state_->lines;
    if (csv_line <= before + lines.size()) {
      return csv_line > before ? lines[csv_line - before - 1] : lines.front();
    }
    before += lines.size();
  }
  return csv_line;
}

}  // namespace fitgauge::cli
