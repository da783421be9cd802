#include "cli/measure_command.hpp"

#include "cli/local_files.hpp"
#include "formats/imported_rows.hpp"

namespace fitgauge::cli {

struct RowInput::State {
  std::string name;
  ImportedRows source;
  std::string rows = source.header();  ///< of which `taken` bytes are read
  std::size_t taken = 0;
  std::vector<std::uint32_t> lines{};
};

namespace {

constexpr std::size_t kMostRemembered = 10'000;

/// The tables are the service's, which is asked once for each nominal size and class.
sheet::LimitsOfClass limits_by(const Context& context) {
  return [&context, known = std::map<std::string, sheet::SizeLimits>()](
             Length nominal, const std::string& name) mutable -> Result<sheet::SizeLimits> {
    const std::string target =
        "/v1/limits/" + percent_encoded(fmt::format("{} {}", format_mm(nominal), name));
    if (const auto found = known.find(target); found != known.end()) return found->second;
    const auto answer = context.persist({.target = target});
    if (!answer) return Error{ErrorCode::ClassUnknown, answer.error().message};
    const auto document = context.document_of(*answer);
    if (!document) return Error{ErrorCode::ClassUnknown, document.error().message};
    const auto upper = TRY(parse_length_mm(document->text_of("upper_limit_mm")));
    const auto lower = TRY(parse_length_mm(document->text_of("lower_limit_mm")));
    if (known.size() == kMostRemembered) known.clear();
    return known[target] = {.upper = upper, .lower = lower};
  };
}

Failure cannot_read(const std::string& path, const Error& error) {
  return Failure::of(ExitCode::LocalFile, "{}: {}", path, error.message);
}

Read reading(const std::shared_ptr<InputFile>& file) {
  return [file](std::span<char> into) -> Result<std::size_t> {
    auto count = file->read(into);
    if (!count) return Error{ErrorCode::Internal, count.error().message};
    return *count;
  };
}

/// Restarts from the begin.
Read reading_again(const std::shared_ptr<InputFile>& file) {
  return [file, read = reading(file),
          is_begun = false](std::span<char> into) mutable -> Result<std::size_t> {
    if (!std::exchange(is_begun, true)) {
      if (const auto rewound = file->rewind(); !rewound)
        return Error{ErrorCode::Internal, rewound.error().message};
    }
    return read(into);
  };
}

/// `name=text`. @errors Usage
Outcome<sheet::Words> read_words(std::string_view option, const std::vector<std::string>& texts) {
  sheet::Words words;
  for (const std::string& text : texts) {
    const std::size_t equals = text.rfind('=');
    if (equals == 0 || equals == std::string::npos)
      return Failure::of(ExitCode::Usage, "{} must be NAME=TEXT; got '{}'", option, text);
    words.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  }
  return words;
}

/// Settings of a file from the options. @errors Usage
Outcome<aqdef::MeasurementOptions> table_options(const Context& context,
                                                 const MeasureOptions& options) {
  aqdef::MeasurementOptions table;
  table.leaves_out_others = options.leave_out_others;
  table.length_unit = sheet::length_unit(options.length_unit);
  table.limits_of = limits_by(context);
  table.columns = TRY(read_words("--map", options.columns));
  table.constants = TRY(read_words("--set", options.constants));
  if (!options.encoding.empty()) {
    const auto encoding = sheet::encoding_from_word(options.encoding);
    if (!encoding) {
      return Failure{ExitCode::Usage,
                     "--encoding must be one of: auto, utf-8, utf-16, windows-1252"};
    }
    table.encoding = *encoding;
  }
  if (!options.time_zone.empty()) {
    auto zone = sheet::TimeZone::load(options.time_zone);
    if (!zone) return Failure{ExitCode::Usage, zone.error().message};
    table.zone = *std::move(zone);
  }
  return table;
}

}  // namespace

bool RowInput::is_one(const MeasureOptions& options) {
  return !keeps_lines(options) || sheet::is_ndjson(options.input) || is_converted(options);
}

bool RowInput::keeps_lines(const MeasureOptions& options) {
  return !aqdef::is_dfq(options.input) && !qif::is_qif(options.input);
}

Outcome<RowInput> RowInput::open(const Context& context, const MeasureOptions& options) {
  auto table = TRY(table_options(context, options));
  if (sheet::is_ndjson(options.input)) table.encoding = sheet::Encoding::Utf8;
  const bool is_detected =
      !aqdef::is_dfq(options.input) && table.encoding == sheet::Encoding::Detected;
  const bool is_read_twice = qif::is_qif(options.input) || is_detected;
  const auto file = std::make_shared<InputFile>(
      TRY(is_read_twice ? open_to_read_again(options.input) : InputFile::open(options.input)));
  const std::string name = options.input == "-" ? "standard input" : options.input;
  auto source = ImportedRows::open(options.input, reading(file),
                                   is_read_twice ? reading_again(file) : reading(file),
                                   {std::move(table), std::numeric_limits<std::size_t>::max()});
  if (!source) return cannot_read(name, source.error());
  return RowInput(std::make_shared<State>(State{.name = name, .source = *std::move(source)}));
}

Outcome<bool> RowInput::fill() {
  State& state = *state_;
  state.rows.clear();
  state.lines.clear();
  state.taken = 0;
  const auto more = state.source.append(state.rows, state.lines);
  if (!more) return cannot_read(state.name, more.error());
  if (*more) return true;
  if (const auto checked = state.source.check(); !checked)
    return cannot_read(state.name, checked.error());
  return false;
}

Outcome<std::size_t> RowInput::read(std::span<char> into) {
  State& state = *state_;
  while (state.taken == state.rows.size()) {
    const auto more = TRY(fill());
    if (!more) return std::size_t{0};
  }
  const std::size_t count = state.rows.copy(into.data(), into.size(), state.taken);
  state.taken += count;
  return count;
}

std::uint64_t RowInput::line_of(const Context& context, const MeasureOptions& options,
                                std::uint64_t csv_line) {
  if (keeps_lines(options)) return csv_line;
  auto input = open(context, options);
  std::uint64_t before = 1;  // the header
  while (input) {
    const auto more = input->fill();
    if (!more || !*more) break;
    const auto& lines = input->state_->lines;
    if (csv_line <= before + lines.size())
      return csv_line > before ? lines[csv_line - before - 1] : lines.front();
    before += lines.size();
  }
  return csv_line;
}

Outcome<bool> is_exported(const std::string& path) {
  constexpr std::size_t kLongestHeader = 4096;
  if (path == "-") return false;  // what is read of it is gone
  auto file = TRY(InputFile::open(path));
  if (!file.size()) return false;
  std::string head(kLongestHeader, '\0');
  head.resize(TRY(file.read(head)));
  std::string_view rest = std::string_view(head).substr(0, head.find_first_of("\r\n"));
  std::set<std::string_view> columns;
  const char separator = rest.find(';') == std::string_view::npos ? ',' : ';';
  while (!rest.empty()) columns.insert(take_field(rest, separator));
  return std::ranges::all_of(sheet::kOfExport,
                             [&](std::string_view name) { return columns.contains(name); });
}

bool is_converted(const MeasureOptions& options) {
  return !options.encoding.empty() || !options.columns.empty() || !options.constants.empty() ||
         !options.time_zone.empty() || options.leave_out_others;
}

}  // namespace fitgauge::cli
