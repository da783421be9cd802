#include "api/runs/run_codec.hpp"

#include <fmt/format.h>

#include <charconv>

#include "api/runs/run_order_codec.hpp"
#include "api/runs/trace_codec.hpp"
#include "record/measurement.hpp"

namespace fitgauge::api {
namespace {

using interpreter::ParameterValue;
using interpreter::RunMessage;

/// Fifteen digits: every decimal a program can write comes back as it was, and not with the last
/// bit of a sum (25 + 21/1000 is 25.021).
constexpr int kDigits = 15;

void write_double(JsonWriter& json, double value) { json.significant(value, kDigits); }

void write_optional(JsonWriter& json, std::string_view name,
                    const std::optional<std::uint32_t>& n) {
  json.key(name);
  if (n) {
    json.value(*n);
  } else {
    json.null();
  }
}

void write_head(JsonWriter& json, std::string_view id, app::RunState state,
                std::string_view program) {
  json.begin_object().member("id", id).member("status", word(state)).member("program", program);
}

void write_verdict(JsonWriter& json, const std::optional<gauging::Verdict>& verdict) {
  json.key("verdict");
  if (verdict) {
    json.value(word(*verdict));
  } else {
    json.null();
  }
}

void write_parameters(JsonWriter& json, const std::vector<ParameterValue>& parameters) {
  json.key("parameters").begin_object();
  for (const ParameterValue& parameter : parameters) {
    json.key(interpreter::name(parameter.parameter));
    if (const auto* number = std::get_if<double>(&parameter.value)) {
      write_double(json, *number);
    } else {
      json.value(std::get<std::string>(parameter.value));
    }
  }
  json.end_object();
}

void write_lines(JsonWriter& json, std::string_view name, const std::vector<std::string>& lines) {
  json.key(name).begin_array();
  for (const std::string& line : lines) json.value(line);
  json.end_array();
}

void write_message(JsonWriter& json, const RunMessage& message) {
  json.begin_object()
      .member("kind", word(message.kind))
      .member("number", message.number)
      .member("text", message.text)
      .member("program", message.program)
      .member("line", message.line);
  write_optional(json, "block", message.block);
  if (message.column != 0) {
    json.member("column", message.column).member("source", message.source);
  }
  json.end_object();
}

void write_preset(JsonWriter& json, const machine::Preset& preset) {
  const machine::PresetFrame& frame = preset.frame;
  json.begin_object().member("number", preset.number);
  write_double(json.key("x_mm"), frame.origin.x);
  write_double(json.key("y_mm"), frame.origin.y);
  write_double(json.key("z_mm"), frame.origin.z);
  json.key("rotation_deg").begin_array();
  for (std::size_t axis = 0; axis < 3; ++axis) write_double(json, frame.basic_rotation_deg[axis]);
  json.end_array().key("offsets_deg").begin_array();
  for (std::size_t axis = 0; axis < 3; ++axis) write_double(json, frame.rotary_offsets_deg[axis]);
  json.end_array().end_object();
}

/// What the number of points of a circular feature lets one say about its form.
void write_form(JsonWriter& json, const std::optional<probing::Form>& form) {
  if (!form) return;
  json.key("form").begin_object().member("assessable", form->assessable);
  if (!form->reason.empty()) json.member("reason", form->reason);
  if (form->residual_mm) write_double(json.key("residual_mm"), *form->residual_mm);
  json.end_object();
}

void write_size(JsonWriter& json, const probing::MeasuredSize& size) {
  json.begin_object()
      .member("characteristic", size.characteristic)
      .member_mm("nominal_mm", size.nominal)
      .member_mm("measured_mm", size.measured)
      .member_um("deviation_um", size.measured - size.nominal);
  if (size.limits) {
    json.member_mm("upper_limit_mm", size.limits->upper)
        .member_mm("lower_limit_mm", size.limits->lower);
  }
  write_verdict(json, size.verdict);
  json.end_object();
}

void write_measurement(JsonWriter& json, const interpreter::Measurement& measurement) {
  json.begin_object()
      .member("cycle", std::uint32_t{measurement.record.cycle})
      .member("program", measurement.program)
      .member("line", measurement.line);
  write_optional(json, "block", measurement.block);
  write_verdict(json, measurement.record.verdict);
  json.key("sizes").begin_array();
  for (const probing::MeasuredSize& size : measurement.record.sizes) write_size(json, size);
  json.end_array();
  write_form(json, measurement.record.form);
  json.end_object();
}

std::string report_json(const app::RunReport& report) {
  const interpreter::RunResult& result = report.result;
  std::string out;
  JsonWriter json(out);
  write_head(json, report.id_text(), app::state_of(result.status), report.program);
  json.member("created_at", format_rfc3339(report.created_at))
      .member("finished_at", format_rfc3339(report.finished_at))
      .member("blocks_executed", result.blocks_executed);
  write_verdict(json, result.verdict);
  write_parameters(json, result.parameters);
  write_lines(json, "screen", result.screen);
  json.key("files").begin_array();
  for (const interpreter::WrittenFile& file : result.files) {
    json.begin_object()
        .member("path", file.path.text())
        .member("size", std::uint64_t{file.bytes.size()})
        .end_object();
  }
  json.end_array().key("tables").begin_array();
  for (const interpreter::OpenedTable& table : result.tables) {
    json.begin_object()
        .member("path", table.path.text())
        .member("source", word(table.source))
        .end_object();
  }
  json.end_array().key("messages").begin_array();
  for (const RunMessage& message : result.messages) write_message(json, message);
  json.end_array().key("measurements").begin_array();
  for (const interpreter::Measurement& measurement : result.measurements) {
    write_measurement(json, measurement);
  }
  json.end_array().member("active_preset", result.active_preset).key("presets").begin_array();
  for (const machine::Preset& preset : result.presets) write_preset(json, preset);
  json.end_array();
  write_double(json.key("machining_time_s"), result.machining_time_s);
  json.member("setup_seed", report.seed).end_object();
  return out;
}

/// An order is stored as it was accepted: what it leaves out has the default.
std::uint64_t seed_of(const std::string& request) {
  const auto order = parse_json(request);
  const JsonValue* setup = order ? order->find("setup") : nullptr;
  const JsonValue* seed = setup != nullptr ? setup->find("seed") : nullptr;
  std::uint64_t value = app::RunReport().seed;
  if (seed != nullptr) {
    std::from_chars(seed->text.data(), seed->text.data() + seed->text.size(), value);
  }
  return value;
}

std::string event_json(const app::RunReport& report) {
  std::string out;
  JsonWriter json(out);
  write_head(json, report.id_text(), app::state_of(report.result.status), report.program);
  json.member("finished_at", format_rfc3339(report.finished_at));
  write_verdict(json, report.result.verdict);
  json.end_object();
  return out;
}

/// The run object while there are no results.
std::string unfinished_json(std::string_view id, app::RunState state, std::string_view program,
                            Timestamp created_at, std::uint64_t blocks,
                            const std::vector<std::string>& screen) {
  std::string out;
  JsonWriter json(out);
  write_head(json, id, state, program);
  json.member("created_at", format_rfc3339(created_at))
      .member("blocks_executed", blocks)
      .key("verdict")
      .null()
      .key("parameters")
      .begin_object()
      .end_object();
  write_lines(json, "screen", screen);
  for (const std::string_view empty : {"files", "tables", "messages", "measurements"}) {
    json.key(empty).begin_array().end_array();
  }
  json.end_object();
  return out;
}

/// Its setup stands in it, so that no setup is asked for by its name.
Result<app::RunOrder> stored_order(const std::string& request, const app::ControlTables& tables) {
  auto body = parse_stored_json(request, "order of a run");
  if (!body) return body.error();
  return decode_run_order(
      *std::move(body),
      [](const std::string& name) -> Result<app::NamedDocument> {
        return Error{ErrorCode::SetupUnknown, "there is no setup " + name};
      },
      tables);
}

}  // namespace

app::RunFormat run_format() {
  return {.report = report_json,
          .trace = trace_json(),
          .seed = seed_of,
          .order = stored_order,
          .event = event_json};
}

std::string unfinished_run_json(const app::ActiveRun& run) {
  const auto news = run.news(0);
  return unfinished_json(run.id_text(), news.state, run.program(), run.created_at(), news.blocks,
                         news.lines);
}

std::string unfinished_run_json(const app::StoredRun& run) {
  return unfinished_json(run.id_text(), run.state, run.program, run.created_at, 0, {});
}

std::string run_cursor(std::int64_t id) { return fmt::format("r{}", id); }

std::string run_page_json(const app::RunService::Page& page) {
  std::string out;
  JsonWriter json(out);
  json.begin_object().key("runs").begin_array();
  for (const app::StoredRun& run : page.runs) {
    write_head(json, run.id_text(), run.state, run.program);
    json.member("created_at", format_rfc3339(run.created_at)).key("finished_at");
    if (run.finished_at) {
      json.value(format_rfc3339(*run.finished_at));
    } else {
      json.null();
    }
    json.end_object();
  }
  json.end_array().key("next");
  if (page.next) {
    json.value(run_cursor(*page.next));
  } else {
    json.null();
  }
  json.end_object();
  return out;
}

void write_diagnostics(JsonWriter& json, const std::vector<klartext::Diagnostic>& diagnostics) {
  json.begin_array();
  for (const klartext::Diagnostic& found : diagnostics) {
    json.begin_object()
        .member("severity", found.severity == klartext::Severity::Error ? "error" : "warning")
        .member("code", id(found.code))
        .member("message", found.message)
        .member("program", found.program)
        .member("line", found.range.begin.line)
        .member("column", found.range.begin.column);
    write_optional(json, "block", found.block);
    json.member("source", found.source);
    if (!found.notes.empty()) {
      json.key("notes").begin_array();
      for (const klartext::DiagnosticNote& note : found.notes) {
        json.begin_object()
            .member("message", note.message)
            .member("line", note.range.begin.line)
            .member("column", note.range.begin.column)
            .end_object();
      }
      json.end_array();
    }
    json.end_object();
  }
  json.end_array();
}

std::string diagnostics_json(const std::vector<klartext::Diagnostic>& diagnostics) {
  std::string out;
  JsonWriter json(out);
  write_diagnostics(json.begin_object().key("diagnostics"), diagnostics);
  json.end_object();
  return out;
}

}  // namespace fitgauge::api
