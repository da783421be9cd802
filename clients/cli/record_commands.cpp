#include "cli/record_commands.hpp"

#include "base/length.hpp"
#include "base/text.hpp"
#include "cli/address.hpp"
#include "cli/gauge_command.hpp"
#include "cli/http_client.hpp"
#include "cli/local_files.hpp"
#include "cli/problem.hpp"
#include "cli/watch_command.hpp"

namespace fitgauge::cli {
namespace {

Outcome<Answer> post_once(const Context& context, std::string target, std::string body) {
  return expect_ok(context.post_once(std::move(target), std::move(body)), context.client.url());
}

std::string note_line(const JsonValue& note) {
  std::string line = fmt::format("{}  {}", note.text_of("received_at"), note.text_of("cause"));
  for (const auto& [before, name] : {std::pair("-> ", "measure"), {"", "text"}, {"", "operator"}}) {
    const std::string_view text = note.text_of(name);
    if (!text.empty()) line += fmt::format("  {}{}", before, text);
  }
  return line;
}

}  // namespace

std::string record_target(std::string path, const RecordQuery& query,
                          std::initializer_list<std::pair<std::string_view, std::string>> others) {
  char separator = '?';
  const auto add = [&path, &separator](std::string_view name, const std::string& value) {
    if (value.empty()) return;
    path += separator;
    path.append(name).append("=").append(percent_encoded(value));
    separator = '&';
  };
  for (std::size_t i = 0; i < kRecordFilters.size(); ++i) {
    add(kRecordFilters.at(i).name, query.filters.at(i));
  }
  for (const auto& [name, value] : others) add(name, value);
  return path;
}

Outcome<JsonValue> get_document(const Context& context, const std::string& target) {
  const auto answer = TRY(expect_ok(context.client.send({.target = target}), context.client.url()));
  if (context.json) context.print_document(answer.body);
  return read_document(answer, context.client.url());
}

Outcome<ExitCode> run_list(const Context& context, const RecordQuery& query) {
  const auto page = TRY(get_document(
      context, record_target("/v1/measurements", query,
                             {{"limit", std::to_string(query.limit)}, {"after", query.after}})));
  if (context.json) return ExitCode::Good;
  for (const JsonValue& record : page.member("measurements").items)
    context.print("{}", record_line(record, context.out));
  if (const std::string_view next = page.text_of("next"); !next.empty())
    context.note(fmt::format("more: --after {}", next));
  return ExitCode::Good;
}

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

Outcome<ExitCode> run_summary(const Context& context, const RecordQuery& query) {
  const std::string group_by = query.group_by.empty() ? "characteristic" : query.group_by;
  const auto summary = TRY(get_document(
      context, record_target("/v1/measurements/summary", query, {{"group_by", group_by}})));
  if (context.json) return ExitCode::Good;
  for (const JsonValue& group : summary.member("groups").items) {
    const JsonValue& verdicts = group.member("verdicts");
    const std::string_view value = group.text_of(group_by);
    const std::string_view scatter = group.text_of("standard_deviation_mm");
    context.print("{}: {} values, {} good, {} rework, {} reject, {} indeterminate\n",
                  value.empty() ? "(none)" : value, group.text_of("count"),
                  verdicts.text_of("good"), verdicts.text_of("rework"), verdicts.text_of("reject"),
                  verdicts.text_of("indeterminate"));
    context.print("    mean {} mm, s {} mm, {} to {} mm\n", group.text_of("mean_mm"),
                  scatter.empty() ? "-" : scatter, group.text_of("min_mm"),
                  group.text_of("max_mm"));
  }
  return ExitCode::Good;
}

Outcome<ExitCode> run_correct(const Context& context, const CorrectOptions& options) {
  const auto measured = TRY(measured_text(options.measured));
  const std::string body =
      JsonObject().add("measured_mm", measured).add("reason", options.reason).text();
  const auto answer =
      post_once(context, "/v1/measurements/" + percent_encoded(options.id) + "/corrections", body);
  return answer ? show_verdict(context, *answer) : answer.error();
}

Outcome<ExitCode> run_note(const Context& context, const NoteOptions& options) {
  const std::string target = "/v1/measurements/" + percent_encoded(options.id) + "/notes";
  if (options.cause.empty() && options.measure.empty() && options.text.empty()) {
    const auto notes = TRY(get_document(context, target));
    if (context.json) return ExitCode::Good;
    for (const JsonValue& note : notes.member("notes").items)
      context.print("{}\n", note_line(note));
    return ExitCode::Good;
  }
  const std::string body = JsonObject()
                               .add_given("cause", options.cause)
                               .add_given("measure", options.measure)
                               .add_given("text", options.text)
                               .add_given("operator", options.operator_name)
                               .text();
  const auto answer = TRY(post_once(context, target, body));
  if (context.json) context.print_document(answer.body);
  return ExitCode::Good;
}

}  // namespace fitgauge::cli
