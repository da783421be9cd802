#include "cli/commands.hpp"

#include "cli/answers.hpp"
#include "cli/local_files.hpp"

namespace fitgauge::cli {

std::string record_target(std::string path, const RecordQuery& query,
                          std::initializer_list<std::pair<std::string_view, std::string>> others) {
  char separator = '?';
  const auto add = [&path, &separator](std::string_view name, const std::string& value) {
    if (value.empty()) return;
    path += separator;
    path.append(name).append("=").append(percent_encoded(value));
    separator = '&';
  };
  for (std::size_t i = 0; i < kRecordFilters.size(); ++i)
    add(kRecordFilters.at(i).name, query.filters.at(i));
  for (const auto& [name, value] : others) add(name, value);
  return path;
}

namespace {

/// `fitgauge list`: a page of records, one a line, and on standard error how to get the next.
Outcome<ExitCode> run_list(const Context& context, const RecordQuery& query) {
  const std::string target = record_target(
      "/v1/measurements", query, {{"limit", std::to_string(query.limit)}, {"after", query.after}});
  return show(context, context.send({.target = target}), [&](const JsonValue& page) {
    for (const JsonValue& record : page.member("measurements").items)
      context.print("{}", record_line(record, context.out));
    if (const std::string_view next = page.text_of("next"); !next.empty())
      context.note("more: --after {}", next);
  });
}

/// `fitgauge export`: writes every matching record as it arrives.
Outcome<ExitCode> run_export(const Context& context, const RecordQuery& query) {
  const std::string usual = context.json ? "ndjson" : "csv";
  const std::string& format = query.format.empty() ? usual : query.format;
  OutputFile output(query.output);
  const auto answer = context.client.stream(
      {.target = record_target("/v1/measurements", query,
                               {{"format", format}, {"time_zone", query.time_zone}})},
      [&output](std::string_view piece) { return output.write(piece); });
  TRY(expect_ok(answer, context.client.url()));
  TRY(output.finish());
  return ExitCode::Good;
}

/// `fitgauge summary`: count, verdicts, mean and scatter of each group.
Outcome<ExitCode> run_summary(const Context& context, const RecordQuery& query) {
  const std::string group_by = query.group_by.empty() ? "characteristic" : query.group_by;
  const std::string target =
      record_target("/v1/measurements/summary", query, {{"group_by", group_by}});
  return show(context, context.send({.target = target}), [&](const JsonValue& summary) {
    for (const JsonValue& group : summary.member("groups").items) {
      const JsonValue& verdicts = group.member("verdicts");
      const std::string_view value = group.text_of(group_by);
      const std::string_view scatter = group.text_of("standard_deviation_mm");
      const std::string_view unjudged = verdicts.text_of("unjudged");
      context.print("{}: {} values, {} good, {} rework, {} reject, {} indeterminate{}{}\n",
                    value.empty() ? "(none)" : value, group.text_of("count"),
                    verdicts.text_of("good"), verdicts.text_of("rework"),
                    verdicts.text_of("reject"), verdicts.text_of("indeterminate"),
                    unjudged.empty() ? "" : ", ",
                    unjudged.empty() ? "" : fmt::format("{} unjudged", unjudged));
      context.print("    mean {} mm, s {} mm, {} to {} mm\n", group.text_of("mean_mm"),
                    scatter.empty() ? "-" : scatter, group.text_of("min_mm"),
                    group.text_of("max_mm"));
    }
  });
}

struct CorrectOptions {
  std::string id;
  std::string measured;  ///< mm, with a point or a comma
  std::string reason;
};

/// `fitgauge correct m17 25.0131 --reason …`: a new record for a wrong one; exits with its verdict.
Outcome<ExitCode> run_correct(const Context& context, const CorrectOptions& options) {
  const auto measured = TRY(measured_text(options.measured));
  const std::string body =
      JsonObject().add("measured_mm", measured).add("reason", options.reason).text();
  const auto answer = TRY(
      context.post_once("/v1/measurements/" + percent_encoded(options.id) + "/corrections", body));
  return show_verdict(context, answer);
}

std::string note_line(const JsonValue& note) {
  std::string line = fmt::format("{}  {}", note.text_of("received_at"), note.text_of("cause"));
  for (const auto& [before, name] : {std::pair("-> ", "measure"), {"", "text"}, {"", "operator"}}) {
    const std::string_view text = note.text_of(name);
    if (!text.empty()) line += fmt::format("  {}{}", before, text);
  }
  return line;
}

struct NoteOptions {
  std::string id;
  std::string cause;
  std::string measure;
  std::string text;
  std::string operator_name;
};

/// `fitgauge note m17 --cause … --measure …`: adds a note, or without options prints the notes.
Outcome<ExitCode> run_note(const Context& context, const NoteOptions& options) {
  const std::string target = "/v1/measurements/" + percent_encoded(options.id) + "/notes";
  if (options.cause.empty() && options.measure.empty() && options.text.empty()) {
    if (!options.operator_name.empty()) {
      return Failure{ExitCode::Usage,
                     "a note must have a cause, an action or a text: add --cause, --action or "
                     "--text, or remove --operator to show the notes"};
    }
    return show(context, context.send({.target = target}), [&](const JsonValue& notes) {
      for (const JsonValue& note : notes.member("notes").items)
        context.print("{}\n", note_line(note));
    });
  }
  const std::string body = JsonObject()
                               .add_given("cause", options.cause)
                               .add_given("measure", options.measure)
                               .add_given("text", options.text)
                               .add_given("operator", options.operator_name)
                               .text();
  const auto answer = TRY(context.post_once(target, body));
  if (context.json) context.print_document(answer.body);
  return ExitCode::Good;
}

}  // namespace

void add_filters(CLI::App& command, RecordQuery& query) {
  for (std::size_t i = 0; i < kRecordFilters.size(); ++i) {
    const auto& [name, help] = kRecordFilters.at(i);
    command.add_option(
        option_name(name), query.filters.at(i),
        help.empty() ? fmt::format("Only measurements with this {}", name) : std::string(help));
  }
}

void add_records(CLI::App& app, Action& chosen) {
  const auto [list, listed] =
      add_command(app, "list", "Print stored measurements", chosen, run_list);
  add_filters(*list, *listed);
  list->add_option("--limit", listed->limit, "Maximum number of measurements (default: 100)")
      ->check(CLI::Range(1, 1000));
  list->add_option("--after", listed->after, "Cursor that the previous page printed");

  const auto [out, exported] =
      add_command(app, "export", "Write stored measurements to a file", chosen, run_export);
  add_filters(*out, *exported);
  out->add_option("--format", exported->format,
                  "Format: csv, ndjson, dfq (Q-DAS), qif or xlsx (default: csv)")
      ->check(CLI::IsMember({"csv", "ndjson", "dfq", "qif", "xlsx"}));
  out->add_option("--time-zone", exported->time_zone,
                  "Time zone of times in dfq and xlsx, such as Europe/Berlin (default: UTC)");
  out->add_option("--output,-o", exported->output, "File to write (default: standard output)");

  const auto [summary, summed] = add_command(
      app, "summary", "Count, mean and standard deviation of each group", chosen, run_summary);
  add_filters(*summary, *summed);
  summary->add_option("--group-by", summed->group_by,
                      "Field that forms the groups (default: characteristic)");

  const auto [correct, options] = add_command(
      app, "correct", "Correct a measurement: fitgauge correct m17 25.0131", chosen, run_correct);
  correct->add_option("id", options->id, "Id of the measurement")->required();
  correct->add_option("measured", options->measured, "Correct value in mm")->required();
  correct->add_option("--reason", options->reason, "Reason for the correction")->required();

  const auto [note, said] =
      add_command(app, "note", "Add a note to a measurement, or show its notes", chosen, run_note);
  note->add_option("id", said->id, "Id of the measurement")->required();
  note->add_option("--cause", said->cause, "Cause of the value");
  CLI::Option* action = note->add_option("--action", said->measure, "Action that was taken");
  note->add_option("--measure", said->measure, "Another name of --action")->excludes(action);
  note->add_option("--text", said->text, "Free text");
  note->add_option("--operator", said->operator_name, "Author of the note");
}

}  // namespace fitgauge::cli
