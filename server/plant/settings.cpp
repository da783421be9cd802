#include "plant/settings.hpp"

#include "plant/connections.hpp"
#include "plant/kind.hpp"
#include "plant/log_follower.hpp"
#include "plant/plant.hpp"
#include "record/verdict_codec.hpp"

namespace fitgauge::connections {
namespace {

namespace fs = std::filesystem;

/// Resolves the links of the existing part.
bool is_below(const fs::path& folder, const fs::path& root) {
  std::error_code failure;
  const fs::path inner = fs::weakly_canonical(folder, failure);
  const fs::path outer = fs::weakly_canonical(root, failure);
  if (failure) return false;
  const auto [end, rest] = std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end());
  return end == outer.end();
}

namespace schema = api::schema;
using schema::Others;

/// `folder_in`: FolderInConnection.
std::string component_of(std::string_view kind) {
  std::string component;
  for (std::size_t i = 0; i < kind.size(); ++i) {
    const bool begins = i == 0 || kind[i - 1] == '_';
    if (kind[i] != '_') component += static_cast<char>(begins ? kind[i] - 'a' + 'A' : kind[i]);
  }
  return component + "Connection";
}

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
      schema::object({{"measurement", schema::text(), "Id of the measurement"},
                      {"at", schema::time(), "Time of the refusal"},
                      {"reason", schema::text(), "Answer of the other side"}});
  schema::Fields fields = {
      {"state", schema::words({"waiting", "ok", "failing", "hanging", "stopped"}),
       "State of the last attempt; hanging: the current attempt has made no progress for a minute; "
       "stopped: the other side accepts no more"},
      {"last_attempt_at", time_or_null, ""},
      {"last_success_at", time_or_null, "Time of the last delivery or storage"},
      {"attempt_began_at", time_or_null, "Start of the current attempt"},
      {"lag_s", schema::null_or(schema::number()),
       "Time since the last success; outgoing: age of the next measurement"},
      {"last_error", schema::null_or(schema::text()), "Error of the last failed attempt"},
      {"position", schema::count(), "Outgoing: measurements of the log that are done", false},
      {"behind", schema::count(), "Outgoing: measurements of the log that wait", false},
      {"dead_letters", schema::array(letter),
       "Outgoing: finally refused measurements, newest first", false},
  };
  for (const ConnectionCounter& counter : kConnectionCounters) {
    fields.push_back({std::string(counter.name), schema::count(), std::string(counter.meaning)});
  }
  return fields;
}

}  // namespace

bool SomeOf::read(api::FieldReader& fields, std::string_view name,
                  std::set<std::string, std::less<>>& to) const {
  const JsonValue* const list = fields.array(name);
  if (list == nullptr) return false;
  to.clear();
  for (const JsonValue& item : list->items) {
    const bool is_one = item.is(JsonValue::Kind::String) &&
                        std::find(words.begin(), words.end(), item.text) != words.end();
    if (!is_one) {
      fields.report(ErrorCode::FieldInvalid, name,
                    fmt::format("{} must be a list of {}", name, fmt::join(words, ", ")));
      return false;
    }
    to.insert(item.text);
  }
  if (to.empty()) {
    fields.report(ErrorCode::FieldInvalid, name, "an empty list would send nothing: remove it");
  }
  return !to.empty();
}

bool Path::read(api::FieldReader& fields, std::string_view name, fs::path& to) const {
  const auto text = fields.text(name);
  if (!text) return false;
  to = *text;
  const bool climbs =
      std::any_of(to.begin(), to.end(), [](const fs::path& part) { return part == ".."; });
  if (!to.is_absolute() || climbs || text->find('\0') != std::string::npos) {
    fields.report(
        ErrorCode::FieldInvalid, name,
        fmt::format("{} must be an absolute path without .., such as /srv/measurements", name));
    return false;
  }
  const bool is_allowed =
      allowed->all || std::any_of(allowed->roots.begin(), allowed->roots.end(),
                                  [&](const fs::path& root) { return is_below(to, root); });
  if (!is_allowed) {
    fields.report(ErrorCode::FieldInvalid, name,
                  allowed->roots.empty()
                      ? "paths are not allowed over HTTP: set connection_folders in the "
                        "configuration, or write the connection to the configuration file"
                      : "the path must be in a folder of connection_folders of the configuration");
  }
  return is_allowed;
}

template <class V>
void members(V& v, LogFilter& filter) {
  for (std::size_t i = 0; i < app::kTextFilters.size(); ++i) {
    v.optional(app::kTextFilters[i], filter.query.texts[i], "Exactly this text");
  }
  v.optional("verdict", filter.verdicts,
             SomeOf{{"good", "rework", "reject", "indeterminate", "unjudged"}},
             "One of these verdicts");
  v.optional("source", filter.from, Choice{"gauge", "simulation", "all"},
             "Source of the measurements (default: gauge)");
}

bool LogFilter::takes(const app::Measurement& measurement) const {
  return verdicts.contains(gauging::word(measurement.result.verdict));
}

std::string FilterForm::schema(api::Side side) const { return api::schema_of<LogFilter>(side); }

bool FilterForm::read(api::FieldReader& fields, std::string_view name, LogFilter& to) const {
  if (!api::Object<LogFilter>{}.read(fields, name, to)) return false;
  to.query.source = std::nullopt;
  if (to.from == LogFilter::From::Gauge) to.query.source = store::Source::Gauge;
  if (to.from == LogFilter::From::Simulation) to.query.source = store::Source::Simulation;
  return true;
}

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
  std::vector<std::pair<std::string_view, std::string>> orders;
  for (const Kind& kind : kinds()) {
    names.push_back(kind.name);
    orders.emplace_back(kind.name, component_of(kind.name));
    schemas.push_back(
        {orders.back().second,
         schema::object(schema::Fields{{"kind", schema::words({kind.name}), ""}} + kind.fields(),
                        Others::Refused)});
  }
  schemas.push_back({"ConnectionOrder", schema::one_of("kind", orders)});
  schemas.push_back(
      {"Connection",
       schema::object(schema::Fields{{"name", schema::text(), ""},
                                     {"kind", schema::words(names), ""},
                                     {"direction", schema::words({"in", "out"}), ""},
                                     {"read_only", schema::boolean(),
                                      "The connection belongs to the configuration file"}} +
                      shown_settings() +
                      schema::Fields{{"secret_count", schema::count(), "Number of secrets", false},
                                     {"password_set", schema::boolean(),
                                      "true if a password is stored", false}} +
                      state_fields())});
  schemas.push_back(
      {"Connections",
       schema::object({{"connections", schema::array(schema::ref("Connection")), ""}})});
  schemas.push_back(api::order_schema<ReplayOrder>("ConnectionReplay"));
  schemas.push_back(
      {"ConnectionTest", schema::object({{"ok", schema::boolean(), "The other side was reached"},
                                         {"detail", schema::text(), "Result"}})});
}

}  // namespace fitgauge::connections
