#include "api/runs/run_codec.hpp"

#include <doctest/doctest.h>

#include "api/runs/run_posting.hpp"
#include "base/json/json_value.hpp"
#include "service/runs/stored_run.hpp"

using namespace fitgauge;
using namespace fitgauge::api;

namespace {

app::RunReport report() {
  app::RunReport report{.id = 3, .origin = "5f0c9a3e77d21b40", .program = "TNC:\\a.h"};
  report.seed = 8;
  interpreter::RunResult& result = report.result;
  result.status = interpreter::RunStatus::Failed;
  result.blocks_executed = 12;
  const auto parameter = [&](std::string_view name, std::variant<double, std::string> value) {
    result.parameters.push_back(
        {interpreter::parse_parameter_name(name).value(), std::move(value)});
  };
  parameter("Q23", 25 + 21 / 1000.0);
  parameter("Q24", -0.0);
  parameter("QS3", "\"GOOD\"");
  result.screen = {"LINE"};
  result.messages.push_back({.kind = interpreter::MessageKind::Error,
                             .number = 1014,
                             .text = "Touch point inaccessible",
                             .program = "TNC:\\a.h",
                             .line = 31,
                             .block = 29});
  result.presets = {machine::Preset{.number = 1, .comment = {}, .frame = {{0.5, 0, 0}, {}, {}}}};
  return report;
}

constexpr app::TracePlace kPlace{.program = "TNC:\\a.h", .line = 4, .block = 3};

/// As it is stored and sent.
std::string trace_of(const std::vector<machine::TracedMove>& moves, const app::TracePlace& place,
                     std::vector<machine::Axis> axes = {machine::Axis::X, machine::Axis::Y,
                                                        machine::Axis::Z}) {
  const app::TraceFormat format = trace_json();
  app::TraceWriter writer(format, std::move(axes));
  for (const machine::TracedMove& move : moves) writer.add(move, place);
  app::TraceReader reader(writer.finish(0));
  std::string text;
  for (std::string piece; !(piece = reader.next().value()).empty();) text += piece;
  return text;
}

TEST_CASE("a run is written with the fields of the contract") {
  const auto run = parse_json(run_format().report(report())).value();
  const auto text = [&](std::string_view name) { return run.find(name)->text; };
  CHECK(text("id") == "r3-5f0c9a3e77d21b40");
  CHECK(text("status") == "failed");
  CHECK(text("program") == "TNC:\\a.h");
  CHECK(text("blocks_executed") == "12");
  CHECK(text("setup_seed") == "8");
  CHECK(run.find("verdict")->is(JsonValue::Kind::Null));
  const JsonValue& parameters = *run.find("parameters");
  CHECK(parameters.find("Q23")->text == "25.021");
  CHECK(parameters.find("Q24")->text == "0");
  CHECK(parameters.find("QS3")->text == "\"GOOD\"");
  CHECK(run.find("screen")->items.at(0).text == "LINE");
  const JsonValue& message = run.find("messages")->items.at(0);
  CHECK(message.find("kind")->text == "error");
  CHECK(message.find("number")->text == "1014");
  CHECK(message.find("line")->text == "31");
  CHECK(message.find("block")->text == "29");
  CHECK(run.find("presets")->items.at(0).find("x_mm")->text == "0.5");
}

TEST_CASE("a number that is none is null in every document of a run") {
  const double infinite = std::numeric_limits<double>::infinity();
  app::RunReport odd = report();
  odd.result.machining_time_s = infinite;
  odd.result.presets[0].frame.origin.y = -infinite;
  odd.result.parameters[0].value = std::numeric_limits<double>::quiet_NaN();
  const auto run = parse_json(run_format().report(odd)).value();
  CHECK(run.find("machining_time_s")->is(JsonValue::Kind::Null));
  CHECK(run.find("presets")->items.at(0).find("y_mm")->is(JsonValue::Kind::Null));
  CHECK(run.find("parameters")->members.at(0).second.is(JsonValue::Kind::Null));

  machine::TracedMove move;
  move.seconds = infinite;
  move.end[machine::Axis::X] = std::numeric_limits<double>::quiet_NaN();
  const std::string json = trace_of({move}, {}, {machine::Axis::X});
  REQUIRE(parse_json(json).has_value());
  CHECK(json.find("\"seconds\":null") != std::string::npos);
  CHECK(json.find("\"end_mm\":{\"X\":null}") != std::string::npos);
  CHECK(TraceCsv().rows(json).value().find("inf") == std::string::npos);
}

TEST_CASE("stored text that cannot be read is an error and not an exception") {
  const std::string spoiled = "{\"machining_time_s\":inf}";
  for (const char* const report : {R"({"screen":[inf]})", R"({"screen":["a")", "7"}) {
    CHECK(finished_run_events(report, {}).error().code == ErrorCode::StorageCorrupt);
  }
  CHECK(TraceCsv().rows("{\"moves\":[\n" + spoiled + "\n]}").error().code ==
        ErrorCode::StorageCorrupt);
  CHECK(finished_run_events("{}", {}).has_value());  // an older form, without the screen
}

TEST_CASE("a cell of a trace is quoted as in every CSV") {
  const std::string trace = "{\"moves\":[\n{\"program\":\"a;b\",\"call\":\"c\\n\\\"d\\\"\"}\n]}";
  CHECK(TraceCsv().rows(trace).value().find("\"a;b\",\"c\n\"\"d\"\"\"") != std::string::npos);
}

TEST_CASE("a trace has the header of its CSV once, also without moves") {
  TraceCsv still;
  CHECK(still.rows(trace_of({}, kPlace)).value().empty());
  const std::string header = still.end();
  CHECK(header.starts_with("kind,block,line,program,start_x_mm,"));
  TraceCsv moved;
  CHECK(moved.rows(trace_of({machine::TracedMove{}}, kPlace)).value().starts_with(header));
  CHECK(moved.end().empty());
}

TEST_CASE("events of a run that is over carry ids, and a reader goes on behind the one it had") {
  const std::string report = R"({"screen":["one","two"]})";
  const auto events = [&](std::optional<std::string_view> last) {
    return std::get<std::string>(finished_run_events(report, last).value().body);
  };
  const std::string end = "event: end\nid: end\ndata: " + report + "\n\n";
  const std::string two = "event: output\nid: 2\ndata: {\"line\":\"two\"}\n\n";
  CHECK(events({}) == "event: output\nid: 1\ndata: {\"line\":\"one\"}\n\n" + two + end);
  CHECK(events("0") == events({}));
  CHECK(events("no id of ours") == events({}));
  CHECK(events("1") == two + end);
  CHECK(events("2") == end);
  CHECK(finished_run_events(report, "end").value().status == 204);
}

TEST_CASE("a block without a number is null") {
  app::RunReport unnumbered = report();
  unnumbered.result.messages[0].block.reset();
  const auto run = parse_json(run_format().report(unnumbered)).value();
  CHECK(run.find("messages")->items.at(0).find("block")->is(JsonValue::Kind::Null));
}

TEST_CASE("the event of a run tells how it ended") {
  app::RunReport good = report();
  good.result.status = interpreter::RunStatus::Completed;
  good.result.verdict = gauging::Verdict::Good;
  const auto event = parse_json(run_format().event(good)).value();
  CHECK(event.find("id")->text == "r3-5f0c9a3e77d21b40");
  CHECK(event.find("status")->text == "completed");
  CHECK(event.find("verdict")->text == "good");
}

TEST_CASE("the seed of an order that is stored is found again") {
  const auto seed = run_format().seed;
  CHECK(seed(R"({"program":"TNC:\\a.h","setup":{"seed":9223372036854775807}})") ==
        9223372036854775807ULL);
  CHECK(seed(R"({"program":"TNC:\\a.h","setup":{}})") == 1);
  CHECK(seed(R"({"program":"TNC:\\a.h"})") == 1);
  CHECK(seed("") == 1);
}

TEST_CASE("a trace is written move by move") {
  const auto written = parse_json(trace_of({machine::TracedMove{}}, kPlace)).value();
  const JsonValue& first = written.find("moves")->items.at(0);
  CHECK(first.find("block")->text == "3");
  CHECK(first.find("end_mm")->find("X")->text == "0");
  CHECK(first.find("end_mm")->find("A") == nullptr);
  CHECK(first.find("contact_mm")->is(JsonValue::Kind::Null));
  CHECK(first.find("cycle")->is(JsonValue::Kind::Null));
  CHECK(first.find("machine_start_mm")->find("Z")->text == "0");
  CHECK(first.find("sweep_deg") == nullptr);
}

TEST_CASE("an arc and a contact bring what draws them, and columns in every CSV") {
  app::TracePlace place = kPlace;
  place.cycle = 421;
  machine::TracedMove arc{};
  arc.kind = machine::MoveKind::Arc;
  arc.arc = machine::TracedArc{
      .centre = {1, 2, 3}, .sweep_deg = -90, .axis = machine::Axis::Y, .machine_axis = {0, -1, 0}};
  machine::TracedMove probe{};
  probe.kind = machine::MoveKind::Probe;
  probe.contact =
      machine::TracedContact{.surface = {4, 5, 6}, .machine_surface = {7, 8, 9}, .normal = {}};
  const std::string json = trace_of({machine::TracedMove{}, arc, probe}, place);
  const auto moves = parse_json(json).value();
  const JsonValue& drawn = moves.find("moves")->items.at(1);
  CHECK(drawn.find("center_mm")->find("Y")->text == "2");
  CHECK(drawn.find("sweep_deg")->text == "-90");
  CHECK(drawn.find("axis")->text == "Y");
  CHECK(drawn.find("machine_axis")->find("Y")->text == "-1");
  CHECK(drawn.find("cycle")->text == "421");
  const JsonValue& touched = moves.find("moves")->items.at(2);
  CHECK(touched.find("contact_mm")->find("X")->text == "4");
  CHECK(touched.find("machine_contact_mm")->find("X")->text == "7");
  CHECK(touched.find("machine_contact_normal")->is(JsonValue::Kind::Null));
  const std::string csv = TraceCsv().rows(json).value();
  CHECK(csv.find("center_x_mm,center_y_mm,center_z_mm,sweep_deg,axis,machine_center_x_mm") !=
        std::string::npos);
  CHECK(csv.find("1,2,3,-90,Y,") != std::string::npos);

  TraceCsv byte_by_byte;
  std::string same;
  for (const char byte : json) same += byte_by_byte.rows({&byte, 1}).value();
  CHECK(same == csv);
}

}  // namespace
