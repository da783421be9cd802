#include "cli/measure_dfq.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "aqdef/measurement_csv.hpp"
#include "base/length.hpp"
#include "base/text.hpp"
#include "cli/address.hpp"
#include "cli/input_file.hpp"
#include "cli/measure_table.hpp"
#include "cli/problem.hpp"

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

}  // namespace

struct DfqInput::State {
  std::string name;
  aqdef::MeasurementCsv csv;
  std::string rows{};  ///< of which `taken` bytes are read
  std::size_t taken = 0;
  std::vector<std::uint32_t> lines{};
};

bool is_dfq(const std::string& path) { return ascii_lower(path).ends_with(".dfq"); }

Outcome<qif::QifText> read_qif_input(const Context& context, const MeasureOptions& options) {
  auto table = table_options(options);
  if (!table) return table.error();
  const auto text = read_file(options.input);
  if (!text) return text.error();
  auto read = qif::read_qif(*text, {.constants = table->constants,
                                    .zone = table->zone,
                                    .length_unit = aqdef::length_unit(options.length_unit),
                                    .leaves_out_others = table->leaves_out_others,
                                    .limits_of = limits_by(context)});
  if (read) return *std::move(read);
  return Failure{ExitCode::LocalFile, fmt::format("{}: {}", options.input, read.error().message)};
}

Outcome<DfqInput> DfqInput::open(const Context& context, const MeasureOptions& options) {
  auto table = table_options(options);
  if (!table) return table.error();
  auto opened = InputFile::open(options.input);
  if (!opened) return opened.error();
  const auto file = std::make_shared<InputFile>(*std::move(opened));
  const auto read = [file](std::span<char> into) -> Result<std::size_t> {
    auto count = file->read(into);
    if (!count) return Error{ErrorCode::Internal, count.error().message};
    return *count;
  };
  DfqInput input(std::make_shared<State>(State{
      .name = options.input,
      .csv = aqdef::MeasurementCsv(read, {.encoding = table->encoding,
                                          .columns = table->columns,
                                          .constants = table->constants,
                                          .zone = table->zone,
                                          .length_unit = aqdef::length_unit(options.length_unit),
                                          .leaves_out_others = table->leaves_out_others,
                                          .limits_of = limits_by(context)})}));
  input.state_->rows = input.state_->csv.header();
  return input;
}

Outcome<bool> DfqInput::fill() {
  State& state = *state_;
  state.rows.clear();
  state.lines.clear();
  state.taken = 0;
  const auto more = state.csv.append(state.rows, state.lines);
  if (more && *more) return true;
  const auto checked = more ? state.csv.check() : Result<void>(more.error());
  if (!checked) {
    return Failure{ExitCode::LocalFile, fmt::format("{}: {}", state.name, checked.error().message)};
  }
  return false;
}

Outcome<std::size_t> DfqInput::read(std::span<char> into) {
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

std::uint64_t DfqInput::line_of(const Context& context, const MeasureOptions& options,
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
