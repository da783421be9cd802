#include "cli/nc_commands.hpp"

#include "cli/answers.hpp"
#include "cli/local_files.hpp"
#include "formats/measuring_log/measuring_log.hpp"

namespace fitgauge::cli {
namespace {

using log_reader::LogValue;
using log_reader::MeasuringLog;

struct ReplayOptions {
  RunOptions run{};
  std::string log{};       ///< of the control, as a file
  std::string contacts{};  ///< JSON: [[X, Y, Z], null, …]
};

/// The logs of each cycle, in the order they were written.
using ByCycle = std::map<int, std::vector<MeasuringLog>>;

void sort_in(std::vector<MeasuringLog> logs, ByCycle& into) {
  for (MeasuringLog& log : logs) into[log.cycle].push_back(std::move(log));
}

Outcome<ByCycle> read_log(const std::string& file) {
  const auto bytes = TRY(read_file(file));
  log_reader::Reading reading = log_reader::read_logs(bytes);
  if (!reading.unread.empty()) {
    const auto& [line, why] = reading.unread.front();
    return Failure::of(ExitCode::LocalFile, "{}:{}: {}", file, line, why);
  }
  if (reading.logs.empty())
    return Failure{ExitCode::LocalFile, file + ": contains no complete measuring log"};
  ByCycle logs;
  sort_in(std::move(reading.logs), logs);
  return logs;
}

/// Files that the run wrote. Files that are not a log of a cycle are ignored.
Outcome<ByCycle> written_logs(const Context& context, const JsonValue& run) {
  ByCycle logs;
  for (const JsonValue& file : run.member("files").items) {
    const std::string target =
        fmt::format("/v1/runs/{}/files/{}", percent_encoded(run.text_of("id")),
                    percent_encoded(file.text_of("path")));
    const auto answer = TRY(context.send({.target = target}));
    sort_in(log_reader::read_logs(answer.body).logs, logs);
  }
  return logs;
}

std::size_t decimals(std::string_view digits) {
  const std::size_t point = digits.find_first_of(".,");
  return point == std::string_view::npos ? 0 : digits.size() - point - 1;
}

double number(std::string digits) {
  std::replace(digits.begin(), digits.end(), ',', '.');
  double value = 0;
  const char* begin = digits.data() + (digits.starts_with('+') ? 1 : 0);
  std::from_chars(begin, digits.data() + digits.size(), value);
  return value;
}

/// Difference of two printed values; 0 if they agree to the last digit of both.
double difference(const LogValue& logged, const LogValue& replayed) {
  if (logged.printed == replayed.printed) return 0;
  const double apart = number(replayed.printed) - number(logged.printed);
  const auto least =
      static_cast<int>(std::min(decimals(logged.printed), decimals(replayed.printed)));
  return std::abs(apart) < 0.5 * std::pow(10.0, -least) ? 0 : apart;
}

/// Returns the value with that name; in a log of another language, the value at its place.
const LogValue* partner(const std::vector<LogValue>& values, const LogValue& wanted,
                        std::size_t place, std::size_t count) {
  for (const LogValue& value : values) {
    if (value.name == wanted.name) return &value;
  }
  return values.size() == count && values[place].is_length == wanted.is_length ? &values[place]
                                                                               : nullptr;
}

/// Prints the differences. @returns the number of different results.
class Comparison {
 public:
  explicit Comparison(const Context& context) : context_(context) {}

  void compare(const ByCycle& logged, const ByCycle& replayed);

  std::size_t results() const { return results_; }
  std::size_t differing() const { return rows_.size(); }
  std::string json() const {
    return JsonObject()
        .add("results", results_)
        .add_raw("differing", fmt::format("[{}]", fmt::join(rows_, ",")))
        .text();
  }

 private:
  void compare(const MeasuringLog& logged, const MeasuringLog* replayed, std::size_t call);

  const Context& context_;
  std::size_t results_ = 0;
  std::vector<std::string> rows_;
};

void Comparison::compare(const ByCycle& logged, const ByCycle& replayed) {
  for (const auto& [cycle, logs] : logged) {
    const auto found = replayed.find(cycle);
    for (std::size_t i = 0; i < logs.size(); ++i) {
      const bool is_there = found != replayed.end() && i < found->second.size();
      compare(logs[i], is_there ? &found->second[i] : nullptr, i + 1);
    }
  }
}

void Comparison::compare(const MeasuringLog& logged, const MeasuringLog* replayed,
                         std::size_t call) {
  for (std::size_t i = 0; i < logged.values.size(); ++i) {
    const LogValue& value = logged.values[i];
    ++results_;
    const LogValue* const other =
        replayed == nullptr ? nullptr : partner(replayed->values, value, i, logged.values.size());
    if (other != nullptr && difference(value, *other) == 0) continue;
    JsonObject row;
    row.add("cycle", logged.cycle)
        .add("call", call)
        .add("result", value.name)
        .add("log", value.printed)
        .add_given("replay", other == nullptr ? "" : other->printed);
    rows_.push_back(row.text());
    if (context_.json) continue;
    context_.print(
        "cycle {}, log {}: {}: {} in the log, {}\n", logged.cycle, call, value.name, value.printed,
        other == nullptr ? "nothing in the replay"
                         : fmt::format("{} in the replay, {:+.{}f}", other->printed,
                                       difference(value, *other), decimals(value.printed)));
  }
}

Outcome<JsonValue> run_on_contacts(const Context& context, const ReplayOptions& options) {
  const auto order = TRY(run_order(options.run));
  const auto contacts = TRY(read_file(options.contacts));
  if (!parse_document(contacts))
    return Failure{ExitCode::LocalFile, options.contacts + ": is not JSON: [[X, Y, Z], null, …]"};
  const std::string body =
      fmt::format("{},\"contacts_mm\":{}}}", order.substr(0, order.size() - 1), contacts);
  const auto answer = TRY(context.post_once("/v1/runs", body));
  return context.document_of(answer);
}

/// `replay PROGRAM LOG --contacts FILE`: runs the program on a machine whose probe finds the
/// contacts of the file, and compares the logs it writes with LOG, by the digits LOG prints.
/// Prints every result that differs. @errors LocalFile, Refused; ProgramFailed: the program did not
/// complete, or a result differs or is missing.
Outcome<ExitCode> run_replay(const Context& context, const ReplayOptions& options) {
  const auto logged = TRY(read_log(options.log));
  const auto run = TRY(run_on_contacts(context, options));
  print_messages(run);
  const auto replayed = TRY(written_logs(context, run));
  Comparison comparison(context);
  comparison.compare(logged, replayed);
  if (context.json) {
    context.print_document(comparison.json());
  } else {
    context.print("{} results, {} of them differ\n", comparison.results(), comparison.differing());
  }
  // An exceeded tolerance stops a program, as it did on the machine.
  const std::string_view status = run.text_of("status");
  if (status != "completed" && status != "stopped") {
    return Failure::of(ExitCode::ProgramFailed, "run {} ended with status {}", run.text_of("id"),
                       status);
  }
  return comparison.differing() == 0 ? ExitCode::Good : ExitCode::ProgramFailed;
}

}  // namespace

void add_replay(CLI::App& app, Action& chosen) {
  const auto [replay, options] = add_command(
      app, "replay", "Run a program with the contacts of a real run and compare the probing logs",
      chosen, run_replay);
  replay->add_option("program", options->run.program, "Path on the control")->required();
  replay->add_option("file", options->log, "Probing log of the machine")->required();
  replay
      ->add_option("--contacts", options->contacts,
                   "JSON file with a contact for each probing move: [[X, Y, Z], null, …]")
      ->required();
  const auto setup = replay->add_option("--setup", options->run.setup, "Name of a stored setup")
                         ->type_name("NAME");
  replay->add_option("--setup-file", options->run.setup_file, "JSON file with a setup")
      ->excludes(setup);
}

}  // namespace fitgauge::cli
