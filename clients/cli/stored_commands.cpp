#include "cli/local_files.hpp"
#include "cli/nc_commands.hpp"

namespace fitgauge::cli {
namespace {

/// Documents that are stored under a name.
struct StoredKind {
  std::string_view command;  ///< `setups`
  std::string_view what;     ///< for its help: `a setup`
  std::string_view help;
  std::string_view path;    ///< of the list; each is below it
  std::string_view member;  ///< of the list's answer
};
constexpr std::array<StoredKind, 4> kStoredKinds = {{
    {"setups", "a setup", "Setups of runs: machine, tools and workpiece", "/v1/setups", "setups"},
    {"budgets", "an uncertainty budget", "Uncertainty budgets", "/v1/uncertainties",
     "uncertainties"},
    {"gauges", "a gauge in use", "Gauges in use: uncertainty and calibration", "/v1/gauges-in-use",
     "gauges"},
    {"studies", "a gauge study", "Gauge studies and their results", "/v1/studies", "studies"},
}};

Outcome<ExitCode> done(const Outcome<Answer>& answer) {
  return answer ? Outcome<ExitCode>(ExitCode::Good) : answer.error();
}

/// Prints the document of a GET unchanged, or `line` for each of its items.
template <class Line>
Outcome<ExitCode> list(const Context& context, const std::string& target, std::string_view items,
                       const Line& line) {
  return show(context, context.persist({.target = target}), [&](const JsonValue& document) {
    for (const JsonValue& item : document.member(items).items) context.print("{}\n", line(item));
    if (const std::string_view next = document.text_of("next"); !next.empty())
      context.note("more: --after {}", next);
  });
}

/// Writes the response of a GET to a file, or to standard output.
Outcome<ExitCode> fetch(const Context& context, const std::string& target,
                        const std::string& file) {
  const auto answer = TRY(context.persist({.target = target}));
  const auto written = write_file(file.empty() ? "-" : file, answer.body);
  return written ? Outcome<ExitCode>(ExitCode::Good) : written.error();
}

std::string document_target(const StoredKind& kind, const std::string& name) {
  return fmt::format("{}/{}", kind.path, percent_encoded(name));
}

std::string run_target(const std::string& id) { return "/v1/runs/" + percent_encoded(id); }

// `setups ls`, `setups put NAME FILE`, `setups get NAME [FILE]`, `setups rm NAME`: `-` is standard
// input or output.

Outcome<ExitCode> run_stored_put(const Context& context, const StoredKind& kind,
                                 const std::string& name, const std::string& file) {
  const auto text = TRY(read_file(file));
  return done(context.persist({.method = "PUT",
                               .target = document_target(kind, name),
                               .content_type = "application/json",
                               .body = text}));
}

Outcome<ExitCode> run_stored_rm(const Context& context, const StoredKind& kind,
                                const std::string& name) {
  return done(context.persist({.method = "DELETE", .target = document_target(kind, name)}));
}

struct RunsQuery {
  std::string status{};
  std::string program{};
  std::uint64_t limit = 100;
  std::string after{};
};

/// `runs ls`: the newest first.
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

/// `runs show ID`: screen, messages and files of one run.
Outcome<ExitCode> run_runs_show(const Context& context, const Words& words) {
  return show(context, context.persist({.target = run_target(words[0])}),
              [&](const JsonValue& run) {
                context.print("{}  {}  {}  {}\n", run.text_of("created_at"), run.text_of("program"),
                              run.text_of("status"), run.text_of("verdict"));
                for (const JsonValue& line : run.member("screen").items)
                  context.print("{}\n", line.text);
                print_messages(run);
                for (const JsonValue& file : run.member("files").items)
                  context.print("{:>9}  {}\n", file.text_of("size"), file.text_of("path"));
              });
}

/// `runs get ID NAME [FILE]`: a file the run has written.
Outcome<ExitCode> run_runs_get(const Context& context, const Words& words) {
  return fetch(context, run_target(words[0]) + "/files/" + percent_encoded(words[1]), words[2]);
}

/// `runs cancel ID`
Outcome<ExitCode> run_runs_cancel(const Context& context, const Words& words) {
  return done(context.send({.method = "DELETE", .target = run_target(words[0])}));
}

struct TableOptions {
  std::string feature;   ///< hole or shaft
  std::string format{};  ///< json, csv, tab
  std::string classes{};
  std::string revision{};
  std::string output = "-";
};

/// The path and query of a table in the form that is wanted.
Outcome<std::string> table_target(const TableOptions& options, const std::string& format) {
  const std::string table = "/v1/tables/" + percent_encoded(options.feature);
  if (format == "tab") {
    if (options.classes.empty() && options.revision.empty()) return table + ".tab";
    return Failure{ExitCode::Usage,
                   "--classes and --revision need --format csv or json: the table for the control "
                   "has every class"};
  }
  std::string target = table + "?format=" + format;
  if (!options.classes.empty()) target += "&classes=" + percent_encoded(options.classes);
  if (!options.revision.empty()) target += "&revision=" + percent_encoded(options.revision);
  return target;
}

/// `fitgauge tables export hole`
Outcome<ExitCode> run_tables_export(const Context& context, const TableOptions& options) {
  std::string format = options.format;
  if (format.empty()) format = context.json ? "json" : "csv";
  const auto target = TRY(table_target(options, format));
  const auto answer = TRY(context.send({.target = target}));
  const auto written = write_file(options.output, answer.body);
  return written ? Outcome<ExitCode>(ExitCode::Good) : written.error();
}

void add_kind(CLI::App& app, Action& chosen, const StoredKind& kind) {
  CLI::App* stored = app.add_subcommand(std::string(kind.command), std::string(kind.help));
  stored->require_subcommand(1);
  const Word name{"name", fmt::format("Name of {}", kind.what)};
  add_words(*stored, "ls", fmt::format("List the names of the {}", kind.command), chosen, {}, 0,
            [&kind](const Context& context, const Words&) {
              return list(context, std::string(kind.path), kind.member, [](const auto& each) {
                return fmt::format("{}  {}", each.text_of("modified_at"), each.text_of("name"));
              });
            });
  add_words(*stored, "put", fmt::format("Store {}: {} put m3 m3.json", kind.what, kind.command),
            chosen, {name, {"file", "JSON file; - is standard input"}}, 2,
            [&kind](const Context& context, const Words& words) {
              return run_stored_put(context, kind, words[0], words[1]);
            });
  add_words(*stored, "get", fmt::format("Print {}, or write it to a file", kind.what), chosen,
            {name, {"file", "File to write (default: standard output)"}}, 1,
            [&kind](const Context& context, const Words& words) {
              return fetch(context, document_target(kind, words[0]), words[1]);
            });
  add_words(*stored, "rm", fmt::format("Delete {}", kind.what), chosen, {name}, 1,
            [&kind](const Context& context, const Words& words) {
              return run_stored_rm(context, kind, words[0]);
            });
}

void add_tables(CLI::App& app, Action& chosen) {
  CLI::App* tables = app.add_subcommand("tables", "Tolerance tables and custom tolerance classes");
  tables->require_subcommand(1);
  const auto [out, options] = add_command(
      *tables, "export", "Write a tolerance table: tables export hole", chosen, run_tables_export);
  out->add_option("feature", options->feature, "Table: hole or shaft")
      ->required()
      ->check(CLI::IsMember({"hole", "shaft"}));
  out->add_option("--format", options->format,
                  "Format: csv, json, or tab for the control (default: csv)")
      ->check(CLI::IsMember({"csv", "json", "tab"}));
  out->add_option("--classes", options->classes, "Only these tolerance classes, such as H7,JS7");
  out->add_option("--revision", options->revision,
                  "Table revision to export (default: the current one)");
  out->add_option("--output,-o", options->output, "File to write (default: standard output)");
  const auto classes = [](const std::string& feature) {
    return StoredKind{
        "", "", "", feature == "hole" ? "/v1/tables/hole/classes" : "/v1/tables/shaft/classes", ""};
  };
  const auto of_feature = CLI::IsMember({"hole", "shaft"});
  const Word feature{"feature", "Table: hole or shaft"};
  const Word name{"name", "Name of the custom tolerance class"};
  add_words(*tables, "set", "Store a custom tolerance class: tables set hole PRESS press.json",
            chosen, {feature, name, {"file", "JSON file; - is standard input"}}, 3,
            [classes](const Context& context, const Words& words) {
              return run_stored_put(context, classes(words[0]), words[1], words[2]);
            })
      ->get_option("feature")
      ->check(of_feature);
  add_words(*tables, "reset", "Delete a custom tolerance class: the standard applies again", chosen,
            {feature, name}, 2,
            [classes](const Context& context, const Words& words) {
              return run_stored_rm(context, classes(words[0]), words[1]);
            })
      ->get_option("feature")
      ->check(of_feature);
}

}  // namespace

void add_runs(CLI::App& app, Action& chosen) {
  CLI::App* runs = app.add_subcommand("runs", "Runs of NC programs");
  runs->require_subcommand(1);
  const auto [list, query] =
      add_command(*runs, "ls", "List the runs, the newest first", chosen, run_runs_ls);
  list->add_option(
      "--status", query->status,
      "Status: queued, running, completed, stopped, failed, cancelled or limit_exceeded");
  list->add_option("--program", query->program, "Only runs of this program");
  list->add_option("--limit", query->limit, "Maximum number of runs (default: 100)")
      ->check(CLI::Range(1, 1000));
  list->add_option("--after", query->after, "Cursor that the previous page printed");
  const Word id{"id", "Id of the run"};
  add_words(*runs, "show", "Print screen, messages and files of a run", chosen, {id}, 1,
            run_runs_show);
  add_words(*runs, "get", "Print a file that a run wrote", chosen,
            {id, {"name", "Name of the file"}, {"file", "Local file (default: standard output)"}},
            2, run_runs_get);
  add_words(*runs, "cancel", "Cancel a queued or running run", chosen, {id}, 1, run_runs_cancel);
}

void add_stored(CLI::App& app, Action& chosen) {
  for (const StoredKind& kind : kStoredKinds) add_kind(app, chosen, kind);
  add_tables(app, chosen);
}

}  // namespace fitgauge::cli
