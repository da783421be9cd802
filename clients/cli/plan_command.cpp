#include "cli/answers.hpp"
#include "cli/commands.hpp"
#include "formats/step/drawing.hpp"

namespace fitgauge::cli {
namespace {

struct PlanOptions {
  std::string file;
  std::string part{};  ///< the part whose plan it becomes; empty: it is printed
};

Failure local(const std::string& file, std::string_view why) {
  return Failure::of(ExitCode::LocalFile, "{}: {}", file, why);
}

std::string size_text(const step::DrawnSize& size) {
  std::string limits = size.tolerance_class.value_or("");
  for (const auto& each : {size.upper, size.lower}) {
    if (each) limits += (limits.empty() ? "" : " / ") + signed_text(format_um(*each));
  }
  return fmt::format("{:6} {:24} {:>10} {:18} {} {}{}", size.entity, size.name,
                     format_mm(size.nominal), limits, word(size.quantity),
                     size.feature ? word(*size.feature) : "",
                     size.count > 1 ? fmt::format(" {}X", size.count) : "");
}

void print(const Context& context, const step::Drawing& drawing) {
  if (context.json) return context.print_document(api::body_json(drawing));
  for (const step::DrawnSize& size : drawing.sizes) {
    context.print("{}\n", size_text(size));
    for (const std::string& remark : size.remarks) context.note("{}: {}", size.name, remark);
  }
  for (const step::NotRead& other : drawing.not_read)
    context.note("not read: {} {}: {}", other.entity, other.name, other.why);
}

/// Stores the plan, and prints the differences from the stored one.
Outcome<ExitCode> store(const Context& context, const step::Drawing& drawing,
                        const PlanOptions& options) {
  const std::string target = "/v1/plans/" + percent_encoded(options.part);
  const auto stored = context.client.send({.target = target});
  if (!stored) return stored.error();
  constexpr long kNotThere = 404;
  std::optional<JsonValue> before;
  if (stored->status != kNotThere) {
    const auto found = TRY(expect_ok(stored, context.client.url()));
    before = TRY(context.document_of(found));
  }
  const auto plan = step::plan_of(drawing, options.part, before ? &*before : nullptr);
  if (!plan) return local(options.file, plan.error().message);
  TRY(context.send(
      {.method = "PUT", .target = target, .content_type = "application/json", .body = plan->text}));
  for (const std::string& name : plan->compared.added) context.note("added: " + name);
  for (const std::string& name : plan->compared.gone) context.note("gone: " + name);
  for (const auto& one : plan->compared.changed)
    context.note("changed: {}: {}, in the plan {}", one.name, one.after, one.before);
  return ExitCode::Good;
}

/// `fitgauge plan from FILE`: reads a STEP file of any size without the service, and prints its
/// sizes and its other content, or with `--part` stores the plan. Classes are those of the
/// standard. @errors LocalFile for an unreadable file, with its line.
Outcome<ExitCode> run_plan_from(const Context& context, const PlanOptions& options) {
  const auto file = MappedFile::open(options.file);
  if (!file) return local(options.file, file.error().message);
  const auto tables = iso286::ToleranceTables::make(iso286::compiled_in_tables(), {});
  if (!tables) return Failure(ExitCode::Defect, tables.error().message);
  const auto drawing = step::read_drawing(file->text(), *tables);
  if (!drawing) return local(options.file, drawing.error().message);
  print(context, *drawing);
  return options.part.empty() ? ExitCode::Good : store(context, *drawing, options);
}

}  // namespace

void add_plans(CLI::App& app, Action& chosen) {
  CLI::App* plan = app.add_subcommand("plan", "Inspection plans");
  plan->require_subcommand(1);
  const auto [from, options] =
      add_command(*plan, "from", "Read the sizes of a STEP drawing; --part stores them as a plan",
                  chosen, run_plan_from);
  from->add_option("file", options->file, "STEP file of AP242, AP203 or AP214")->required();
  from->add_option("--part", options->part, "Part number of the plan");
}

}  // namespace fitgauge::cli
