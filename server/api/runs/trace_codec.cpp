#include "api/runs/trace_codec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "api/wire/json_writer.hpp"
#include "base/json_value.hpp"
#include "base/text.hpp"

namespace fitgauge::api {
namespace {

using machine::Axis;

constexpr std::size_t kLinearAxes = 3;
constexpr std::string_view kHead = "{\"moves\":[\n";

/// What the arithmetic of a path adds beyond is noise.
constexpr int kDecimals = 10;

void write_position(JsonWriter& json, std::string_view which, const machine::Position& position,
                    const std::vector<Axis>& axes) {
  json.key(std::string(which) + "_mm").begin_object();
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (i == kLinearAxes) json.end_object().key(std::string(which) + "_deg").begin_object();
    json.key(name(axes[i])).fixed(position[axes[i]], kDecimals);
  }
  json.end_object();
}

void write_point(JsonWriter& json, std::string_view key, const machine::Vec3& point) {
  json.key(key).begin_object();
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
    json.key(name(axis)).fixed(point[index(axis)], kDecimals);
  }
  json.end_object();
}

void write_arc(JsonWriter& json, const machine::TracedArc& arc) {
  write_point(json, "center_mm", arc.centre);
  json.key("sweep_deg").fixed(arc.sweep_deg, kDecimals).member("axis", name(arc.axis));
  write_point(json, "machine_center_mm", arc.machine_centre);
  write_point(json, "machine_axis", arc.machine_axis);
}

void write_machine_contact(JsonWriter& json, const machine::TracedContact& contact) {
  write_point(json, "machine_contact_mm", contact.machine_surface);
  if (contact.normal) {
    write_point(json, "machine_contact_normal", *contact.normal);
  } else {
    json.key("machine_contact_normal").null();
  }
}

void write_move(JsonWriter& json, const machine::TracedMove& move, const app::RunTrace& trace) {
  const app::RunTrace::Place& place = trace.places[static_cast<std::size_t>(move.block)];
  json.begin_object().member("kind", name(move.kind)).key("block");
  if (place.block) {
    json.value(*place.block);
  } else {
    json.null();
  }
  json.member("line", place.line).member("program", place.program);
  write_position(json, "start", move.start, trace.axes);
  write_position(json, "end", move.end, trace.axes);
  json.key("feed_mm_min")
      .fixed(move.feed_mm_min, kDecimals)
      .key("seconds")
      .fixed(move.seconds, kDecimals);
  if (move.contact) {
    write_point(json, "contact_mm", move.contact->surface);
  } else {
    json.key("contact_mm").null();
  }
  json.key("cycle");
  if (place.cycle != 0) {
    json.value(static_cast<std::uint32_t>(place.cycle));
  } else {
    json.null();
  }
  write_point(json, "machine_start_mm", move.machine_start);
  write_point(json, "machine_end_mm", move.machine_end);
  if (move.arc) write_arc(json, *move.arc);
  if (move.contact) write_machine_contact(json, *move.contact);
  json.end_object();
}

/// Members that only some moves have, or that may be null, and whether they are points: each has
/// its columns in every CSV.
constexpr std::pair<std::string_view, bool> kOptional[] = {
    {"contact_mm", true},         {"center_mm", true},
    {"sweep_deg", false},         {"axis", false},
    {"machine_center_mm", true},  {"machine_axis", true},
    {"machine_contact_mm", true}, {"machine_contact_normal", true}};

/// A column of the CSV: a member of a move, or one axis of a position.
struct Column {
  std::string member;
  std::string axis{};

  std::string title() const {
    if (axis.empty()) return member;
    const std::size_t unit = member.rfind('_');
    return member.substr(0, unit + 1) + ascii_lower(axis) + member.substr(unit);
  }
};

std::vector<Column> columns_of(const JsonValue& move) {
  std::vector<Column> columns;
  for (const auto& [name, value] : move.members) {
    const std::string_view member = name;
    if (std::any_of(std::begin(kOptional), std::end(kOptional),
                    [&](const auto& optional) { return optional.first == member; })) {
      continue;
    }
    if (value.is(JsonValue::Kind::Object)) {
      for (const auto& [axis, coordinate] : value.members) columns.push_back({name, axis});
    } else {
      columns.push_back({name});
    }
  }
  for (const auto& [member, is_point] : kOptional) {
    if (!is_point) columns.push_back({std::string(member)});
    for (const char* axis : {"X", "Y", "Z"}) {
      if (is_point) columns.push_back({std::string(member), axis});
    }
  }
  return columns;
}

void append_cell(std::string& out, const JsonValue* value) {
  if (value == nullptr) return;
  const std::string& text = value->text;
  if (text.find_first_of(",\"") == std::string::npos) {
    out += text;
    return;
  }
  out += '"';
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  out += '"';
}

template <class Cell>
void append_row(std::string& out, const std::vector<Column>& columns, const Cell& cell) {
  for (const Column& column : columns) {
    if (&column != &columns.front()) out += ',';
    cell(column);
  }
  out += "\r\n";
}

}  // namespace

std::string trace_json(const app::RunTrace& trace) {
  std::string out(kHead);
  for (const machine::TracedMove& move : trace.moves) {
    if (&move != &trace.moves.front()) out += ",\n";
    JsonWriter json(out);
    write_move(json, move, trace);
  }
  out += fmt::format("\n],\"dropped\":{}}}", trace.dropped);
  return out;
}

Result<std::string> trace_csv(std::string_view json) {
  std::string out;
  std::vector<Column> columns;
  json.remove_prefix(std::min(kHead.size(), json.size()));
  while (json.starts_with('{')) {
    const std::size_t end = std::min(json.find('\n'), json.size());
    std::string_view line = json.substr(0, end);
    json.remove_prefix(std::min(end + 1, json.size()));
    if (line.ends_with(',')) line.remove_suffix(1);
    const Result<JsonValue> parsed = parse_stored_json(line, "trace of a run");
    if (!parsed) return parsed.error();
    const JsonValue& move = *parsed;
    if (columns.empty()) {
      columns = columns_of(move);
      append_row(out, columns, [&out](const Column& column) { out += column.title(); });
    }
    append_row(out, columns, [&](const Column& column) {
      const JsonValue* value = move.find(column.member);
      append_cell(out, column.axis.empty() || value == nullptr ? value : value->find(column.axis));
    });
  }
  return out;
}

}  // namespace fitgauge::api
