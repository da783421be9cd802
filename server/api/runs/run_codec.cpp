#include "api/runs/run_codec.hpp"

#include "api/resources.hpp"
#include "base/json/body_forms.hpp"

namespace fitgauge::api {
namespace {

using interpreter::ParameterValue;
using interpreter::RunMessage;

/// Fifteen digits: every decimal of a program is printed as written, without the last bit of a sum
/// (25 + 21/1000 is 25.021).
constexpr int kDigits = 15;

struct Digits {
  std::string schema(Side) const { return schema::number(); }
  void write(JsonWriter& json, double value) const { json.significant(value, kDigits); }
  void write(JsonWriter& json, const machine::Vec3& values) const {
    json.begin_array();
    for (std::size_t axis = 0; axis < 3; ++axis) write(json, values[axis]);
    json.end_array();
  }
};
struct ThreeDigits : Digits {
  std::string schema(Side side) const { return schema::array(Digits::schema(side), 3, 3); }
};

constexpr Words kVerdict{gauging::Verdict::Indeterminate};
constexpr Words kState{app::RunState::Cancelled};

/// The form of parameters by name.
struct ParameterValues {
  std::string schema(Side) const { return schema::map(R"({"type":["number","string"]})"); }
  void write(JsonWriter& json, const std::vector<ParameterValue>& parameters) const {
    write_parameters(json, parameters);
  }
};

struct PresetAnswer {
  machine::Preset preset{};
};
void members(auto& v, const PresetAnswer& answer) {
  const machine::PresetFrame& frame = answer.preset.frame;
  v.member("number", answer.preset.number, "Row of the preset table");
  v.member("x_mm", frame.origin.x, Digits{});
  v.member("y_mm", frame.origin.y, Digits{});
  v.member("z_mm", frame.origin.z, Digits{});
  v.member("rotation_deg", frame.basic_rotation_deg, ThreeDigits{}, "SPA, SPB, SPC");
  v.member("offsets_deg", frame.rotary_offsets_deg, ThreeDigits{}, "A_OFFS, B_OFFS, C_OFFS");
}

struct FileAnswer {
  std::string path{};
  std::size_t size = 0;
};
void members(auto& v, const FileAnswer& file) {
  v.member("path", file.path);
  v.member("size", file.size, "Size in bytes");
}

struct TableAnswer {
  std::string path{};
  std::string_view source{};
};
void members(auto& v, const TableAnswer& table) {
  v.member("path", table.path);
  v.member("source", table.source, "live: from the tables in use; stored: a file");
}

struct RunHead {
  std::string id{};
  app::RunState state{};
  std::string program{};
};
void members(auto& v, const RunHead& head) {
  v.member("id", head.id, "Opaque id");
  v.member("status", head.state, kState, "The last five states are final");
  v.member("program", head.program, "Path on the control");
}

RunHead head_of(const app::RunReport& report) {
  return {report.id_text(), app::state_of(report.result.status), report.program};
}

/// A run, with its result if it is over; before with its output.
struct RunAnswer {
  RunHead head{};
  Timestamp created_at{};
  std::optional<Timestamp> finished_at{};
  std::uint64_t blocks = 0;
  std::vector<std::string> screen{};
  std::uint64_t seed = 0;
  const interpreter::RunResult* result = nullptr;
};
void members(auto& v, const RunAnswer& run) {
  static const interpreter::RunResult kNone;
  const bool is_over = run.result != nullptr;
  const interpreter::RunResult& result = is_over ? *run.result : kNone;
  std::vector<FileAnswer> files;
  for (const auto& file : result.files) files.push_back({file.path.text(), file.bytes.size()});
  std::vector<TableAnswer> tables;
  for (const auto& table : result.tables) tables.push_back({table.path.text(), word(table.source)});
  std::vector<PresetAnswer> presets;
  for (const auto& preset : result.presets) presets.push_back({preset});
  const std::vector<PresetAnswer>* const shown = is_over ? &presets : nullptr;
  members(v, run.head);
  v.member("created_at", run.created_at, Time{}, "Time in UTC");
  v.optional("finished_at", run.finished_at, Time{}, "Absent until the run ends");
  v.member("blocks_executed", run.blocks, "Number until now");
  v.member("verdict", result.verdict, kVerdict,
           "Verdict of the last measuring cycle; each cycle has its own in its records");
  v.member("parameters", result.parameters, ParameterValues{},
           "Every Q, QL, QR and QS defined at the end");
  v.member("screen", is_over ? result.screen : run.screen, "Every line printed, in order");
  v.member("files", files, "Written by the run");
  v.member("tables", tables, "Opened by the run");
  v.member("messages", result.messages, "Every status but completed has one");
  v.member("measurements", result.measurements, "One for each measuring cycle");
  v.optional("active_preset", is_over ? &result.active_preset : nullptr,
             "Active preset at the end");
  v.optional("presets", shown, "The preset table at the end");
  v.optional("machining_time_s", is_over ? &result.machining_time_s : nullptr, Digits{},
             "Time on a real machine");
  v.optional("setup_seed", is_over ? &run.seed : nullptr, "Seed that repeats the run");
}

std::string report_json(const app::RunReport& report) {
  return body_json(RunAnswer{.head = head_of(report),
                             .created_at = report.created_at,
                             .finished_at = report.finished_at,
                             .blocks = report.result.blocks_executed,
                             .seed = report.seed,
                             .result = &report.result});
}

/// Orders are stored as accepted, with their defaults.
std::uint64_t seed_of(const std::string& request) {
  const auto order = parse_json(request);
  const JsonValue* setup = order ? order->find("setup") : nullptr;
  const JsonValue* seed = setup != nullptr ? setup->find("seed") : nullptr;
  const auto value = seed ? read_number<std::uint64_t>(seed->text) : std::nullopt;
  return value.value_or(app::RunReport().seed);
}

struct FinishedAnswer {
  RunHead head{};
  Timestamp finished_at{};
  std::optional<gauging::Verdict> verdict{};
};
void members(auto& v, const FinishedAnswer& finished) {
  members(v, finished.head);
  v.member("finished_at", finished.finished_at, Time{}, "Time in UTC");
  v.member("verdict", finished.verdict, kVerdict);
}

std::string event_json(const app::RunReport& report) {
  return body_json(FinishedAnswer{head_of(report), report.finished_at, report.result.verdict});
}

struct ListedRun {
  RunHead head{};
  Timestamp created_at{};
  std::optional<Timestamp> finished_at{};
};
void members(auto& v, const ListedRun& run) {
  members(v, run.head);
  v.member("created_at", run.created_at, Time{}, "Time in UTC");
  v.member("finished_at", run.finished_at, Time{}, "null until it is over");
}

struct RunListAnswer {
  std::vector<ListedRun> runs{};
  std::optional<std::string> next{};
};
void members(auto& v, const RunListAnswer& list) {
  v.member("runs", list.runs, "The newest first");
  v.member("next", list.next, "Cursor for `after`; null on the last page");
}

struct DiagnosticsAnswer {
  std::vector<klartext::Diagnostic> diagnostics{};
};
void members(auto& v, const DiagnosticsAnswer& answer) {
  v.member("diagnostics", answer.diagnostics, List<klartext::Diagnostic>{{"Diagnostic"}},
           "Findings; empty if there are none");
}

/// It contains its setup, so no setup is requested by name.
Result<app::RunOrder> stored_order(const std::string& request, const app::ControlTables& tables) {
  auto body = TRY(parse_stored_json(request, "order of a run"));
  return decode_run_order(
      std::move(body),
      [](const std::string& name) -> Result<app::NamedDocument> {
        return Error{ErrorCode::SetupUnknown, "setup not found: " + name};
      },
      tables);
}

}  // namespace

void members(auto& v, const RunMessage& message) {
  const bool has_column = message.column != 0;
  v.member("kind", message.kind, Words{interpreter::MessageKind::Note},
           "A note names the effects that the simulation does not have");
  v.member("number", message.number, "Number of the control's message; 0 if it has none");
  v.member("text", message.text, "Text of the message");
  v.member("program", message.program, "Program that sent it");
  v.member("line", message.line, "Line, from 1");
  v.member("block", message.block, "Block number, as written");
  v.optional("column", has_column ? &message.column : nullptr, "Column of the wrong word, from 1");
  v.optional("source", has_column ? &message.source : nullptr,
             "Line of the program as written; present with `column`");
}

void members(auto& v, const probing::MeasuredValue& size) {
  const auto* limits = size.limits ? &*size.limits : nullptr;
  v.member("characteristic", size.characteristic, "Measured quantity: diameter, width");
  v.member("nominal_mm", size.nominal, Millimetres{});
  v.member("measured_mm", size.measured, Millimetres{});
  v.member("deviation_um", size.deviation(), Micrometres{}, "Measured minus nominal");
  v.optional("upper_limit_mm", limits != nullptr ? &limits->upper : nullptr, Millimetres{},
             "Limit, if the cycle has limits");
  v.optional("lower_limit_mm", limits != nullptr ? &limits->lower : nullptr, Millimetres{},
             "Limit, if the cycle has limits");
  v.optional("uncertainty_um", size.uncertainty, Micrometres{},
             "Standard uncertainty, if the setup states that of a touch: twice it is a guard band");
  v.member("verdict", size.verdict(), kVerdict);
}

void members(auto& v, const probing::Form& form) {
  v.member("assessable", form.assessable, "true if there are enough points to judge it");
  v.optional("reason", form.reason.empty() ? nullptr : &form.reason,
             "Reason if it is not assessable");
  v.optional("residual_mm", form.residual_mm, Digits{},
             "Root mean square of the points from the circle");
}

void members(auto& v, const klartext::DiagnosticNote& note) {
  v.member("message", note.message);
  v.optional("program", note.program.empty() ? nullptr : &note.program,
             "The file that it is in; absent: the file of the finding");
  v.member("line", note.range.begin.line, "Number, from 1");
  v.member("column", note.range.begin.column, "Number, from 1");
}

void members(auto& v, const interpreter::Measurement& measurement) {
  const probing::MeasuringRecord& record = measurement.record;
  v.member("cycle", record.cycle, "Number of the cycle");
  v.member("program", measurement.program);
  v.member("line", measurement.line);
  v.member("block", measurement.block);
  v.member("verdict", record.verdict, kVerdict, "null without limits");
  v.member("sizes", record.sizes);
  v.optional("form", record.form, "Form of a circular feature");
  v.optional("origins", measurement.origins.empty() ? nullptr : &measurement.origins,
             "Blocks that its parameters and its datum come from");
}

void members(auto& v, const klartext::Diagnostic& found) {
  v.member("severity", found.severity, OneOf<3>{"note", "warning", "error"},
           "An error refuses a run");
  v.member("code", id(found.code), "Stable code");
  v.member("message", found.message, "The fault and its remedy");
  v.member("program", found.program, "The file it is in");
  v.member("line", found.range.begin.line, "Number, from 1");
  v.member("column", found.range.begin.column, "Number, from 1");
  v.member("block", found.block, "The block number, if there is one");
  v.member("source", found.source, "The line as written");
  v.optional("notes", found.notes.empty() ? nullptr : &found.notes,
             "Other places of the same finding");
}

void write_parameters(JsonWriter& json, std::span<const ParameterValue> parameters) {
  json.begin_object();
  for (const ParameterValue& parameter : parameters) {
    json.key(interpreter::name(parameter.parameter));
    if (const auto* number = std::get_if<double>(&parameter.value)) {
      Digits{}.write(json, *number);
    } else {
      json.value(std::get<std::string>(parameter.value));
    }
  }
  json.end_object();
}

app::RunFormat run_format() {
  return {.report = report_json,
          .trace = trace_json(),
          .seed = seed_of,
          .order = stored_order,
          .event = event_json};
}

std::string unfinished_run_json(const app::ActiveRun& run) {
  const auto news = run.news(0);
  return body_json(RunAnswer{.head = {run.id_text(), news.state, std::string(run.program())},
                             .created_at = run.created_at(),
                             .blocks = news.blocks,
                             .screen = news.lines});
}

std::string unfinished_run_json(const app::StoredRun& run) {
  return body_json(
      RunAnswer{.head = {run.id_text(), run.status, run.program}, .created_at = run.created_at});
}

std::string run_page_json(const app::RunService::Page& page, std::string_view next) {
  RunListAnswer list;
  for (const app::StoredRun& run : page.runs)
    list.runs.push_back(
        {{run.id_text(), run.status, run.program}, run.created_at, run.finished_at});
  if (!next.empty()) list.next = next;
  return body_json(list);
}

void write_diagnostics(JsonWriter& json, const std::vector<klartext::Diagnostic>& diagnostics) {
  List<klartext::Diagnostic>{}.write(json, diagnostics);
}

std::string diagnostics_json(const std::vector<klartext::Diagnostic>& diagnostics) {
  return body_json(DiagnosticsAnswer{diagnostics});
}

void add_diagnostic_schemas(Schemas& schemas) {
  schemas.push_back(answer_schema<klartext::Diagnostic>("Diagnostic"));
  schemas.push_back(answer_schema<DiagnosticsAnswer>("Diagnostics"));
}

void add_run_schemas(Schemas& schemas) {
  schemas.push_back(run_order_schema());
  schemas.push_back(answer_schema<RunAnswer>("Run"));
  schemas.push_back(answer_schema<RunListAnswer>("RunList"));
  schemas.push_back({"RunParameters", ParameterValues{}.schema(Side::Answer)});
  schemas.push_back(answer_schema<FinishedAnswer>("RunFinished"));
  schemas.push_back(
      {"RunProgress", schema::object({{"status", schema::words({"queued", "running"}), ""},
                                      {"blocks_executed", schema::count(), "Number until now"}})});
  schemas.push_back(
      {"RunOutput", schema::object({{"line", schema::text(), "As printed on the screen"}})});
  schemas.push_back({"RunEvent", schema::one_of({schema::event("output", "RunOutput"),
                                                 schema::event("progress", "RunProgress"),
                                                 schema::event("end", "Run")})});
  add_trace_schema(schemas);
}

}  // namespace fitgauge::api
