#include "cli/answers.hpp"

#include <fcntl.h>
#include <termios.h>

#include <cerrno>
#include <regex>

#include "base/folder.hpp"
#include "cli/commands.hpp"
#include "record/measurement_row_reader.hpp"

namespace fitgauge::cli {
namespace {

/// A serial port that sends lines of text: 8 bits, no parity, one stop bit. Owns the port.
class SerialPort {
 public:
  /// Opens the port and discards its old input. @errors LocalFile, Usage for an unknown baud rate.
  static Outcome<SerialPort> open(const std::string& path, unsigned baud);

  struct Line {
    std::string text;   ///< without its end mark; a long one is cut
    bool whole = true;  ///< false: too long, or it began before the port was listened to
  };
  /// Waits for the next line that is not empty. @errors LocalFile if the port is gone.
  Outcome<Line> next();

 private:
  SerialPort(std::string path, Descriptor port) : path_(std::move(path)), port_(std::move(port)) {}

  std::string path_;
  Descriptor port_;
  std::string received_;  ///< from the beginning of a line on
  bool overlong_ = false;
  std::chrono::steady_clock::time_point opened_ = std::chrono::steady_clock::now();
  bool first_ = true;
};

constexpr std::array<std::pair<unsigned, speed_t>, 8> kSpeeds{{{1200, B1200},
                                                               {2400, B2400},
                                                               {4800, B4800},
                                                               {9600, B9600},
                                                               {19200, B19200},
                                                               {38400, B38400},
                                                               {57600, B57600},
                                                               {115200, B115200}}};
constexpr std::size_t kLongestLine = 200;
/// A line that ends so soon after the port was opened may have lost its beginning.
constexpr std::chrono::milliseconds kCut{200};
constexpr std::string_view kLineEnds = "\r\n";

Failure failed(const std::string& path, std::string_view what) {
  return Failure::of(ExitCode::LocalFile, "{}: {}: {}", path, what,
                     std::system_category().message(errno));
}

Outcome<SerialPort> SerialPort::open(const std::string& path, unsigned baud) {
  const auto speed = std::ranges::find(kSpeeds, baud, &std::pair<unsigned, speed_t>::first);
  if (speed == kSpeeds.end()) {
    return Failure::of(
        ExitCode::Usage,
        "--baud must be one of: 1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200; got {}", baud);
  }
  // Without O_NONBLOCK an open waits for a carrier, which a gauge does not send.
  Descriptor port(::open(path.c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (!port.is_open()) return failed(path, "cannot be opened");
  const int descriptor = port.get();
  termios settings{};
  if (tcgetattr(descriptor, &settings) != 0) return failed(path, "is not a serial port");
  cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);
  settings.c_cc[VMIN] = 1;
  settings.c_cc[VTIME] = 0;
  cfsetispeed(&settings, speed->second);
  cfsetospeed(&settings, speed->second);
  if (tcsetattr(descriptor, TCSANOW, &settings) != 0 || tcflush(descriptor, TCIFLUSH) != 0 ||
      fcntl(descriptor, F_SETFL, O_RDONLY) != 0) {
    return failed(path, "cannot be set up");
  }
  return SerialPort(path, std::move(port));
}

Outcome<SerialPort::Line> SerialPort::next() {
  for (;;) {
    if (const auto end = received_.find_first_of(kLineEnds); end != std::string::npos) {
      Line line{.text = received_.substr(0, end), .whole = !std::exchange(overlong_, false)};
      received_.erase(0, end + 1);
      if (line.text.find_first_not_of(" \t") == std::string::npos && line.whole) continue;
      const bool cut =
          std::exchange(first_, false) && std::chrono::steady_clock::now() - opened_ < kCut;
      line.whole = line.whole && !cut;
      return line;
    }
    if (received_.size() > kLongestLine) {
      received_.resize(kLongestLine);
      overlong_ = true;
    }
    std::array<char, 256> bytes{};
    const ssize_t count = ::read(port_.get(), bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return failed(path_, "is gone");
    if (count == 0) return Failure{ExitCode::LocalFile, path_ + ": is gone"};
    received_.append(bytes.data(), static_cast<std::size_t>(count));
  }
}

using api::kRowFields;
using api::RowField;

/// Command line of `fitgauge gauge`, as typed; an empty text was not given.
struct GaugeOptions {
  std::string designation;  ///< or the nominal size, with limits of a drawing
  std::string measured{};   ///< mm, with a point or a comma; alternatively:
  std::string serial{};     ///< a port whose lines are values
  unsigned baud = 9600;
  std::string pattern{};  ///< of a line; its first group is the value
  bool record = false;
  std::array<std::string, api::RowField::Count> fields{};  ///< by RowField::Index, from Feature on
};

struct VerdictWord {
  std::string_view word;
  ExitCode exit_code;
  Colour colour;
};
constexpr std::array<VerdictWord, 5> kVerdicts{{
    {"good", ExitCode::Good, Colour::Green},
    {"rework", ExitCode::Rework, Colour::Yellow},
    {"reject", ExitCode::Reject, Colour::Red},
    {"indeterminate", ExitCode::Indeterminate, Colour::Blue},
    {"", ExitCode::Good, Colour::Cyan},  // of a value without limits
}};

Length length_of(const JsonValue& document, std::string_view member) {
  return parse_length_mm(document.text_of(member)).value();
}

/// `25 to 25.021 mm`; a drawing may have only one limit.
std::string limits_text(const JsonValue& document) {
  const std::string_view lower = document.text_of("lower_limit_mm");
  const std::string_view upper = document.text_of("upper_limit_mm");
  if (lower.empty() && upper.empty()) return "no limits";
  if (lower.empty()) return fmt::format("up to {} mm", upper);
  if (upper.empty()) return fmt::format("{} mm or more", lower);
  return fmt::format("{} to {} mm", lower, upper);
}

std::string distance_text(const JsonValue& document, std::string_view unit) {
  const bool corrected = !document.text_of("corrected_mm").empty();
  const Length measured = length_of(document, corrected ? "corrected_mm" : "measured_mm");
  const bool has_upper = !document.text_of("upper_limit_mm").empty();
  const bool has_lower = !document.text_of("lower_limit_mm").empty();
  if (!has_upper && !has_lower) return "not judged";
  const auto distance_to = [&](bool there, std::string_view name) {
    return there ? measured - length_of(document, name) : kLongest;
  };
  const Length to_upper = distance_to(has_upper, "upper_limit_mm");
  const Length to_lower = distance_to(has_lower, "lower_limit_mm");
  const auto size = [](Length length) { return length < Length() ? -length : length; };
  const bool upper = has_upper && (!has_lower || size(to_upper) <= size(to_lower));
  const Length distance = upper ? to_upper : to_lower;
  const std::string_view limit = upper ? "upper" : "lower";
  if (distance == Length()) return fmt::format("on the {} limit", limit);
  return fmt::format("{} {} {} the {} limit", format_um(size(distance)), unit,
                     distance > Length() ? "above" : "below", limit);
}

/// Result of the GO gauge, of a size whose envelope is required.
std::string_view envelope_text(const JsonValue& document) {
  const std::string_view result = document.text_of("envelope_result");
  return result.empty()         ? ""
         : result == "verified" ? "envelope verified: the GO gauge passes\n"
         : result == "failed"   ? "envelope failed: the GO gauge does not pass\n"
                                : "envelope not verified: no GO gauge was used\n";
}

std::string verdict_query(const GaugeOptions& options, const std::string& measured) {
  std::string query = "?measured_mm=" + percent_encoded(measured);
  // The others are of a record.
  for (std::size_t i = RowField::Uncertainty; i < RowField::Kept; ++i) {
    const std::string& value = options.fields.at(i);
    if (value.empty()) continue;
    query.append("&").append(kRowFields.at(i).name).append("=").append(percent_encoded(value));
  }
  return query;
}

std::string record_body(const GaugeOptions& options, const std::string& measured) {
  // A number without a class is the nominal size of a drawing.
  const bool by_drawing = parse_length_mm(options.designation, {.decimal_comma = true}).has_value();
  JsonObject body;
  body.add(kRowFields[by_drawing ? RowField::Nominal : RowField::Designation].name,
           options.designation);
  body.add(kRowFields[RowField::Measured].name, measured);
  for (std::size_t i = RowField::Feature; i < RowField::Count; ++i)
    body.add_given(kRowFields.at(i).name, options.fields.at(i));
  return body.text();
}

Outcome<ExitCode> judge(const Context& context, const GaugeOptions& options,
                        const std::string& measured) {
  const auto text = TRY(measured_text(measured));
  const auto answer =
      TRY(options.record
              ? context.post_once("/v1/measurements", record_body(options, text))
              : context.send({.target = "/v1/verdicts/" + percent_encoded(options.designation) +
                                        verdict_query(options, text)}));
  return show_verdict(context, answer);
}

/// Decimals in mm, also from Digimatic adapters (01A+0025.013).
constexpr const char* kLine = R"((?:\d\dA)?\s*([+-]?\d+(?:[.,]\d+)?)\s*(?:mm)?)";

Outcome<std::regex> pattern_of(const std::string& pattern) try {
  return std::regex(pattern.empty() ? kLine : pattern);
} catch (const std::regex_error& wrong) {
  return Failure::of(ExitCode::Usage, "--pattern must be a regular expression; got '{}': {}",
                     pattern, wrong.what());
}

std::optional<std::string> value_in(const std::string& line, const std::regex& pattern) {
  constexpr std::string_view kBlank = " \t";
  const auto begin = line.find_first_not_of(kBlank);
  if (begin == std::string::npos) return std::nullopt;
  const std::string text = line.substr(begin, line.find_last_not_of(kBlank) + 1 - begin);
  std::smatch found;
  if (!std::regex_match(text, found, pattern)) return std::nullopt;
  std::string value = found.size() > 1 && found[1].matched ? found[1].str() : text;
  // A gauge sends +0025.013 for 25.013.
  value.erase(0, value.starts_with('+') ? 1 : 0);
  return value;
}

/// Judges line by line, each value once; other lines are reported and not stored.
Outcome<ExitCode> follow_port(const Context& context, GaugeOptions options) {
  const auto pattern = TRY(pattern_of(options.pattern));
  auto port = TRY(SerialPort::open(options.serial, options.baud));
  context.note(options.serial + ": waiting for values");
  for (;;) {
    const auto line = TRY(port.next());
    const auto value = line.whole ? value_in(line.text, pattern) : std::nullopt;
    if (!value || !measured_text(*value)) {
      context.note("{}: '{}' is not a value{}", options.serial, line.text,
                   line.whole ? "" : ": it is incomplete");
      continue;
    }
    options.fields[RowField::MeasuredAt] = format_rfc3339(SystemClock().now());
    const auto judged = judge(context, options, *value);
    if (!judged) {
      return Failure{judged.error().exit_code,
                     fmt::format("{}; {} was not {}", judged.error().message, *value,
                                 options.record ? "stored" : "judged"),
                     judged.error().document};
    }
    std::fflush(stdout);
  }
}

/// `fitgauge gauge 25H7 25.013`: judges a value, and stores it with --record; the exit code is the
/// verdict. With --serial judges each line, until the port is gone or a value is not stored.
Outcome<ExitCode> run_gauge(const Context& context, const GaugeOptions& options) {
  const auto given = [&](std::size_t field) { return !options.fields.at(field).empty(); };
  if ((given(RowField::Upper) || given(RowField::Lower)) &&
      (!options.record || (!given(RowField::Feature) && !given(RowField::Quantity)))) {
    return Failure{ExitCode::Usage,
                   "--upper-um and --lower-um need --record, and --feature or --quantity"};
  }
  if (!options.serial.empty()) return follow_port(context, options);
  if (options.measured.empty()) {
    return Failure{ExitCode::Usage,
                   "give a measured value, or --serial PORT; see fitgauge gauge --help"};
  }
  return judge(context, options, options.measured);
}

}  // namespace

Outcome<ExitCode> verdict_exit_code(std::string_view word) {
  const auto found = std::ranges::find(kVerdicts, word, &VerdictWord::word);
  if (found != kVerdicts.end()) return found->exit_code;
  return Failure::of(ExitCode::NoAnswer,
                     "unknown verdict '{}' from the service: use a fitgauge of its version", word);
}

Colour verdict_colour(std::string_view word) {
  const auto found = std::ranges::find(kVerdicts, word, &VerdictWord::word);
  return found == kVerdicts.end() ? Colour::Cyan : found->colour;
}

std::string format_verdict(const JsonValue& document, const Terminal& terminal) {
  const std::string_view word = document.text_of("verdict");
  const bool explicit_limits = document.text_of("designation").empty();
  std::string text =
      terminal.painted(word.empty() ? "UNJUDGED" : ascii_upper(word), verdict_colour(word));
  text += fmt::format("  {} mm  {} ({}): {}\n", document.text_of("measured_mm"),
                      document.text_of(explicit_limits ? "nominal_mm" : "designation"),
                      limits_text(document), distance_text(document, terminal.micrometre()));
  if (const std::string_view corrected = document.text_of("corrected_mm"); !corrected.empty())
    text += fmt::format("{} mm at 20 degrees\n", corrected);
  text += envelope_text(document);
  if (const std::string_view id = document.text_of("id"); !id.empty())
    text += fmt::format("stored as {}\n", id);
  return text;
}

Outcome<std::string> measured_text(const std::string& typed) {
  const auto measured = parse_length_mm(typed, {.decimal_comma = true, .round_to_nearest = true});
  if (measured) return format_mm(*measured);
  return Failure::of(ExitCode::Usage, "the measured value must be in mm; got '{}': {}", typed,
                     measured.error().message);
}

Outcome<ExitCode> show_verdict(const Context& context, const Answer& answer) {
  const auto document = TRY(context.document_of(answer));
  if (context.json) {
    context.print_document(answer.body);
  } else {
    context.print("{}", format_verdict(document, context.out));
  }
  context.note_warnings(document);
  return verdict_exit_code(document.text_of("verdict"));
}

void add_gauge(CLI::App& app, Action& chosen) {
  const auto [gauge, options] =
      add_command(app, "gauge", "Judge a value: fitgauge gauge 25H7 25.013", chosen, run_gauge);
  gauge
      ->add_option("designation", options->designation,
                   "Size and tolerance class, or a nominal size")
      ->required();
  const auto measured = gauge->add_option("measured", options->measured, "Measured value in mm");
  const auto serial =
      gauge->add_option("--serial", options->serial, "Serial port that sends the values")
          ->excludes(measured);
  gauge
      ->add_option("--baud", options->baud,
                   "Speed of the port, 1200 to 115200 bit/s (default: 9600)")
      ->needs(serial);
  gauge
      ->add_option("--pattern", options->pattern,
                   "Regular expression of a line; its first group is the value")
      ->needs(serial);
  const auto record = gauge->add_flag("--record", options->record, "Store the measurement");
  for (std::size_t i = RowField::Feature; i < RowField::Count; ++i) {
    const RowField& field = api::kRowFields.at(i);
    const auto option = gauge->add_option(option_name(field.name), options->fields.at(i),
                                          std::string(field.meaning));
    const bool is_limit = i == RowField::Upper || i == RowField::Lower;  // run_gauge says more
    if (!is_limit && (i < RowField::Uncertainty || i >= RowField::Kept)) option->needs(record);
  }
  gauge->get_option("--feature")->check(CLI::IsMember({"hole", "shaft"}));
  gauge->get_option("--measured-at")->excludes(serial);
}

}  // namespace fitgauge::cli
