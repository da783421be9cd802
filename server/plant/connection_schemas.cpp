#include "api/schemas.hpp"
#include "plant/connection_state.hpp"
#include "plant/connections.hpp"
#include "service/measurements/measurement_service.hpp"

namespace fitgauge::connections {
namespace {

namespace schema = api::schema;
using schema::Others;

schema::Fields lsv2_fields() {
  return {
      {"address", schema::text(), "host or host:port of the control"},
      {"paths", schema::array(schema::text()), "What is watched: TNC:\\nc_prog\\TCHPR*.TXT"},
      {"machine", schema::text(200), "Of its measurements; its name when absent", false},
      {"interval_s", schema::integer(1, 86'400), "Between two attempts; 60 when absent", false},
      {"patterns",
       schema::array(schema::object(
           {{"file", schema::text(), "What it is called"}, {"text", schema::text(), "The pattern"}},
           Others::Refused)),
       "For files of FN 16", false},
  };
}

schema::Fields folder_in_fields() {
  return schema::Fields{{"folder", schema::text(), "Of this machine, an absolute path"}} +
         schema::optional(
             {{"names", schema::array(schema::text(100)), "Of files, with * and ?; *.csv and such"},
              {"map", schema::map(schema::text()),
               "A column's name and the field it is, date or time; empty leaves it out"},
              {"set", schema::map(schema::text()), "A field and its value for every row"},
              {"time_zone", schema::text(), "Of times without an offset: Europe/Berlin"},
              {"encoding", schema::text(), "auto, utf-8, utf-16, windows-1252; auto when absent"},
              {"other_columns", schema::words({"refuse", "leave_out"}), "refuse when absent"},
              {"length_unit", schema::text(), "Of a DFQ that names none: mm, inch"},
              {"interval_s", schema::integer(1, 3600), "Between two looks; 10 when absent"},
              {"rest_s", schema::integer(1, 3600),
               "Size and time of a file are the same for so long; 2 when absent"}});
}

/// For lsv2, whose own fields have the interval already.
schema::Fields without_interval(schema::Fields fields) {
  std::erase_if(fields, [](const schema::Field& field) { return field.name == "interval_s"; });
  return fields;
}

schema::Fields filter_fields() {
  schema::Fields fields;
  for (const std::string_view name : app::kTextFilters) {
    fields.push_back({std::string(name), schema::text(), "The same text"});
  }
  return schema::optional(
      fields + schema::Fields{
                   {"verdict", schema::array(api::verdict_words()), "One of these"},
                   {"source", schema::words({"gauge", "simulation", "all"}), "gauge when absent"}});
}

schema::Fields follower_fields() {
  return schema::optional(
      {{"filter", schema::object(filter_fields(), Others::Refused),
        "Which measurements go out; all that a gauge has measured when absent"},
       {"start", schema::words({"now", "beginning"}),
        "Where a new connection begins; now when absent"},
       {"longest_wait_s", schema::integer(1, 3600), "Between two attempts; 300 when absent"}});
}

schema::Fields event_fields() {
  return {{"events",
           schema::array(schema::words(
               {"measurement.recorded", "run.finished", "table.changed", "note.added"})),
           "What goes out; measurement.recorded when absent", false}};
}

schema::Fields webhook_fields() {
  return schema::Fields{
             {"url", schema::text(2000), "https://host/path"},
             {"timeout_s", schema::integer(1, 30), "Of a request; 15 when absent", false}} +
         event_fields() + follower_fields();
}

schema::Fields folder_out_own_fields() {
  return schema::optional(
      {{"format", schema::words({"csv", "ndjson", "dfq", "qif"}), "csv when absent"},
       {"part_number", schema::text(30), "K1001 of a DFQ; - when absent"},
       {"part_description", schema::text(80), "K1002 of a DFQ; - when absent"},
       {"split", schema::words({"none", "part_id", "order"}),
        "A file has measurements of one of these alone; none when absent"},
       {"every_s", schema::integer(1, 86'400), "What is younger waits for more; 60 when absent"}});
}

schema::Fields folder_out_fields() {
  return schema::Fields{
             {"folder", schema::text(), "Of this machine, an absolute path"},
             {"time_zone", schema::text(), "Of the times in a DFQ; UTC when absent", false}} +
         folder_out_own_fields() + follower_fields();
}

schema::Fields secret_fields() {
  return {{"secrets", schema::array(schema::text()),
           "1 to 4, whsec_ and 24 to 64 bytes in base64; each signs. Those there are when absent",
           false}};
}

schema::Fields broker_fields() {
  return schema::Fields{{"broker", schema::text(200), "mqtts://host or mqtt://host, with :port"}} +
         schema::optional({{"user", schema::text(200), "As the broker knows the service"},
                           {"ca_file", schema::text(),
                            "Of this machine, who vouches for the broker; the "
                            "system's authorities when absent"},
                           {"client_id", schema::text(100),
                            "fitgauge-, digits of the data folder and the name "
                            "when absent"}});
}

schema::Fields mqtt_own_fields() {
  return schema::Fields{{"topic", schema::text(500), "plant/{machine}/{characteristic}"}} +
         schema::optional({{"version", schema::words({"3.1.1", "5"}), "Of MQTT; 3.1.1 when absent"},
                           {"status_topic", schema::text(500),
                            "Of online and offline; client_id/status when absent"},
                           {"events_topic", schema::text(500),
                            "Above the type of an event; client_id/events when absent"},
                           {"retain", schema::boolean(),
                            "The broker keeps the last of each topic; true when absent"}});
}

schema::Fields sparkplug_own_fields() {
  return schema::Fields{{"group", schema::text(200), "Its id of a group"},
                        {"node", schema::text(200), "Its id of an edge node"}} +
         schema::optional(
             {{"device", schema::text(500), "{machine}:{characteristic} when absent"},
              {"primary_host", schema::text(200), "Nothing goes out while it is offline"},
              {"most_devices", schema::integer(1, 1000), "Alive together; 1000 when absent"}});
}

schema::Fields password_field() {
  return {{"password", schema::text(200),
           "That there is when absent, for the same broker, user and ca_file", false}};
}

std::string order_of(std::string_view kind, const schema::Fields& fields) {
  return schema::object(schema::Fields{{"kind", schema::words({kind}), ""}} + fields,
                        Others::Refused);
}

schema::Fields state_fields() {
  const std::string time_or_null = schema::null_or(schema::text());
  const std::string letter =
      schema::object({{"measurement", schema::text(), "Its id"},
                      {"at", schema::time(), "When it was given up"},
                      {"reason", schema::text(), "What the other side said"}});
  schema::Fields fields = {
      {"state", schema::words({"waiting", "ok", "failing", "stopped"}),
       "Of its last attempt; stopped: the other side wants no more"},
      {"last_attempt_at", time_or_null, ""},
      {"last_success_at", time_or_null, ""},
      {"lag_s", schema::null_or(schema::number()),
       "Since the last success; of an outgoing one the age of what is to go next"},
      {"last_error", schema::null_or(schema::text()), "Of the last attempt that failed"},
      {"position", schema::count(), "Outgoing: measurements of the log that are dealt with", false},
      {"behind", schema::count(), "Outgoing: those that are not", false},
      {"dead_letters", schema::array(letter), "Outgoing: refused for good, the newest first",
       false},
  };
  for (const ConnectionCounter& counter : kConnectionCounters) {
    fields.push_back({std::string(counter.name), schema::count(), std::string(counter.meaning)});
  }
  return fields;
}

}  // namespace

void add_connection_schemas(api::Schemas& schemas) {
  schemas.push_back(
      {"ConnectionOrder",
       schema::any_of({order_of("lsv2", lsv2_fields()),
                       order_of("webhook", webhook_fields() + secret_fields()),
                       order_of("mqtt", broker_fields() + password_field() + mqtt_own_fields() +
                                            event_fields() + follower_fields()),
                       order_of("sparkplug", broker_fields() + password_field() +
                                                 sparkplug_own_fields() + follower_fields()),
                       order_of("folder_in", folder_in_fields()),
                       order_of("folder_out", folder_out_fields())})});
  schemas.push_back(
      {"Connection",
       schema::object(
           schema::Fields{
               {"name", schema::text(), ""},
               {"kind",
                schema::words({"lsv2", "webhook", "folder_in", "folder_out", "mqtt", "sparkplug"}),
                ""},
               {"direction", schema::words({"in", "out"}), ""},
               {"read_only", schema::boolean(), "Stands in the configuration file"}} +
           schema::optional(lsv2_fields() + webhook_fields() +
                            without_interval(folder_in_fields()) + folder_out_own_fields() +
                            broker_fields() + mqtt_own_fields() + sparkplug_own_fields()) +
           schema::Fields{{"secret_count", schema::count(), "How many secrets there are", false},
                          {"password_set", schema::boolean(), "There is a password", false}} +
           state_fields())});
  schemas.push_back(
      {"Connections",
       schema::object({{"connections", schema::array(schema::ref("Connection")), ""}})});
  schemas.push_back(
      {"ConnectionTest", schema::object({{"ok", schema::boolean(), "The other side was reached"},
                                         {"detail", schema::text(), "What was found"}})});
}

}  // namespace fitgauge::connections
