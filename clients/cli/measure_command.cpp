#include "cli/measure_command.hpp"

#include <future>

#include "cli/commands.hpp"
#include "cli/local_files.hpp"
#include "formats/sheet/shop_csv.hpp"

namespace fitgauge::cli {
namespace {

using Clock = std::chrono::steady_clock;

std::uint64_t number_of(std::string_view digits) {
  return read_number<std::uint64_t>(digits).value_or(0);
}

std::string summary(const VerdictCounts& counts) {
  std::string text =
      fmt::format("{} rows: {} good, {} rework, {} reject", grouped(counts.sum()),
                  grouped(counts.good), grouped(counts.rework), grouped(counts.reject));
  if (counts.indeterminate > 0)
    text += fmt::format(", {} indeterminate", grouped(counts.indeterminate));
  if (counts.unjudged > 0) text += fmt::format(", {} unjudged", grouped(counts.unjudged));
  return text;
}

/// Returns whether the service has read the rows and stores none of them.
bool rows_are_refused(const Answer& answer) {
  constexpr long kRefusals[] = {400, 413, 415, 422};
  return std::ranges::find(kRefusals, answer.status) != std::end(kRefusals);
}

/// Sends one input to the service.
class Upload {
 public:
  Upload(const Context& context, const MeasureOptions& options, MeasureJournal journal)
      : context_(context),
        options_(options),
        name_(options.input == "-" ? "standard input" : options.input),
        journal_(std::move(journal)) {}

  Outcome<ExitCode> run() {
    auto chunks = TRY(find_place());
    auto chunk = state_.pending ? pending_chunk(chunks) : chunks.next();
    while (chunk && *chunk) {
      // While the service stores these, the next rows of a file are read; a pipe may keep one
      // waiting.
      auto upcoming = std::async(reads_ahead_ ? std::launch::async : std::launch::deferred,
                                 [&chunks] { return chunks.next(); });
      TRY(send(chunks, **chunk));
      chunk = upcoming.get();
    }
    if (!chunk) return chunk.error();
    return finish();
  }

 private:
  Outcome<CsvChunks> open_input() {
    if (RowInput::is_one(options_)) return open_rows();
    const auto file = std::make_shared<InputFile>(TRY(InputFile::open(options_.input)));
    progress_.bytes_in_all = file->size();
    reads_ahead_ = progress_.bytes_in_all.has_value();
    return begin_chunks([file](std::span<char> into) { return file->read(into); });
  }

  /// Opens the rows as the service accepts them, for files of any size. Equal rows become equal
  /// text, even if the file grows.
  Outcome<CsvChunks> open_rows() {
    const bool is_ndjson = sheet::is_ndjson(options_.input);
    if (is_ndjson && is_converted(options_)) {
      return Failure{ExitCode::Usage,
                     "--map, --set, --encoding, --time-zone and --leave-out-others are for tables: "
                     "remove them for NDJSON"};
    }
    const auto input = std::make_shared<RowInput>(TRY(RowInput::open(context_, options_)));
    const auto read = [input](std::span<char> into) { return input->read(into); };
    if (!is_ndjson) return begin_chunks(read);
    CsvChunks chunks(read, {.rows = options_.chunk_rows});
    chunks.begin_with_rows();
    return chunks;
  }

  Outcome<CsvChunks> begin_chunks(CsvChunks::Read read) {
    CsvChunks chunks(std::move(read), {.rows = options_.chunk_rows});
    if (const auto header = chunks.read_header(); !header) {
      return Failure{header.error().exit_code,
                     fmt::format("{}: {}", name_, header.error().message)};
    }
    return chunks;
  }

  Outcome<CsvChunks> begin_session() {
    TRY(journal_.clear());
    auto chunks = open_input();
    if (chunks) {
      state_ = {.server = context_.client.url(),
                .session = new_idempotency_key(),
                .stored = chunks->position()};
    }
    return chunks;
  }

  /// The input at the end of an earlier run, or at its first row.
  Outcome<CsvChunks> find_place() {
    const auto& newest = journal_.state();
    if (options_.again || !newest) return begin_session();
    if (newest->server != context_.client.url()) return other_server(*newest);
    auto last = TRY(newest_kept(*newest));
    auto chunks = open_input();
    if (!chunks) return chunks;
    const auto match = TRY(chunks->skip_to(last.stored));
    if (match == CsvMatch::RowHasGrown) return row_has_grown(last.stored.lines);
    if (match == CsvMatch::Same) {
      state_ = std::move(last);
      state_.complete = false;
      return chunks;
    }
    const bool is_done_with = newest->complete || (!newest->pending && newest->counts.sum() == 0);
    if (!is_done_with || options_.input == "-") return changed(last.stored.lines);
    return begin_session();
  }

  /// The newest state whose measurements the service still has: a restored backup lacks those that
  /// were stored after it.
  Outcome<MeasureState> newest_kept(const MeasureState& newest) {
    if (TRY(is_kept(newest.last_id))) return newest;
    std::string lost = newest.last_id;
    auto states = TRY(journal_.states());
    for (; !states.empty(); states.pop_back()) {
      const MeasureState& state = states.back();
      if (state.last_id == lost) continue;
      if (TRY(is_kept(state.last_id))) break;
      lost = state.last_id;
    }
    if (states.empty()) return newest;
    context_.note(
        "{}: the service lacks {}: a backup was restored. The rows after line {} are sent "
        "again",
        name_, newest.last_id, states.back().stored.lines);
    return std::move(states.back());
  }

  /// Whether the service has a measurement, as far as this key may know.
  Outcome<bool> is_kept(const std::string& id) {
    if (id.empty()) return true;
    const auto answer = send_until_answered(
        context_.client, {.target = "/v1/measurements/" + percent_encoded(id)},
        Backoff(context_.retry_budget), [this](const Failure& f, auto wait) { notice(f, wait); });
    if (!answer) return answer.error();
    constexpr long kNotFound = 404;
    return answer->status != kNotFound;
  }

  Outcome<std::optional<CsvChunk>> pending_chunk(CsvChunks& chunks) {
    auto chunk = chunks.next_until(*state_.pending);
    if (chunk && !*chunk) return changed(state_.pending->lines);
    return chunk;
  }

  Failure other_server(const MeasureState& last) const {
    return Failure::of(ExitCode::LocalFile,
                       "{}: the state belongs to {}: give another file with "
                       "--state, or send all rows with --again",
                       journal_.path(), last.server);
  }

  Failure row_has_grown(std::uint64_t line) const {
    return Failure::of(ExitCode::LocalFile,
                       "{}: line {} was continued after it was stored: restore the line, correct "
                       "its measurement, and write new rows on new lines",
                       name_, line);
  }

  Failure changed(std::uint64_t lines) const {
    return Failure::of(ExitCode::LocalFile,
                       "{}: the lines up to {} have changed after they were "
                       "sent: restore them, or send all rows with --again",
                       name_, lines);
  }

  Outcome<void> send(const CsvChunks& chunks, const CsvChunk& chunk) {
    state_.pending = chunk.end;
    TRY(journal_.append(state_));
    const auto answer = send_until_answered(
        context_.client,
        {.method = "POST",
         .target = "/v1/measurements",
         .headers = {"Idempotency-Key: " + chunk_key(state_, chunk.end)},
         .content_type = sheet::is_ndjson(options_.input) ? "application/x-ndjson" : "text/csv",
         .body = chunk.body},
        Backoff(context_.retry_budget),
        [this](const Failure& failure, std::chrono::milliseconds wait) { notice(failure, wait); });
    if (!answer) return interrupted(answer.error());
    if (!answer->ok()) return refused(chunks, chunk, *answer);
    const auto document = TRY(context_.document_of(*answer));
    VerdictCounts counts;
    read_known(document.member("verdicts"), counts);
    state_.counts += counts;
    state_.stored = chunk.end;
    state_.last_id = document.text_of("last_id");
    state_.pending.reset();
    rows_sent_ += counts.sum();
    if (context_.json || document.find("warnings") != nullptr) line_.clear();
    if (context_.json) context_.print_document(answer->body);
    context_.note_warnings(document);
    show_progress();
    return {};
  }

  Failure interrupted(const Failure& failure) const {
    const std::string_view remedy =
        journal_.path().empty() ? "with --state you can resume it" : "run it again to resume";
    return {failure.exit_code,
            fmt::format("{}; {} rows are stored, up to line {}: {}", failure.message,
                        grouped(state_.counts.sum()), state_.stored.lines, remedy),
            failure.document};
  }

  Failure refused(const CsvChunks& chunks, const CsvChunk& chunk, const Answer& answer) {
    const Failure failure = failure_of(answer, context_.client.url());
    const auto problem = problem_of(answer);
    if (!problem || !rows_are_refused(answer)) return interrupted(failure);
    state_.pending.reset();
    TRY(journal_.append(state_));
    line_.clear();
    fmt::print(stderr, "{}", explain_rows(*problem, name_, [&](std::uint64_t body_line) {
                 return line_in_file(chunks.input_line(chunk, body_line));
               }));
    const bool explained = problem->fields.empty() && !problem->where.empty();
    return Failure{
        failure.exit_code,
        fmt::format("{}{}; lines {} to {} are not stored, and {} rows before them are: correct the "
                    "lines and run the command again{}",
                    problem->title, explained ? "" : ": " + problem->detail, first_line(chunk),
                    last_line(chunk), grouped(state_.counts.sum()),
                    may_be_table()
                        ? ", or use --encoding auto for a table of a gauge or a spreadsheet"
                        : "")};
  }

  /// Whether it was sent unchanged, and RowInput might accept it.
  bool may_be_table() const { return !RowInput::is_one(options_) && state_.counts.sum() == 0; }

  /// Returns the line of the file for a line of the text that is sent.
  std::uint64_t line_in_file(std::uint64_t line) const {
    return RowInput::line_of(context_, options_, line);
  }
  std::uint64_t first_line(const CsvChunk& chunk) const {
    return line_in_file(chunk.begin.lines + 1);
  }
  std::uint64_t last_line(const CsvChunk& chunk) const { return line_in_file(chunk.end.lines); }

  Outcome<ExitCode> finish() {
    state_.complete = true;
    TRY(journal_.append(state_));
    line_.clear();
    if (state_.counts.sum() == 0) {
      return Failure{
          ExitCode::LocalFile,
          name_ + (sheet::is_ndjson(options_.input) ? ": the input has no record"
                                                    : ": the input has no row after the header")};
    }
    if (rows_sent_ == 0)
      context_.note(name_ + ": every row was stored before; --again stores them once more");
    if (!context_.json) context_.print("{}\n", summary(state_.counts));
    return options_.exit_verdict ? worst_verdict(state_.counts) : ExitCode::Good;
  }

  void notice(const Failure& failure, std::chrono::milliseconds wait) {
    line_.clear();
    context_.note("{}; again in {:.1f} s", failure.message,
                  std::chrono::duration<double>(wait).count());
  }

  void show_progress() {
    progress_.name = name_;
    progress_.bytes = state_.stored.bytes;
    progress_.rows = rows_sent_;
    progress_.seconds = std::chrono::duration<double>(Clock::now() - began_).count();
    line_.show(progress_);
  }

  const Context& context_;
  const MeasureOptions& options_;
  const std::string name_;  // of the input
  MeasureJournal journal_;
  MeasureState state_;
  std::uint64_t rows_sent_ = 0;
  bool reads_ahead_ = false;  ///< a file, whose next rows can be read without a request
  Progress progress_;
  Clock::time_point began_ = Clock::now();
  ProgressLine line_{context_.err};
};

Outcome<MeasureJournal> open_journal(const Context& context, const MeasureOptions& options) {
  if (!options.state_file.empty()) return MeasureJournal::open(options.state_file);
  if (options.input == "-") return MeasureJournal::in_memory();
  const auto path = TRY(journal_path(options.input, context.client.url()));
  return MeasureJournal::open(path);
}

/// `fitgauge import`: stores the rows of a CSV in chunks, each with an idempotency key. The journal
/// has the stored rows and the last chunk before they are needed: a stopped run can continue at any
/// point and stores no row twice.
Outcome<ExitCode> run_measure(const Context& context, const MeasureOptions& given) {
  MeasureOptions options = given;
  if (!RowInput::is_one(options) && TRY(is_exported(options.input))) options.encoding = "auto";
  auto journal = TRY(open_journal(context, options));
  return Upload(context, options, std::move(journal)).run();
}

}  // namespace

std::string explain_rows(const Problem& problem, const std::string& input,
                         const std::function<std::uint64_t(std::uint64_t)>& line_of) {
  constexpr std::string_view kLine = "line ";
  std::string text;
  for (const FieldProblem& field : problem.fields) {
    const std::string name = field.pointer.substr(field.pointer.rfind('/') + 1);
    text +=
        fmt::format("{}:{}: {}: {}\n", input, line_of(field.line.value_or(1)), name, field.detail);
  }
  if (!problem.fields.empty() || !problem.where.starts_with(kLine)) return text;
  // A text that cannot be read: the detail begins with the line of the body.
  std::string_view detail = problem.detail;
  if (detail.starts_with(problem.where)) detail.remove_prefix(problem.where.size());
  detail.remove_prefix(std::min(detail.find_first_not_of(":, "), detail.size()));
  const std::uint64_t line = number_of(std::string_view(problem.where).substr(kLine.size()));
  return fmt::format("{}:{}: {}\n", input, line_of(line), detail);
}

ExitCode worst_verdict(const VerdictCounts& counts) {
  if (counts.reject > 0) return ExitCode::Reject;
  if (counts.rework > 0) return ExitCode::Rework;
  const bool is_judged = counts.good > 0 || counts.unjudged == 0;
  return counts.indeterminate > 0 || !is_judged ? ExitCode::Indeterminate : ExitCode::Good;
}

void add_import(CLI::App& app, Action& chosen) {
  const auto [measure, options] =
      add_command(app, "import", "Store the measurements of a CSV, NDJSON, DFQ or QIF file", chosen,
                  run_measure);
  measure->alias("measure");
  measure->add_option("file", options->input, "CSV, NDJSON, DFQ or QIF file; - is standard input")
      ->required();
  measure->add_option("--state", options->state_file,
                      "File that keeps the progress, to resume a stopped import");
  measure->add_option("--chunk", options->chunk_rows, "Rows in each request (default: 100000)")
      ->check(CLI::Range(1, 100'000));
  measure
      ->add_option("--map", options->columns,
                   "Column and its field, or date or time: Istwert=measured_mm; an empty field "
                   "ignores the column")
      ->allow_extra_args(false);
  measure->add_option("--set", options->constants, "Field and value for all rows: machine=M3")
      ->allow_extra_args(false);
  measure->add_option("--time-zone", options->time_zone,
                      "Time zone of times without an offset, such as Europe/Berlin");
  measure->add_option("--length-unit", options->length_unit,
                      "Unit of a DFQ file that names none: mm or inch");
  measure->add_option(
      "--encoding", options->encoding,
      "Encoding of a table of a gauge or a spreadsheet: auto, utf-8, utf-16 or windows-1252");
  measure->add_flag("--leave-out-others", options->leave_out_others,
                    "Ignore columns without a field");
  measure->add_flag("--again", options->again, "Store every row, even if it is stored already");
  measure->add_flag("--exit-verdict", options->exit_verdict,
                    "Exit with the code of the worst verdict");
}

}  // namespace fitgauge::cli
