#include "daemon/connections.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>

#include "base/text.hpp"
#include "daemon/log.hpp"

namespace fitgauge::daemon {
namespace {

using collector::MachineOptions;

constexpr std::size_t kMostConnections = 100;
constexpr std::int64_t kLeastInterval = 1;
constexpr std::int64_t kMostInterval = 86'400;

/// One `[[connection]]`, read key by key; the first error is kept.
class ConnectionReader {
 public:
  ConnectionReader(const std::string& file, const toml::table& table)
      : file_(file), table_(table) {}

  Result<MachineOptions> read();

 private:
  void fail(const toml::node* node, const std::string& message) {
    const auto line = node == nullptr ? table_.source().begin.line : node->source().begin.line;
    if (!error_)
      error_ = Error{ErrorCode::ConfigInvalid, fmt::format("{}:{}: {}", file_, line, message)};
  }
  std::string text(std::string_view key, bool is_needed);
  std::vector<std::string> texts(std::string_view key);
  void check_keys();
  void read_address();
  void read_paths();
  void read_patterns();
  void read_interval();

  const std::string& file_;
  const toml::table& table_;
  std::optional<Error> error_;
  MachineOptions machine_;
};

std::string ConnectionReader::text(std::string_view key, bool is_needed) {
  const toml::node* const node = table_.get(key);
  if (node == nullptr) {
    if (is_needed) fail(nullptr, fmt::format("a connection needs {}", key));
    return {};
  }
  const auto value = node->value_exact<std::string>();
  if (!value) fail(node, fmt::format("{} must be a text", key));
  return value.value_or("");
}

std::vector<std::string> ConnectionReader::texts(std::string_view key) {
  std::vector<std::string> items;
  const toml::node* const node = table_.get(key);
  if (node == nullptr) return items;
  const toml::array* const array = node->as_array();
  if (array == nullptr) {
    fail(node, fmt::format("{} must be a list of texts", key));
    return items;
  }
  for (const toml::node& item : *array) {
    if (const auto value = item.value_exact<std::string>()) {
      items.push_back(*value);
    } else {
      fail(&item, fmt::format("{} must be a list of texts", key));
    }
  }
  return items;
}

void ConnectionReader::check_keys() {
  constexpr std::string_view kKeys[] = {"name",    "kind",       "address", "paths",
                                        "machine", "interval_s", "patterns"};
  for (const auto& [key, node] : table_) {
    if (std::find(std::begin(kKeys), std::end(kKeys), key.str()) == std::end(kKeys)) {
      fail(&node, fmt::format("unknown key '{}' of a connection", key.str()));
    }
  }
}

void ConnectionReader::read_address() {
  const std::string address = text("address", true);
  const auto parsed = control_link::parse_control_address(address);
  if (parsed) {
    machine_.address = *parsed;
  } else {
    fail(table_.get("address"), fmt::format("'{}' is no HOST or HOST:PORT", address));
  }
}

void ConnectionReader::read_paths() {
  for (const std::string& path : texts("paths")) {
    auto watched = collector::parse_watched_path(path);
    if (watched) {
      machine_.paths.push_back(*std::move(watched));
    } else {
      fail(table_.get("paths"), watched.error().message);
    }
  }
  if (machine_.paths.empty())
    fail(nullptr, "a connection needs paths, such as TNC:\\nc_prog\\TCHPR*.TXT");
}

void ConnectionReader::read_patterns() {
  for (const std::string& name : texts("patterns")) {
    const auto path = std::filesystem::path(file_).parent_path() / name;
    std::ifstream file(path, std::ios::binary);
    const std::string content{std::istreambuf_iterator<char>(file), {}};
    if (!file) {
      fail(table_.get("patterns"), fmt::format("cannot read the pattern file {}", path.string()));
      continue;
    }
    auto pattern = log_reader::Pattern::parse(content);
    if (pattern) {
      machine_.patterns.push_back({name, *std::move(pattern)});
    } else {
      fail(table_.get("patterns"), fmt::format("{}: {}", path.string(), pattern.error().message));
    }
  }
}

void ConnectionReader::read_interval() {
  const toml::node* const node = table_.get("interval_s");
  if (node == nullptr) return;
  const auto seconds = node->value_exact<std::int64_t>();
  if (!seconds || *seconds < kLeastInterval || *seconds > kMostInterval) {
    fail(node, fmt::format("interval_s must be a whole number from {} to {}", kLeastInterval,
                           kMostInterval));
    return;
  }
  machine_.interval = std::chrono::seconds(*seconds);
}

Result<MachineOptions> ConnectionReader::read() {
  check_keys();
  machine_.name = text("name", true);
  const bool is_name = !machine_.name.empty() && machine_.name.size() <= 63 &&
                       std::all_of(machine_.name.begin(), machine_.name.end(), [](char c) {
                         return is_ascii_alphanumeric(c) || c == '-' || c == '_';
                       });
  if (!is_name) {
    fail(table_.get("name"), "the name of a connection has 1 to 63 letters, digits, - and _");
  }
  if (text("kind", true) != "lsv2") fail(table_.get("kind"), "the kind of a connection is lsv2");
  machine_.machine = text("machine", false);
  if (machine_.machine.empty()) machine_.machine = machine_.name;
  read_address();
  read_paths();
  read_patterns();
  read_interval();
  if (error_) return *error_;
  return std::move(machine_);
}

}  // namespace

Result<std::vector<MachineOptions>> read_connections(const std::string& path) {
  std::vector<MachineOptions> machines;
  if (path.empty()) return machines;
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
      auto machine = ConnectionReader(path, *table).read();
      if (!machine) return machine.error();
      if (!names.insert(ascii_lower(machine->name)).second) {
        return invalid(item.source().begin.line,
                       fmt::format("the connection '{}' comes twice", machine->name));
      }
      machines.push_back(*std::move(machine));
    }
  }
  if (machines.size() > kMostConnections) {
    return invalid(1, fmt::format("more than {} connections", kMostConnections));
  }
  return machines;
}

Result<std::unique_ptr<collector::Collector>> start_collector(const Config& config,
                                                              app::Application& app,
                                                              const Clock& clock) {
  auto machines = read_connections(config.connections);
  if (!machines) return machines.error();
  return std::make_unique<collector::Collector>(
      *std::move(machines), app, clock,
      collector::CollectorHooks{
          .failed =
              [](std::string_view name, std::string_view why) {
                log_warning("connection_failing", fmt::format("{}: {}", name, why));
              },
          .recovered = [](std::string_view name) { log_info("connection_recovered", name); },
          .unread =
              [](std::string_view name, std::string_view path, std::string_view why) {
                log_warning("log_not_understood",
                            fmt::format("{}: {}: {}; the file is kept whole", name, path, why));
              }});
}

}  // namespace fitgauge::daemon
