#include "api/runs/run_order_codec.hpp"
#include "api/schemas.hpp"

namespace fitgauge::api {
namespace {

using schema::null_or;
using schema::Others;

std::string status_words() {
  return schema::words(
      {"queued", "running", "completed", "stopped", "failed", "limit_exceeded", "cancelled"});
}

std::string parameter_values() { return schema::map(R"({"type":["number","string"]})"); }

std::string three_numbers() { return schema::array(schema::number(), 3, 3); }

schema::Fields head_fields() {
  return {
      {"id", schema::text(), "Opaque"},
      {"status", status_words(), "The last five are final"},
      {"program", schema::text(), "As the control writes its path"},
  };
}

void add_order_schema(Schemas& schemas) {
  const std::string limits = schema::object(
      schema::optional({
          {"blocks", schema::with_default(schema::integer(1, kMostBlocks), "1000000"), "Executed"},
          {"seconds", schema::with_default(schema::number(0, kMostSeconds), "10"),
           "Of computing, above 0; machining time has no limit"},
      }),
      Others::Refused);
  const schema::Fields program = {{"program", schema::text(), "TNC:\\nc_prog\\8255\\8255.h"}};
  const schema::Fields others = schema::optional({
      {"setup", schema::any_of({schema::text(), schema::ref("Setup")}),
       "The name of a stored setup, or a setup"},
      {"parameters", parameter_values(),
       "Q, QL and QR numbers and QS strings, as if an earlier program had left them"},
      {"limits", limits, "What ends the run with limit_exceeded"},
      {"contacts_mm", schema::array(schema::null_or(three_numbers())),
       "What a real machine touched: the ball's centre in the active system for each probing move "
       "in "
       "order, null where a move touched nothing. They stand for the setup's workpiece"},
      {"on_stop", schema::with_default(schema::words({"continue", "end"}), "\"continue\""),
       "At STOP, M0 and Q281=2: go on as with NC Start, or end there"},
      {"unreadable", schema::with_default(schema::words({"refuse", "error_block"}), "\"refuse\""),
       "Lines that are no Klartext: refuse the program, or fail where one is reached"},
      {"block_skip", schema::with_default(schema::boolean(), "false"),
       "Skip blocks that begin with /"},
      {"language",
       schema::with_default(schema::words({"english", "german", "dutch", "italian"}),
                            "\"english\""),
       "Of FN 16 masks"},
      {"part_id", schema::text(kLongestSubject),
       "The part that is measured: in each record of the run"},
      {"order", schema::text(kLongestSubject), "Its order, likewise"},
  });
  schemas.push_back(
      {"RunOrder", schema::object(program + others, Others::Refused,
                                  R"({"program":"TNC:\\nc_prog\\8255\\8255.h",)"
                                  R"("setup":"m3","parameters":{"Q1":25,"QS1":"H7"}})")});
}

std::string message() {
  return schema::object({
      {"kind", schema::words({"error", "stop", "limit", "cancelled", "note"}),
       "A note says what the simulation leaves out"},
      {"number", schema::count(), "Of the control's message; 0 where it has none"},
      {"text", schema::text(), "What happened"},
      {"program", schema::text(), "Where"},
      {"line", schema::count(), "Where, from 1"},
      {"block", null_or(schema::count()), "Where, by the number as written"},
      {"column", schema::count(), "Of a word that is wrong, from 1", false},
      {"source", schema::text(), "With the column: the line as written", false},
  });
}

std::string preset() {
  return schema::object({
      {"number", schema::count(), "Row of the preset table"},
      {"x_mm", schema::number(), ""},
      {"y_mm", schema::number(), ""},
      {"z_mm", schema::number(), ""},
      {"rotation_deg", three_numbers(), "SPA, SPB, SPC"},
      {"offsets_deg", three_numbers(), "A_OFFS, B_OFFS, C_OFFS"},
  });
}

std::string measured_size() {
  return schema::object({
      {"characteristic", schema::text(), "What was measured: diameter, width"},
      {"nominal_mm", schema::number(), ""},
      {"measured_mm", schema::number(), ""},
      {"deviation_um", schema::number(), "Measured minus nominal"},
      {"upper_limit_mm", schema::number(), "Where the cycle was given limits", false},
      {"lower_limit_mm", schema::number(), "Where the cycle was given limits", false},
      {"verdict", verdict_words(), ""},
  });
}

std::string cycle_measurement() {
  const std::string form = schema::object({
      {"assessable", schema::boolean(), "Whether there are enough points to judge it"},
      {"reason", schema::text(), "Why not", false},
      {"residual_mm", schema::number(), "Root mean square of the points from the circle", false},
  });
  return schema::object({
      {"cycle", schema::count(), "Its number"},
      {"program", schema::text(), ""},
      {"line", schema::count(), ""},
      {"block", null_or(schema::count()), ""},
      {"verdict", null_or(verdict_words()), "null without limits"},
      {"sizes", schema::array(measured_size()), ""},
      {"form", form, "Of a circular feature", false},
  });
}

schema::Fields result_fields() {
  const std::string file =
      schema::object({{"path", schema::text(), ""}, {"size", schema::count(), "In bytes"}});
  const std::string table = schema::object(
      {{"path", schema::text(), ""},
       {"source", schema::text(), "live: projected from the tables in use; stored: a file"}});
  return schema::Fields{
             {"created_at", schema::time(), "In UTC"},
             {"finished_at", schema::time(), "Absent until it is over", false},
             {"blocks_executed", schema::count(), "So far"},
             {"verdict", null_or(verdict_words()), "Of the last measuring cycle"},
             {"parameters", parameter_values(), "Every Q, QL, QR and QS defined at the end"},
             {"screen", schema::array(schema::text()), "Every line printed, in order"},
             {"files", schema::array(file), "Written by the run"},
             {"tables", schema::array(table), "Opened by the run"},
             {"messages", schema::array(message()), "Every status but completed has one"},
             {"measurements", schema::array(cycle_measurement()), "One for each measuring cycle"},
         } +
         schema::optional({
             {"active_preset", schema::count(), "At the end"},
             {"presets", schema::array(preset()), "The preset table at the end"},
             {"machining_time_s", schema::number(), "What the machine would have taken"},
             {"setup_seed", schema::count(), "With it the run can be repeated"},
         });
}

void add_trace_schema(Schemas& schemas) {
  const std::string position = schema::map(schema::number());
  const std::string move = schema::object({
      {"kind", schema::words({"rapid", "feed", "probe", "arc"}), ""},
      {"block", null_or(schema::count()), "That commanded it, by its number as written"},
      {"line", schema::count(), ""},
      {"program", schema::text(), ""},
      {"start_mm", position, "By axis"},
      {"start_deg", position, "Of the rotary axes, where there are any", false},
      {"end_mm", position, "By axis"},
      {"end_deg", position, "Of the rotary axes, where there are any", false},
      {"feed_mm_min", schema::number(), ""},
      {"seconds", schema::number(), ""},
      {"contact_mm", null_or(position), "Where the stylus touched"},
      {"cycle", null_or(schema::count()), "That moved, by its number"},
      {"machine_start_mm", position, "In machine coordinates"},
      {"machine_end_mm", position, "In machine coordinates"},
      {"center_mm", position, "Of an arc", false},
      {"sweep_deg", schema::number(), "Of an arc, counter-clockwise positive", false},
      {"axis", schema::text(), "Of an arc: the one it turns about", false},
      {"machine_center_mm", position, "Of an arc, in machine coordinates", false},
      {"machine_axis", position, "Of an arc: direction in machine coordinates", false},
      {"machine_contact_mm", position, "Of a contact, in machine coordinates", false},
      {"machine_contact_normal", null_or(position), "Of a contact: away from the material", false},
  });
  schemas.push_back(
      {"Trace", schema::object({{"moves", schema::array(move), "In order"},
                                {"dropped", schema::count(), "Moves beyond the longest trace"}})});
}

}  // namespace

void add_run_schemas(Schemas& schemas) {
  add_order_schema(schemas);
  schemas.push_back(
      {"Run", schema::object(
                  head_fields() + result_fields(), Others::Allowed,
                  R"({"id":"r1","status":"completed","program":"TNC:\\nc_prog\\bore.h",)"
                  R"("created_at":"2026-11-20T07:00:00Z","finished_at":"2026-11-20T07:00:00.02Z",)"
                  R"("blocks_executed":4,"verdict":"good","parameters":{"Q153":25.013},)"
                  R"("screen":[],"files":[],"tables":[],"messages":[],"measurements":[],)"
                  R"("active_preset":1,"presets":[],"machining_time_s":12.4,"setup_seed":1})")});
  const schema::Fields times = {{"created_at", schema::time(), "In UTC"},
                                {"finished_at", null_or(schema::time()), "null until it is over"}};
  schemas.push_back(
      {"RunList",
       schema::object(
           {{"runs", schema::array(schema::object(head_fields() + times)), "The newest first"},
            {"next", null_or(schema::text()), "For `after`; null on the last page"}})});
  schemas.push_back({"RunParameters", parameter_values()});
  const schema::Fields outcome = {{"finished_at", schema::time(), "In UTC"},
                                  {"verdict", null_or(verdict_words()), ""}};
  schemas.push_back({"RunFinished", schema::object(head_fields() + outcome)});
  schemas.push_back(
      {"RunProgress", schema::object({{"status", status_words(), ""},
                                      {"blocks_executed", schema::count(), "So far"}})});
  schemas.push_back(
      {"RunOutput", schema::object({{"line", schema::text(), "As printed on the screen"}})});
  schemas.push_back({"RunEvent", schema::any_of({schema::ref("RunOutput"),
                                                 schema::ref("RunProgress"), schema::ref("Run")})});
  add_trace_schema(schemas);
}

}  // namespace fitgauge::api
