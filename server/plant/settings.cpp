#include "plant/settings.hpp"

#include "plant/connections.hpp"
#include "record/verdict_codec.hpp"

namespace fitgauge::connections {
namespace {

namespace fs = std::filesystem;

/// Whether the folder is `root` or below it. Resolves the links of the part that exists.
bool is_below(const fs::path& folder, const fs::path& root) {
  std::error_code failure;
  const fs::path inner = fs::weakly_canonical(folder, failure);
  const fs::path outer = fs::weakly_canonical(root, failure);
  if (failure) return false;
  const auto [end, rest] = std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end());
  return end == outer.end();
}

}  // namespace

bool SomeOf::read(api::FieldReader& fields, std::string_view name,
                  std::set<std::string, std::less<>>& to) const {
  const JsonValue* const list = fields.array(name);
  if (list == nullptr) return false;
  to.clear();
  for (const JsonValue& item : list->items) {
    const bool is_one =
        item.is(JsonValue::Kind::String) && std::ranges::find(words, item.text) != words.end();
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
  const bool climbs = std::ranges::any_of(to, [](const fs::path& part) { return part == ".."; });
  if (!to.is_absolute() || climbs || text->find('\0') != std::string::npos) {
    fields.report(
        ErrorCode::FieldInvalid, name,
        fmt::format("{} must be an absolute path without .., such as /srv/measurements", name));
    return false;
  }
  const bool is_allowed =
      allowed->all ||
      std::ranges::any_of(allowed->roots, [&](const fs::path& root) { return is_below(to, root); });
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

}  // namespace fitgauge::connections
