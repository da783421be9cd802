#include <algorithm>

#include "plant/connections.hpp"
#include "plant/kind.hpp"
#include "plant/log_follower.hpp"
#include "plant/plant.hpp"

namespace fitgauge::connections {
namespace {

namespace schema = api::schema;
using schema::Others;

/// The settings of all kinds, each once, without secrets.
schema::Fields shown_settings() {
  schema::Fields all;
  for (const Kind& kind : kinds()) {
    for (schema::Field& field : kind.fields()) {
      const bool is_new = std::none_of(all.begin(), all.end(), [&](const schema::Field& other) {
        return other.name == field.name;
      });
      if (is_new && !is_secret(field.name)) all.push_back(std::move(field));
    }
  }
  return schema::optional(std::move(all));
}

schema::Fields state_fields() {
  const std::string time_or_null = schema::null_or(schema::text());
  const std::string letter =
      schema::object({{"measurement", schema::text(), "Its id"},
                      {"at", schema::time(), "When it was given up"},
                      {"reason", schema::text(), "What the other side said"}});
  schema::Fields fields = {
      {"state", schema::words({"waiting", "ok", "failing", "hanging", "stopped"}),
       "Of its last attempt; hanging: the attempt under way has stood still for a minute; stopped: "
       "the other side wants no more"},
      {"last_attempt_at", time_or_null, ""},
      {"last_success_at", time_or_null, "When something was delivered or stored"},
      {"attempt_began_at", time_or_null, "Of the attempt under way"},
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

#define FITGAUGE_KIND(kind, folder) Kind kind##_kind();
#include "plant_kinds.inc"
#undef FITGAUGE_KIND

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
#define FITGAUGE_KIND(kind, folder) kind##_kind(),
#include "plant_kinds.inc"
#undef FITGAUGE_KIND
  };
  return all;
}

void add_connection_schemas(api::Schemas& schemas) {
  std::vector<std::string_view> names;
  std::vector<std::string> orders;
  for (const Kind& kind : kinds()) {
    names.push_back(kind.name);
    orders.push_back(schema::object(
        schema::Fields{{"kind", schema::words({kind.name}), ""}} + kind.fields(), Others::Refused));
  }
  schemas.push_back({"ConnectionOrder", schema::any_of(orders)});
  schemas.push_back(
      {"Connection",
       schema::object(
           schema::Fields{{"name", schema::text(), ""},
                          {"kind", schema::words(names), ""},
                          {"direction", schema::words({"in", "out"}), ""},
                          {"read_only", schema::boolean(), "Stands in the configuration file"}} +
           shown_settings() +
           schema::Fields{{"secret_count", schema::count(), "How many secrets there are", false},
                          {"password_set", schema::boolean(), "There is a password", false}} +
           state_fields())});
  schemas.push_back(
      {"Connections",
       schema::object({{"connections", schema::array(schema::ref("Connection")), ""}})});
  schemas.push_back(api::order_schema<ReplayOrder>("ConnectionReplay"));
  schemas.push_back(
      {"ConnectionTest", schema::object({{"ok", schema::boolean(), "The other side was reached"},
                                         {"detail", schema::text(), "What was found"}})});
}

}  // namespace fitgauge::connections
