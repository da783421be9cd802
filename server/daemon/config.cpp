#include "daemon/parts.hpp"

#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "base/folder.hpp"
#include "service/log/log_keys.hpp"

namespace fitgauge::daemon {
namespace {

constexpr std::string_view kPrefix = "FITGAUGE_";
/// Read by the clients or by the service itself, not a setting of the daemon.
constexpr std::string_view kOtherVariables[] = {"FITGAUGE_SERVER", "FITGAUGE_KEY",
                                                "FITGAUGE_CONFIG"};

const Setting* find(std::string_view name, std::string (*spelling)(const Setting&)) {
  const auto& all = settings();
  const auto found =
      std::ranges::find_if(all, [&](const Setting& setting) { return spelling(setting) == name; });
  return found == all.end() ? nullptr : &*found;
}

std::string known(std::string (*spelling)(const Setting&)) {
  std::vector<std::string> names;
  for (const Setting& setting : settings()) names.push_back(spelling(setting));
  return fmt::format("{}", fmt::join(names, ", "));
}

std::vector<std::string> split_list(std::string_view text) {
  std::vector<std::string> items;
  while (!text.empty()) {
    const std::string_view item = trim(take_field(text, ','));
    if (!item.empty()) items.emplace_back(item);
  }
  return items;
}

std::vector<std::string_view> model_names() {
  std::vector<std::string_view> names;
  for (const auto& model : virtual_control::control_models()) names.push_back(model.name);
  return names;
}

/// A TOML value as the text for `assign`; an array of strings becomes a list.
Result<std::string> text_of(const Setting& setting, const toml::node& node) {
  if (setting.integer != nullptr) {
    if (const auto value = node.value_exact<std::int64_t>()) return std::to_string(*value);
    return config_error("{} must be a whole number", toml_key(setting));
  }
  if (setting.flag != nullptr) {
    if (const auto value = node.value_exact<bool>()) return *value ? "true" : "false";
    return config_error("{} must be true or false", toml_key(setting));
  }
  if (const auto value = node.value_exact<std::string>()) return *value;
  const toml::array* items = node.as_array();
  if (setting.texts == nullptr || items == nullptr)
    return config_error("{} must be a string", toml_key(setting));
  std::vector<std::string> texts;
  for (const toml::node& item : *items) {
    const auto text = item.value_exact<std::string>();
    if (!text) return config_error("{} must be a list of strings", toml_key(setting));
    texts.push_back(*text);
  }
  return fmt::format("{}", fmt::join(texts, ","));
}

std::string toml_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out += '"';
}

/// `scheme://host` or `scheme://host:port`, as browsers send it.
bool is_origin(std::string_view text) {
  const std::size_t end = text.find("://");
  if (end == 0 || end == std::string_view::npos || text.size() == end + 3) return false;
  const auto is_part = [](std::string_view part, std::string_view others) {
    return std::ranges::all_of(part, [&](char c) {
      return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || others.find(c) != others.npos;
    });
  };
  return is_part(text.substr(0, end), "+-.") && is_part(text.substr(end + 3), "-.:[]_");
}

/// Settings that daemons with a shared database cannot have.
Result<void> check_database(const Config& config) {
  if (config.database.empty()) return {};
  if (!config.database.starts_with("postgresql://") &&
      !config.database.starts_with("postgres://")) {
    return config_error("database must be an address such as postgresql://user@host:5432/name");
  }
  if (!config.forward_to.empty()) {
    return config_error(
        "forward-to needs a data folder: with PostgreSQL (database) the service is a centre; use a "
        "standby of PostgreSQL for a copy");
  }
  if (!config.connections.empty()) {
    return config_error(
        "connections need a data folder: with a shared database each service would repeat the "
        "work");
  }
  return {};
}

}  // namespace

const std::vector<Setting>& settings() {
  static const std::vector<Setting> kSettings = {
      {"listen", "HOST:PORT", "Addresses to listen on, as host:port; port 0 chooses a free port",
       &Config::listen},
      {"data", "FOLDER", "Folder of the database", &Config::data},
      {"database", "URL",
       "PostgreSQL database that services share, as postgresql://host/name; empty: a file in data",
       &Config::database},
      {"origin-name", "NAME",
       "Name of the measurement log, such as plant-3/press-7; accepted while the log is empty",
       &Config::origin_name},
      {"auth",
       "WORD",
       "Requests that need a key; default chooses open on loopback addresses, else read-open",
       &Config::auth,
       {"default", "open", "read-open", "keys"}},
      {"allow-origin", "URL",
       "Web origins that may use the service, such as https://mes.example; their writes need a key",
       &Config::allow_origin},
      {"admin-key-file", "FILE", "File to read the first administrator's key from",
       &Config::admin_key_file},
      {"admin-key-out", "FILE",
       "File to write the first administrator's key to; empty: admin.key in the data folder",
       &Config::admin_key_out},
      {"tls-cert", "FILE", "Certificate chain (PEM)", &Config::tls_cert},
      {"tls-key", "FILE", "Private key of the certificate (PEM)", &Config::tls_key},
      {"tls-client-ca", "FILE",
       "CA certificates of the clients (PEM); each client then needs a certificate",
       &Config::tls_client_ca},
      {"log-level",
       "WORD",
       "Lowest level of log lines",
       &Config::log_level,
       {"debug", "info", "warning", "error", "off"}},
      {"durability",
       "WORD",
       "group: one commit for all waiting requests; each: one commit a request; off: no fsync, for "
       "tests",
       &Config::durability,
       {"group", "each", "off"}},
      {"io-threads", "Threads that serve connections", &Config::io_threads, 1, 64},
      {"reader-threads", "Threads that read the database", &Config::reader_threads, 1, 64},
      {"run-workers", "NC programs that run at the same time", &Config::run_workers, 1, 64},
      {"max-connections", "Connections served at the same time", &Config::max_connections, 1,
       100'000},
      {"write-queue", "Writes that may wait for the disk; further writes get 503",
       &Config::write_queue, 1, 1'000'000},
      {"idempotency-days", "Days that an idempotency key is kept", &Config::idempotency_days, 1,
       3650},
      {"run-retention-days",
       "Days that a run, its trace and its files are kept; 0 keeps them for ever",
       &Config::run_retention_days, 0, 36500},
      {"event-retention", "Events kept for readers that reconnect", &Config::event_retention, 100,
       10'000'000},
      {"control-listen", "HOST:PORT",
       "Address of a virtual control (LSV-2), as host:port; empty: none", &Config::control_listen},
      {"control-model", "NAME", "Model of the virtual control", &Config::control_model,
       model_names()},
      {"control-setup", "NAME", "Stored setup of the virtual control; empty: the default machine",
       &Config::control_setup},
      {"control-write", "Allow clients of the virtual control to change files and start programs",
       &Config::control_write},
      {"shdr-listen", "HOST:PORT",
       "Address of the SHDR lines for MTConnect agents, as host:port; empty: none",
       &Config::shdr_listen},
      {"connections", "FILE",
       "TOML file with connections to controls, folders and receivers; empty: none",
       &Config::connections},
      {"connection-folders", "FOLDER",
       "Folders that connections made over HTTP may use; empty: none", &Config::connection_folders},
      {"allow-private-addresses",
       "Allow webhooks to addresses of this machine and of private networks",
       &Config::allow_private_addresses},
      {"certificate-logo", "FILE", "PNG file with the logo of inspection reports; empty: none",
       &Config::certificate_logo},
      {"certificate-address", "TEXT", "Address on inspection reports; a semicolon ends a line",
       &Config::certificate_address},
      {"forward-to", "URL",
       "Centre that receives a copy of the measurement log, as https://host:port; empty: none",
       &Config::forward_to},
      {"forward-key-file", "FILE", "File with the API key of this station at the centre",
       &Config::forward_key_file},
      {"forward-ca", "FILE", "CA certificates for the centre (PEM); empty: those of the system",
       &Config::forward_ca},
      {"forward-insecure", "Allow http:// to a centre on another machine",
       &Config::forward_insecure},
  };
  return kSettings;
}

std::string default_text(const Setting& setting) {
  static const Config kDefaults{};
  if (setting.integer != nullptr) return std::to_string(kDefaults.*setting.integer);
  if (setting.flag != nullptr) return kDefaults.*setting.flag ? "true" : "";
  if (setting.texts == nullptr) return kDefaults.*setting.text;
  return fmt::format("{}", fmt::join(kDefaults.*setting.texts, ", "));
}

std::string help_text(const Setting& setting) {
  if (setting.integer != nullptr)
    return fmt::format("{} ({} to {})", setting.help, setting.least, setting.most);
  if (setting.words.empty()) return std::string(setting.help);
  return fmt::format("{} ({})", setting.help, fmt::join(setting.words, ", "));
}

std::string toml_key(const Setting& setting) {
  std::string key(setting.name);
  std::ranges::replace(key, '-', '_');
  return key;
}

std::string environment_name(const Setting& setting) {
  return std::string(kPrefix) + ascii_upper(toml_key(setting));
}

Result<void> assign(const Setting& setting, std::string_view text, Config& config) {
  const auto& words = setting.words;
  if (setting.integer != nullptr) {
    const auto value = read_number<std::int64_t>(text);
    if (!value || *value < setting.least || *value > setting.most) {
      return config_error("{} must be a whole number from {} to {}; got '{}'", setting.name,
                          setting.least, setting.most, text);
    }
    config.*setting.integer = *value;
  } else if (setting.flag != nullptr) {
    if (text != "true" && text != "false")
      return config_error("{} must be true or false; got '{}'", setting.name, text);
    config.*setting.flag = text == "true";
  } else if (setting.texts != nullptr) {
    config.*setting.texts = split_list(text);
  } else if (!words.empty() && std::ranges::find(words, text) == words.end()) {
    return config_error("{} must be one of: {}; got '{}'", setting.name, fmt::join(words, ", "),
                        text);
  } else {
    config.*setting.text = text;
  }
  return {};
}

Result<void> read_toml(const std::string& path, Config& config) {
  const auto content = read_regular(path);
  if (!content) return config_error("cannot read {}: {}", path, content.error().message);
  toml::table file;
  try {
    file = toml::parse(*content, path);
  } catch (const toml::parse_error& error) {
    return config_error("{}:{}: {}", path, error.source().begin.line, error.description());
  }
  for (const auto& [key, node] : file) {
    const auto place = [&, &key = key](const std::string& message) {
      return config_error("{}:{}: {}", path, key.source().begin.line, message);
    };
    const Setting* setting = find(key.str(), toml_key);
    if (setting == nullptr)
      return place(fmt::format("unknown key '{}'; known keys: {}", key.str(), known(toml_key)));
    const auto text = text_of(*setting, node);
    if (!text) return place(text.error().message);
    if (const auto assigned = assign(*setting, *text, config); !assigned)
      return place(assigned.error().message);
  }
  return {};
}

Result<void> read_environment(const std::vector<std::string>& environment, Config& config) {
  for (const std::string& variable : environment) {
    const std::size_t equals = variable.find('=');
    const std::string_view name = std::string_view(variable).substr(0, equals);
    if (equals == std::string::npos || !name.starts_with(kPrefix)) continue;
    if (std::ranges::find(kOtherVariables, name) != std::end(kOtherVariables)) continue;
    const Setting* setting = find(name, environment_name);
    if (setting == nullptr) {
      return config_error("unknown environment variable {}; known variables: {}", name,
                          known(environment_name));
    }
    const auto assigned = assign(*setting, std::string_view(variable).substr(equals + 1), config);
    if (!assigned) return config_error("{}: {}", name, assigned.error().message);
  }
  return {};
}

Result<void> check(const Config& config) {
  if (config.listen.empty())
    return config_error("listen needs at least one address such as 127.0.0.1:8286");
  if (config.data.empty()) return config_error("data must be the folder of the database");
  if (!app::is_origin_name(config.origin_name)) {
    return config_error(
        "origin-name must have 1 to 64 lower-case letters, digits, '.', '/' and '-', "
        "and begin with a letter or digit; got '{}'",
        config.origin_name);
  }
  for (const std::string& origin : config.allow_origin) {
    if (!is_origin(origin)) {
      return config_error(
          "allow-origin must be an origin as https://mes.example:8443, in "
          "lower case and without a path; got '{}'",
          origin);
    }
  }
  if (config.tls_cert.empty() != config.tls_key.empty())
    return config_error("tls-cert and tls-key belong together: give both or neither");
  if (!config.tls_client_ca.empty() && config.tls_cert.empty())
    return config_error("tls-client-ca needs tls-cert and tls-key");
  TRY(check_database(config));
  if (!is_utf8(config.certificate_address))
    return config_error("certificate-address must be UTF-8");
  TRY(certificate::read_letterhead(config.certificate_address, config.certificate_logo));
  return check_forwarding(config);
}

std::string to_toml(const Config& config) {
  std::string out;
  for (const Setting& setting : settings()) {
    out += fmt::format("# {}\n{} = ", help_text(setting), toml_key(setting));
    if (setting.integer != nullptr) {
      out += std::to_string(config.*setting.integer);
    } else if (setting.flag != nullptr) {
      out += config.*setting.flag ? "true" : "false";
    } else if (setting.texts != nullptr) {
      std::vector<std::string> items;
      for (const std::string& item : config.*setting.texts) items.push_back(toml_string(item));
      out += fmt::format("[{}]", fmt::join(items, ", "));
    } else {
      out += toml_string(config.*setting.text);
    }
    out += '\n';
  }
  return out;
}

}  // namespace fitgauge::daemon
