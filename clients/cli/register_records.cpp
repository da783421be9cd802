#include "cli/registration.hpp"

#include "cli/record_commands.hpp"

namespace fitgauge::cli {
namespace {

void add_filters(CLI::App& command, const std::shared_ptr<RecordQuery>& query) {
  for (std::size_t i = 0; i < kRecordFilters.size(); ++i) {
    const auto& [name, help] = kRecordFilters.at(i);
    command.add_option(
        option_name(name), query->filters.at(i),
        help.empty() ? fmt::format("Only measurements with this {}", name) : std::string(help));
  }
}

void add_figures(CLI::App& app, Action& chosen) {
  const std::string help = "use: by subgroup; ignore: single values (default: use)";
  const auto indices = std::make_shared<CapabilityQuery>();
  CLI::App* capability = add_command(app, "capability", "Capability of stored measurements", chosen,
                                     indices, run_capability);
  add_filters(*capability, indices);
  capability->add_option("--target-mm", indices->target_mm,
                         "Target of cpm (default: the middle of the limits)");
  capability->add_option("--confidence", indices->confidence,
                         "Confidence level of the intervals (default: 0.95)");
  capability->add_option("--subgroups", indices->subgroups, help)
      ->check(CLI::IsMember({"use", "ignore"}));

  const auto query = std::make_shared<ChartQuery>();
  CLI::App* chart =
      add_command(app, "chart", "Control chart of stored measurements", chosen, query, run_chart);
  add_filters(*chart, query);
  chart
      ->add_option("--kind", query->kind,
                   "Kind of chart (default: xbar_r with subgroups, else i_mr)")
      ->check(CLI::IsMember({"i_mr", "xbar_r", "xbar_s", "ewma", "cusum"}));
  chart->add_option("--rules", query->rules,
                    "Western Electric rules to check, such as 1,2,3,4 (default: none)");
  chart->add_option("--subgroups", query->subgroups, help)->check(CLI::IsMember({"use", "ignore"}));
}

void add_listed(CLI::App& app, Action& chosen) {
  auto query = std::make_shared<RecordQuery>();
  CLI::App* list = add_command(app, "list", "Print stored measurements", chosen, query, run_list);
  add_filters(*list, query);
  list->add_option("--limit", query->limit, "Maximum number of measurements (default: 100)")
      ->check(CLI::Range(1, 1000));
  list->add_option("--after", query->after, "Cursor that the previous page printed");

  query = std::make_shared<RecordQuery>();
  CLI::App* out =
      add_command(app, "export", "Write stored measurements to a file", chosen, query, run_export);
  add_filters(*out, query);
  out->add_option("--format", query->format,
                  "Format: csv, ndjson, dfq (Q-DAS), qif or xlsx (default: csv)")
      ->check(CLI::IsMember({"csv", "ndjson", "dfq", "qif", "xlsx"}));
  out->add_option("--time-zone", query->time_zone,
                  "Time zone of times in dfq and xlsx, such as Europe/Berlin (default: UTC)");
  out->add_option("--output,-o", query->output, "File to write (default: standard output)");

  query = std::make_shared<RecordQuery>();
  CLI::App* summary =
      add_command(app, "summary", "Count, mean and standard deviation of each group", chosen, query,
                  run_summary);
  add_filters(*summary, query);
  summary->add_option("--group-by", query->group_by,
                      "Field that forms the groups (default: characteristic)");

  const auto options = std::make_shared<CorrectOptions>();
  CLI::App* correct =
      add_command(app, "correct", "Correct a measurement: fitgauge correct m17 25.0131", chosen,
                  options, run_correct);
  correct->add_option("id", options->id, "Id of the measurement")->required();
  correct->add_option("measured", options->measured, "Correct value in mm")->required();
  correct->add_option("--reason", options->reason, "Reason for the correction")->required();

  const auto said = std::make_shared<NoteOptions>();
  CLI::App* note = add_command(app, "note", "Add a note to a measurement, or show its notes",
                               chosen, said, run_note);
  note->add_option("id", said->id, "Id of the measurement")->required();
  note->add_option("--cause", said->cause, "Cause of the value");
  CLI::Option* action = note->add_option("--action", said->measure, "Action that was taken");
  note->add_option("--measure", said->measure, "Another name of --action")->excludes(action);
  note->add_option("--text", said->text, "Free text");
  note->add_option("--operator", said->operator_name, "Author of the note");
}

void add_plans(CLI::App& app, Action& chosen) {
  CLI::App* plan = app.add_subcommand("plan", "Inspection plans");
  plan->require_subcommand(1);
  const auto options = std::make_shared<PlanOptions>();
  CLI::App* from =
      add_command(*plan, "from", "Read the sizes of a STEP drawing; --part stores them as a plan",
                  chosen, options, run_plan_from);
  from->add_option("file", options->file, "STEP file of AP242, AP203 or AP214")->required();
  from->add_option("--part", options->part, "Part number of the plan");
}

}  // namespace

void add_records(CLI::App& app, Action& chosen) {
  add_listed(app, chosen);
  add_figures(app, chosen);
  add_plans(app, chosen);
}

}  // namespace fitgauge::cli
