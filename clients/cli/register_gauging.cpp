#include "cli/registration.hpp"

#include "cli/gauge_command.hpp"
#include "cli/limits_commands.hpp"
#include "cli/measure_command.hpp"
#include "cli/record_commands.hpp"

namespace fitgauge::cli {
namespace {

using api::RowField;

void add_limits(CLI::App& app, Action& chosen) {
  const auto designation = std::make_shared<std::string>();
  add_command<std::string>(app, "limits", "Limits of size: fitgauge limits 25H7", chosen,
                           designation, run_limits)
      ->add_option("designation", *designation, "Size and tolerance class, such as 25H7")
      ->required();
  const auto query = std::make_shared<FitQuery>();
  CLI::App* fit =
      add_command(app, "fit", "Clearances and tolerance zones of a fit: fitgauge fit 25H7/g6",
                  chosen, query, run_fit);
  fit->add_option("fit", query->designation,
                  "Size, class of the hole and class of the shaft, such as 25H7/g6")
      ->required();
  fit->add_option("--hole", query->holes, "Filter of the stored holes, such as characteristic=bore")
      ->expected(1)
      ->take_all();
  fit->add_option("--shaft", query->shafts,
                  "Filter of the stored shafts, such as characteristic=pin")
      ->expected(1)
      ->take_all();
  fit->add_option("--subgroups", query->subgroups,
                  "use: by subgroup; ignore: single values (default: use)")
      ->check(CLI::IsMember({"use", "ignore"}));
}

void add_tools(CLI::App& app, Action& chosen) {
  const auto designation = std::make_shared<std::string>();
  add_command<std::string>(app, "limit-gauge", "GO and NO-GO sizes: fitgauge limit-gauge 25H7",
                           chosen, designation, run_limit_gauge)
      ->add_option("designation", *designation, "Size and tolerance class, such as 25H7")
      ->required();
  const auto search = std::make_shared<FitSearch>();
  CLI::App* fits = add_command(app, "fits", "Find fits with clearances between two bounds", chosen,
                               search, run_fits);
  fits->add_option("nominal", search->nominal_mm, "Nominal size in mm")->required();
  fits->add_option("--min-um", search->min_clearance_um,
                   "Smallest clearance in µm; negative for interference")
      ->required();
  fits->add_option("--max-um", search->max_clearance_um, "Greatest clearance in µm")->required();
  fits->add_option("--limit", search->limit, "Maximum number of fits (default: 20)")
      ->check(CLI::Range(1, 1000));
  const auto standard = std::make_shared<StandardQuery>();
  CLI::App* standards =
      add_command(app, "standards", "Tables of other standards, such as iso965-1 for threads",
                  chosen, standard, run_standards);
  standards->add_option("name", standard->name,
                        "Standard: iso2768-1, iso965-1, din6885-1 or iso492");
  standards->add_option("--size-mm", standard->size_mm, "Only the rows for this size in mm");
}

void add_gauge(CLI::App& app, Action& chosen) {
  const auto options = std::make_shared<GaugeOptions>();
  CLI::App* gauge = add_command(app, "gauge", "Judge a value: fitgauge gauge 25H7 25.013", chosen,
                                options, run_gauge);
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

void add_measure(CLI::App& app, Action& chosen) {
  const auto options = std::make_shared<MeasureOptions>();
  CLI::App* measure =
      add_command(app, "import", "Store the measurements of a CSV, NDJSON, DFQ or QIF file", chosen,
                  options, run_measure)
          ->alias("measure");
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
  measure->add_option("--encoding", options->encoding,
                      "Encoding: auto, utf-8, utf-16 or windows-1252 (default: auto)");
  measure->add_flag("--leave-out-others", options->leave_out_others,
                    "Ignore columns without a field");
  measure->add_flag("--again", options->again, "Store every row, even if it is stored already");
  measure->add_flag("--exit-verdict", options->exit_verdict,
                    "Exit with the code of the worst verdict");
}

void add_statistics(CLI::App& app, Action& chosen) {
  const auto options = std::make_shared<StatisticsOptions>();
  CLI::App* statistics =
      add_command(app, "statistics", "Compute statistics of the values in a file", chosen, options,
                  run_statistics);
  statistics
      ->add_option("figure", options->figure,
                   "Figure: summary, anova, capability, chart, type1, grr, pairing or uncertainty")
      ->required()
      ->check(CLI::IsMember(
          {"summary", "anova", "capability", "chart", "type1", "grr", "pairing", "uncertainty"}));
  statistics
      ->add_option("file", options->file,
                   "JSON file as in the HTTP API, or a text with one value on each line")
      ->required();
  statistics->add_option("--lower", options->lower, "Lower limit, for capability");
  statistics->add_option("--upper", options->upper, "Upper limit, for capability");
  statistics->add_option("--reference", options->reference, "Size of the master, for type1");
  statistics->add_option("--tolerance", options->tolerance,
                         "Tolerance of the characteristic, for type1");
}

}  // namespace

void add_gauging(CLI::App& app, Action& chosen) {
  add_limits(app, chosen);
  add_tools(app, chosen);
  add_gauge(app, chosen);
  add_measure(app, chosen);
  add_statistics(app, chosen);
}

}  // namespace fitgauge::cli
