#include "api/runs/run_codec.hpp"

#include "base/csv.hpp"

namespace fitgauge::api {
namespace {

using machine::Axis;

constexpr std::size_t kLinearAxes = 3;
/// Digits beyond this are noise of the arithmetic of a path.
constexpr int kDecimals = 10;

void write_position(JsonWriter& json, std::string_view which, const machine::Position& position,
                    std::span<const Axis> axes) {
  json.key(std::string(which) + "_mm").begin_object();
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (i == kLinearAxes) json.end_object().key(std::string(which) + "_deg").begin_object();
    json.key(name(axes[i])).fixed(position[axes[i]], kDecimals);
  }
  json.end_object();
}

void write_point(JsonWriter& json, std::string_view key, const machine::Vec3& point) {
  json.key(key).begin_object();
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
    json.key(name(axis)).fixed(point[index(axis)], kDecimals);
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

void write_move(std::string& out, const machine::TracedMove& move, const app::TracePlace& place,
                std::span<const Axis> axes) {
  JsonWriter json(out);
  json.begin_object().member("kind", name(move.kind)).member("block", place.block);
  json.member("line", place.line).member("program", place.program);
  write_position(json, "start", move.start, axes);
  write_position(json, "end", move.end, axes);
  json.key("feed_mm_min").fixed(move.feed_mm_min, kDecimals);
  json.key("seconds").fixed(move.seconds, kDecimals);
  if (move.contact) {
    write_point(json, "contact_mm", move.contact->surface);
  } else {
    json.key("contact_mm").null();
  }
  json.member("cycle", place.cycle != 0 ? std::optional(place.cycle) : std::nullopt);
  write_point(json, "machine_start_mm", move.machine_start);
  write_point(json, "machine_end_mm", move.machine_end);
  if (move.arc) write_arc(json, *move.arc);
  if (move.contact) write_machine_contact(json, *move.contact);
  json.end_object();
}

void write_block(std::string& out, const app::TracePlace& place, std::size_t moves,
                 std::span<const interpreter::ParameterValue> values,
                 std::span<const klartext::DiagnosticNote> origins) {
  JsonWriter json(out);
  json.begin_object().key("block").value(*place.block).member("line", place.line);
  json.member("program", place.program).member("moves", moves);
  json.member("tool", place.tool).key("values");
  write_parameters(json, values);
  if (!origins.empty()) json.key("origins").begin_array();
  for (const klartext::DiagnosticNote& each : origins) {
    json.begin_object().member("message", each.message).member("line", each.range.begin.line);
    json.member("program", each.program.empty() ? place.program : each.program).end_object();
  }
  if (!origins.empty()) json.end_array();
  json.end_object();
}

std::string write_tail(std::size_t dropped, const std::optional<app::WatchedBlocks>& blocks) {
  std::string tail = fmt::format("\n],\"dropped\":{}", dropped);
  if (blocks)
    tail += fmt::format(",\"blocks\":[{}],\"blocks_dropped\":{}", blocks->text, blocks->dropped);
  return tail + '}';
}

/// Members that some moves lack, and whether they are points: each has columns in every CSV.
constexpr std::pair<std::string_view, bool> kOptional[] = {
    {"contact_mm", true},         {"center_mm", true},
    {"sweep_deg", false},         {"axis", false},
    {"machine_center_mm", true},  {"machine_axis", true},
    {"machine_contact_mm", true}, {"machine_contact_normal", true}};

}  // namespace

app::TraceFormat trace_json() {
  return {.head = "{\"moves\":[\n",
          .separator = ",\n",
          .move = write_move,
          .block = write_block,
          .tail = write_tail};
}

std::string TraceCsv::Column::title() const {
  if (axis.empty()) return member;
  const std::size_t unit = member.rfind('_');
  return member.substr(0, unit + 1) + ascii_lower(axis) + member.substr(unit);
}

std::vector<TraceCsv::Column> TraceCsv::columns_of(const JsonValue& move) {
  std::vector<Column> columns;
  for (const auto& [name, value] : move.members) {
    const std::string_view member = name;
    if (std::ranges::any_of(kOptional,
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

void TraceCsv::append_header(std::string& out) const {
  for (const Column& column : columns_) {
    if (&column != &columns_.front()) out += ',';
    out += column.title();
  }
  out += "\r\n";
}

Result<void> TraceCsv::append_line(std::string& out, std::string_view line) {
  const auto move = TRY(parse_stored_json(line, "trace of a run"));
  if (columns_.empty()) {
    columns_ = columns_of(move);
    append_header(out);
  }
  for (const Column& column : columns_) {
    if (&column != &columns_.front()) out += ',';
    const JsonValue* value = move.find(column.member);
    if (value != nullptr && !column.axis.empty()) value = value->find(column.axis);
    if (value != nullptr) sheet::append_csv_cell(out, value->text);
  }
  out += "\r\n";
  return {};
}

std::string TraceCsv::end() {
  std::string out;
  if (!columns_.empty()) return out;
  std::string move;
  write_move(move, {}, {}, std::array{Axis::X, Axis::Y, Axis::Z});
  columns_ = columns_of(parse_json(move).value());
  append_header(out);
  return out;
}

// Only the head also begins a line with a brace, and it ends in a bracket.
Result<std::string> TraceCsv::rows(std::string_view piece) {
  std::string out;
  while (!piece.empty()) {
    const std::size_t end = std::min(piece.find('\n'), piece.size());
    rest_ += piece.substr(0, end);
    if (end == piece.size()) break;
    piece.remove_prefix(end + 1);
    std::string_view line = rest_;
    if (line.ends_with(',')) line.remove_suffix(1);
    if (line.starts_with('{') && !line.ends_with('[')) TRY(append_line(out, line));
    rest_.clear();
  }
  return out;
}

void add_trace_schema(Schemas& schemas) {
  const std::string position = schema::map(schema::number());
  const std::string move = schema::object({
      {"kind", schema::words({"rapid", "feed", "probe", "arc"}), ""},
      {"block", schema::null_or(schema::count()), "Number of the block with the move, as written"},
      {"line", schema::count(), ""},
      {"program", schema::text(), ""},
      {"start_mm", position, "Coordinates by axis"},
      {"start_deg", position, "Angles of the rotary axes; absent without rotary axes", false},
      {"end_mm", position, "Coordinates by axis"},
      {"end_deg", position, "Angles of the rotary axes; absent without rotary axes", false},
      {"feed_mm_min", schema::number(), ""},
      {"seconds", schema::number(), ""},
      {"contact_mm", schema::null_or(position), "Contact of the stylus"},
      {"cycle", schema::null_or(schema::count()), "Number of the cycle that moved"},
      {"machine_start_mm", position, "Position in machine coordinates"},
      {"machine_end_mm", position, "Position in machine coordinates"},
      {"center_mm", position, "Centre of an arc", false},
      {"sweep_deg", schema::number(), "Angle of an arc, counter-clockwise positive", false},
      {"axis", schema::text(), "Axis that an arc turns about", false},
      {"machine_center_mm", position, "Centre of an arc in machine coordinates", false},
      {"machine_axis", position, "Direction of an arc's axis in machine coordinates", false},
      {"machine_contact_mm", position, "Contact in machine coordinates", false},
      {"machine_contact_normal", schema::null_or(position),
       "Normal of a contact, away from the material", false},
  });
  const std::string block = schema::object(
      {{"block", schema::count(), "Block number, as written or counted"},
       {"line", schema::count(), ""},
       {"program", schema::text(), ""},
       {"moves", schema::count(), "Number of moves of the run after the block"},
       {"tool", schema::count(),
        "Number of the tool in the spindle after the block, 0 without one"},
       {"values", schema::map(R"({"type":["number","string"]})"),
        "Values of the watched parameters after the block; undefined ones are absent"},
       {"origins",
        schema::array(schema::object({{"message", schema::text(), ""},
                                      {"line", schema::count(), ""},
                                      {"program", schema::text(), ""}})),
        "Blocks that the values of a measuring cycle or of FN 18 come from", false}});
  schemas.push_back(
      {"Trace", schema::object(
                    {{"moves", schema::array(move), "Moves in order of time"},
                     {"dropped", schema::count(), "Moves beyond the longest trace"},
                     {"blocks", schema::array(block),
                      "Blocks of a run with `watch`, in the order they ran", false},
                     {"blocks_dropped", schema::count(), "Blocks beyond 4 MiB of them", false}})});
}

}  // namespace fitgauge::api
