#include "plant/settings.hpp"

namespace fitgauge::connections {
namespace {

namespace fs = std::filesystem;

/// With the links of what is there followed.
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
    const bool is_one = item.is(JsonValue::Kind::String) &&
                        std::find(words.begin(), words.end(), item.text) != words.end();
    if (!is_one) {
      fields.report(ErrorCode::FieldInvalid, name,
                    fmt::format("{} is a list of {}", name, fmt::join(words, ", ")));
      return false;
    }
    to.insert(item.text);
  }
  if (to.empty()) {
    fields.report(ErrorCode::FieldInvalid, name, "an empty list lets nothing through");
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
        fmt::format("{} is an absolute path without .., such as /srv/measurements", name));
    return false;
  }
  const bool is_allowed =
      allowed->all || std::any_of(allowed->roots.begin(), allowed->roots.end(),
                                  [&](const fs::path& root) { return is_below(to, root); });
  if (!is_allowed) {
    fields.report(ErrorCode::FieldInvalid, name,
                  allowed->roots.empty()
                      ? "no path may be named over HTTP: set connection_folders in the "
                        "configuration of the service, or write the connection into its file"
                      : "it is not below those of connection_folders in the configuration "
                        "of the service");
  }
  return is_allowed;
}

}  // namespace fitgauge::connections
