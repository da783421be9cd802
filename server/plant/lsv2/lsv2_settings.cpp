#include "base/text.hpp"
#include "plant/kind.hpp"
#include "plant/lsv2/collector.hpp"

namespace fitgauge::connections {
namespace {

constexpr std::size_t kMostPatterns = 20;

Result<control_link::ControlAddress> read_address(std::string_view text) {
  if (const auto address = control_link::parse_control_address(text)) return *address;
  return invalid_field(fmt::format("'{}' is no HOST or HOST:PORT", first_characters(text, 100)));
}

/// `TNC:\nc_prog\TCHPR*.TXT`; `/` separates as `\` does.
Result<WatchedPath> read_watched(const JsonValue& item) {
  if (!item.is(JsonValue::Kind::String)) return Error{ErrorCode::FieldType, "a path is a text"};
  std::string path = item.text;
  std::replace(path.begin(), path.end(), '/', '\\');
  const std::size_t stroke = path.rfind('\\');
  const bool is_path = path.size() > 5 && ascii_iequals(path.substr(0, 5), "TNC:\\") &&
                       stroke + 1 < path.size() && path.find("..") == std::string::npos &&
                       path.find_first_of("*?") >= stroke;
  if (is_path) return WatchedPath{path.substr(0, stroke + 1), path.substr(stroke + 1)};
  return invalid_field(fmt::format(
      "'{}' is no path to watch: write a folder of TNC:\\ and a file name, which may have "
      "* and ?, such as TNC:\\nc_prog\\TCHPR*.TXT",
      item.text));
}

struct Patterns {
  std::string schema(api::Side side) const {
    return api::schema::array(api::schema_of<NamedPattern>(side));
  }
  bool read(api::FieldReader& fields, std::string_view name, std::vector<NamedPattern>& to) const {
    const JsonValue* const list = fields.array(name);
    if (list == nullptr) return false;
    if (list->items.size() <= kMostPatterns)
      return api::List<NamedPattern>{}.read(fields, name, to);
    fields.report(ErrorCode::FieldInvalid, name, fmt::format("at most {} patterns", kMostPatterns));
    return false;
  }
};

}  // namespace

template <class V>
void members(V& v, NamedPattern& pattern) {
  v.member("file", pattern.file, "What it is called");
  v.member("text", pattern.pattern, By{0, log_reader::Pattern::parse}, "The pattern");
}

template <class V>
void members(V& v, MachineOptions& machine) {
  v.member("address", machine.address, By{0, read_address}, "host or host:port of the control");
  v.member("paths", machine.paths,
           Each{1, 100, "paths are watched, such as TNC:\\nc_prog\\TCHPR*.TXT", api::schema::text(),
                read_watched},
           "What is watched: TNC:\\nc_prog\\TCHPR*.TXT");
  v.optional("machine", machine.machine, api::Text{200},
             "Of its measurements; its name when absent");
  v.optional("interval_s", machine.interval, Within{1, 86'400},
             "Between two attempts; 60 when absent");
  v.optional("patterns", machine.patterns, Patterns{}, "For files of FN 16");
}

Kind lsv2_kind() { return kind_of<MachineOptions>("lsv2"); }

}  // namespace fitgauge::connections
