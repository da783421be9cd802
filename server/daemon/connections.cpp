#include "daemon/connections.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "base/text.hpp"
#include "daemon/log.hpp"

namespace fitgauge::daemon {
namespace {

using connections::Definition;

JsonValue text_value(std::string text) {
  return {.kind = JsonValue::Kind::String, .text = std::move(text)};
}

template <class Number>
JsonValue number_value(Number number) {
  return {.kind = JsonValue::Kind::Number, .text = fmt::format("{}", number)};
}

/// TOML as the JSON that a PUT would have.
JsonValue json_of(const toml::node& node) {
  JsonValue value;
  if (const toml::table* const table = node.as_table()) {
    value.kind = JsonValue::Kind::Object;
    for (const auto& [key, member] : *table) {
      value.members.emplace_back(std::string(key.str()), json_of(member));
    }
  } else if (const toml::array* const array = node.as_array()) {
    value.kind = JsonValue::Kind::Array;
    for (const toml::node& item : *array) value.items.push_back(json_of(item));
  } else if (const auto text = node.value_exact<std::string>()) {
    return text_value(*text);
  } else if (const auto number = node.value_exact<std::int64_t>()) {
    return number_value(*number);
  } else if (const auto real = node.value_exact<double>()) {
    return number_value(*real);
  } else if (const auto truth = node.value_exact<bool>()) {
    return {.kind = JsonValue::Kind::Boolean, .boolean = *truth};
  } else {
    // A date or a time: no connection takes one, and the message shows it.
    std::ostringstream date;
    node.visit([&date](const auto& any) {
      if constexpr (toml::is_value<decltype(any)>) date << any.get();
    });
    return text_value(date.str());
  }
  return value;
}

/// One `[[connection]]`.
class ConnectionReader {
 public:
  ConnectionReader(const std::string& file, const toml::table& table)
      : file_(file), table_(table) {}

  Result<Definition> read() const;

 private:
  Error error(const toml::node* node, std::string_view message) const {
    const auto line = node == nullptr ? table_.source().begin.line : node->source().begin.line;
    return {ErrorCode::ConfigInvalid, fmt::format("{}:{}: {}", file_, line, message)};
  }
  /// Every field that cannot be accepted, each with its line.
  Error errors(const Error& refused) const;
  /// The names of files with what stands in them.
  Result<void> load_patterns(JsonValue& body) const;

  const std::string& file_;
  const toml::table& table_;
};

Error ConnectionReader::errors(const Error& refused) const {
  if (refused.code == ErrorCode::PathMalformed) return error(table_.get("name"), refused.message);
  if (refused.details.empty()) return error(nullptr, refused.message);
  Error all{ErrorCode::ConfigInvalid, {}};
  for (const Error& field : refused.details) {
    const std::string_view place =
        std::string_view(field.where).substr(field.where.empty() ? 0 : 1);
    const toml::node* const node = table_.get(place.substr(0, place.find('/')));
    all.message += (all.message.empty() ? "" : "\n") + error(node, field.message).message;
  }
  return all;
}

Result<void> ConnectionReader::load_patterns(JsonValue& body) const {
  for (auto& [key, list] : body.members) {
    if (key != "patterns" || !list.is(JsonValue::Kind::Array)) continue;
    for (JsonValue& item : list.items) {
      if (!item.is(JsonValue::Kind::String)) {
        return error(table_.get("patterns"), "patterns must be a list of texts");
      }
      const auto path = std::filesystem::path(file_).parent_path() / item.text;
      std::ifstream file(path, std::ios::binary);
      std::string content{std::istreambuf_iterator<char>(file), {}};
      if (!file) {
        return error(table_.get("patterns"),
                     fmt::format("cannot read the pattern file {}", path.string()));
      }
      JsonValue pattern{.kind = JsonValue::Kind::Object};
      pattern.members.emplace_back("file", text_value(item.text));
      pattern.members.emplace_back("text", text_value(std::move(content)));
      item = std::move(pattern);
    }
  }
  return {};
}

Result<Definition> ConnectionReader::read() const {
  JsonValue body = json_of(table_);
  const JsonValue* const name = body.find("name");
  if (name == nullptr || !name->is(JsonValue::Kind::String)) {
    return error(table_.get("name"), "a connection needs a name, which is a text");
  }
  std::string named = name->text;
  std::erase_if(body.members, [](const auto& member) { return member.first == "name"; });
  if (const auto loaded = load_patterns(body); !loaded) return loaded.error();
  auto definition = connections::read_definition(std::move(named), body, {.all = true});
  if (!definition) return errors(definition.error());
  return definition;
}

}  // namespace

Result<std::vector<Definition>> read_connections(const std::string& path) {
  std::vector<Definition> definitions;
  if (path.empty()) return definitions;
  const auto invalid = [&path](auto line, std::string_view what) {
    return Error{ErrorCode::ConfigInvalid, fmt::format("{}:{}: {}", path, line, what)};
  };
  toml::table file;
  try {
    file = toml::parse_file(path);
  } catch (const toml::parse_error& error) {
    return invalid(error.source().begin.line, error.description());
  }
  std::set<std::string> names;
  for (const auto& [key, node] : file) {
    const toml::array* const list = node.as_array();
    if (key.str() != "connection" || list == nullptr) {
      return invalid(key.source().begin.line, "there is nothing here but [[connection]]");
    }
    for (const toml::node& item : *list) {
      const toml::table* const table = item.as_table();
      if (table == nullptr) return invalid(item.source().begin.line, "write [[connection]]");
      auto definition = ConnectionReader(path, *table).read();
      if (!definition) return definition.error();
      if (!names.insert(ascii_lower(definition->name)).second) {
        return invalid(item.source().begin.line,
                       fmt::format("the connection '{}' comes twice", definition->name));
      }
      definitions.push_back(*std::move(definition));
    }
  }
  if (definitions.size() > connections::kMostConnections) {
    return invalid(1, fmt::format("more than {} connections", connections::kMostConnections));
  }
  return definitions;
}

Result<std::unique_ptr<connections::Connections>> start_connections(
    const Config& config, app::Application& app, const Clock& clock,
    const api::GaugesInUse& gauges) {
  auto configured = read_connections(config.connections);
  if (!configured) return configured.error();
  return connections::Connections::start(
      *std::move(configured),
      {.measurements = app.measurements(),
       .events = app.events(),
       .documents = app.documents(),
       .files = app.files(),
       .tables = app.tables(),
       .gauges = gauges,
       .clock = clock,
       .origin = std::string(app.log().origin()),
       .folders = {config.connection_folders.begin(), config.connection_folders.end()},
       .may_reach_private = config.allow_private_addresses,
       .is_shared = !config.database.empty(),
       .tell = [](std::string_view event, const std::string& detail) {
         event == "connection_recovered" ? log_info(event, detail) : log_warning(event, detail);
       }});
}

}  // namespace fitgauge::daemon
