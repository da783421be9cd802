#include "cli/stored_commands.hpp"

#include "cli/address.hpp"
#include "cli/http_client.hpp"
#include "cli/json_object.hpp"
#include "cli/local_files.hpp"
#include "cli/nc_commands.hpp"
#include "cli/problem.hpp"

namespace fitgauge::cli {
namespace {

Outcome<Answer> send_again(const Context& context, const Request& request) {
  return expect_ok(context.persist(request), context.client.url());
}

Outcome<ExitCode> done(const Outcome<Answer>& answer) {
  return answer ? Outcome<ExitCode>(ExitCode::Good) : answer.error();
}

/// Prints the document of a GET unchanged, or `line` for each of its items.
template <class Line>
Outcome<ExitCode> list(const Context& context, const std::string& target, std::string_view items,
                       const Line& line) {
  const auto answer = send_again(context, {.target = target});
  return show(context, answer, [&](const JsonValue& document) {
    for (const JsonValue& item : document.member(items).items) context.print("{}\n", line(item));
    if (const std::string_view next = document.text_of("next"); !next.empty()) {
      context.note(fmt::format("more: --after {}", next));
    }
  });
}

/// Writes the response of a GET to a file, or to standard output.
Outcome<ExitCode> fetch(const Context& context, const std::string& target,
                        const std::string& file) {
  const auto answer = TRY(send_again(context, {.target = target}));
  const auto written = write_file(file.empty() ? "-" : file, answer.body);
  return written ? Outcome<ExitCode>(ExitCode::Good) : written.error();
}

std::string document_target(const StoredKind& kind, const std::string& name) {
  return fmt::format("{}/{}", kind.path, percent_encoded(name));
}

std::string run_target(const std::string& id) { return "/v1/runs/" + percent_encoded(id); }

}  // namespace

Outcome<ExitCode> run_stored_ls(const Context& context, const StoredKind& kind) {
  return list(context, std::string(kind.path), kind.member, [](const JsonValue& stored) {
    return fmt::format("{}  {}", stored.text_of("modified_at"), stored.text_of("name"));
  });
}

Outcome<ExitCode> run_stored_put(const Context& context, const StoredKind& kind,
                                 const std::string& name, const std::string& file) {
  const auto text = TRY(read_file(file));
  return done(send_again(context, {.method = "PUT",
                                   .target = document_target(kind, name),
                                   .content_type = "application/json",
                                   .body = text}));
}

Outcome<ExitCode> run_stored_get(const Context& context, const StoredKind& kind,
                                 const std::string& name, const std::string& file) {
  return fetch(context, document_target(kind, name), file);
}

Outcome<ExitCode> run_stored_rm(const Context& context, const StoredKind& kind,
                                const std::string& name) {
  return done(send_again(context, {.method = "DELETE", .target = document_target(kind, name)}));
}

Outcome<ExitCode> run_runs_ls(const Context& context, const RunsQuery& query) {
  std::string target = "/v1/runs?limit=" + std::to_string(query.limit);
  if (!query.status.empty()) target += "&status=" + percent_encoded(query.status);
  if (!query.program.empty()) target += "&program=" + percent_encoded(control_path(query.program));
  if (!query.after.empty()) target += "&after=" + percent_encoded(query.after);
  return list(context, target, "runs", [](const JsonValue& run) {
    return fmt::format("{}  {:6}  {:14}  {}", run.text_of("created_at"), run.text_of("id"),
                       run.text_of("status"), run.text_of("program"));
  });
}

Outcome<ExitCode> run_runs_show(const Context& context, const std::string& id) {
  const auto answer = send_again(context, {.target = run_target(id)});
  return show(context, answer, [&](const JsonValue& run) {
    context.print("{}  {}  {}  {}\n", run.text_of("created_at"), run.text_of("program"),
                  run.text_of("status"), run.text_of("verdict"));
    for (const JsonValue& line : run.member("screen").items) context.print("{}\n", line.text);
    print_messages(run);
    for (const JsonValue& file : run.member("files").items) {
      context.print("{:>9}  {}\n", file.text_of("size"), file.text_of("path"));
    }
  });
}

Outcome<ExitCode> run_runs_get(const Context& context, const std::string& id,
                               const std::string& name, const std::string& file) {
  return fetch(context, run_target(id) + "/files/" + percent_encoded(name), file);
}

Outcome<ExitCode> run_runs_cancel(const Context& context, const std::string& id) {
  return done(expect_ok(context.client.send({.method = "DELETE", .target = run_target(id)}),
                        context.client.url()));
}

}  // namespace fitgauge::cli
