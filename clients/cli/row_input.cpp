#include "cli/measure_command.hpp"

#include "cli/local_files.hpp"
#include "formats/qif/qif.hpp"

namespace fitgauge::cli {

struct RowInput::State {
  std::string name;
  std::variant<aqdef::MeasurementCsv, qif::QifRows, sheet::ShopRows, sheet::NdjsonRows> source;
  std::string rows{};  ///< of which `taken` bytes are read
  std::size_t taken = 0;
  std::vector<std::uint32_t> lines{};

  template <class Source>
  State(std::string file, Source from) : name(std::move(file)), source(std::move(from)) {
    if constexpr (requires { source_of<Source>().header(); }) rows = source_of<Source>().header();
  }

  template <class Source>
  Source& source_of() {
    return std::get<Source>(source);
  }
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

bool is_dfq(const std::string& path) { return ascii_lower(path).ends_with(".dfq"); }

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

template <class Rows>
Outcome<RowInput> opened(const std::string& name, Result<Rows> rows) {
  if (!rows) return cannot_read(name, rows.error());
  return RowInput(std::make_shared<RowInput::State>(name, *std::move(rows)));
}

Outcome<RowInput> open_dfq(const MeasureOptions& options, aqdef::MeasurementOptions table) {
  const auto file = std::make_shared<InputFile>(TRY(InputFile::open(options.input)));
  return opened<aqdef::MeasurementCsv>(options.input,
                                       aqdef::MeasurementCsv(reading(file), std::move(table)));
}

Outcome<RowInput> open_qif(const MeasureOptions& options, aqdef::MeasurementOptions table) {
  const auto file = std::make_shared<InputFile>(TRY(open_to_read_again(options.input)));
  return opened(options.input,
                qif::QifRows::open(reading(file), reading_again(file),
                                   {std::move(table), std::numeric_limits<std::size_t>::max()}));
}

Outcome<RowInput> open_ndjson(const MeasureOptions& options, sheet::LimitsOfClass limits_of) {
  const auto file = std::make_shared<InputFile>(TRY(InputFile::open(options.input)));
  return opened(options.input, sheet::NdjsonRows::open({}, reading(file), sheet::Encoding::Utf8,
                                                       std::move(limits_of)));
}

Outcome<RowInput> open_table(const MeasureOptions& options, sheet::ShopCsvOptions table) {
  const bool is_known = table.encoding != sheet::Encoding::Detected;
  const auto file = std::make_shared<InputFile>(
      TRY(is_known ? InputFile::open(options.input) : open_to_read_again(options.input)));
  return opened(options.input == "-" ? "standard input" : options.input,
                sheet::ShopRows::open(reading(file), is_known ? reading(file) : reading_again(file),
                                      std::move(table)));
}

}  // namespace

bool RowInput::is_one(const MeasureOptions& options) {
  return !keeps_lines(options) || sheet::is_ndjson(options.input) || is_converted(options);
}

bool RowInput::keeps_lines(const MeasureOptions& options) {
  return !is_dfq(options.input) && !qif::is_qif(options.input);
}

Outcome<RowInput> RowInput::open(const Context& context, const MeasureOptions& options) {
  auto table = TRY(table_options(context, options));
  if (qif::is_qif(options.input)) return open_qif(options, std::move(table));
  if (is_dfq(options.input)) return open_dfq(options, std::move(table));
  if (sheet::is_ndjson(options.input)) return open_ndjson(options, std::move(table.limits_of));
  return open_table(options, std::move(table));
}

Outcome<bool> RowInput::fill() {
  State& state = *state_;
  state.rows.clear();
  state.lines.clear();
  state.taken = 0;
  return std::visit(
      [&state](auto& source) -> Outcome<bool> {
        const auto more = sheet::append_next(source, state.rows, state.lines);
        if (!more) return cannot_read(state.name, more.error());
        if (*more) return true;
        if constexpr (requires { source.check(); }) {
          const auto checked = source.check();
          if (!checked) return cannot_read(state.name, checked.error());
        }
        return false;
      },
      state.source);
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
