#pragma once

namespace fitgauge::daemon {

/// Everything that can be set from outside. Defaults < TOML file < FITGAUGE_* environment < flags;
/// the table in config.cpp names each setting once for all of them.
struct Config {
  std::vector<std::string> listen{"127.0.0.1:8286"};
  std::string data = "data";
  std::string database;
  std::string auth = "default";
  std::vector<std::string> allow_origin;
  std::string admin_key_file;
  std::string admin_key_out;
  std::string tls_cert;
  std::string tls_key;
  std::string tls_client_ca;
  std::string log_level = "info";
  std::string origin_name = "station";
  std::string durability = "group";
  std::int64_t io_threads = 1;
  std::int64_t reader_threads = 2;
  std::int64_t run_workers = 2;
  std::int64_t max_connections = 4096;
  std::int64_t write_queue = 4096;
  std::int64_t idempotency_days = 30;
  std::int64_t run_retention_days = 90;
  std::int64_t event_retention = 100'000;
  std::string control_listen;
  std::string control_model = "TNC640";
  std::string control_setup;
  bool control_write = false;
  std::string shdr_listen;
  std::string connections;
  std::vector<std::string> connection_folders;
  bool allow_private_addresses = false;
  std::string certificate_logo;
  std::string certificate_address;
  std::string forward_to;
  std::string forward_key_file;
  std::string forward_ca;
  bool forward_insecure = false;
};

/// An error of the configuration.
inline Error config_error(std::string message) {
  return {ErrorCode::ConfigInvalid, std::move(message)};
}
template <class... Arguments>
Error config_error(fmt::format_string<Arguments...> format,
                   Arguments&&... arguments) requires(sizeof...(Arguments) > 0) {
  return config_error(fmt::format(format, std::forward<Arguments>(arguments)...));
}

/// One setting: its place in Config, its names and its documentation.
struct Setting {
  Setting(std::string_view called, std::string_view kind_, std::string_view meaning,
          std::vector<std::string> Config::*to)
      : name(called), help(meaning), texts(to), kind(kind_) {}
  Setting(std::string_view called, std::string_view kind_, std::string_view meaning,
          std::string Config::*to, std::vector<std::string_view> only = {})
      : name(called), help(meaning), text(to), kind(kind_), words(std::move(only)) {}
  Setting(std::string_view called, std::string_view meaning, bool Config::*to)
      : name(called), help(meaning), flag(to) {}
  Setting(std::string_view called, std::string_view meaning, std::int64_t Config::*to,
          std::int64_t from, std::int64_t up_to)
      : name(called), help(meaning), integer(to), least(from), most(up_to) {}

  std::string_view name;  ///< `io-threads`: the flag; `io_threads` in TOML, FITGAUGE_IO_THREADS
  std::string_view help;
  std::vector<std::string> Config::*texts = nullptr;
  std::string Config::*text = nullptr;
  std::int64_t Config::*integer = nullptr;
  bool Config::*flag = nullptr;      ///< on the command line without a value
  std::string_view kind = "NUMBER";  ///< of its values, in the help: FILE, HOST:PORT, …
  std::int64_t least = 0;
  std::int64_t most = 0;
  std::vector<std::string_view> words{};  ///< the values a text may have, if they are few
};

const std::vector<Setting>& settings();

/// The default of a setting in words; empty if it has none, or is off.
std::string default_text(const Setting& setting);

/// The help of a setting with its range or words: `… (1 to 64)`, `… (group, each, off)`.
std::string help_text(const Setting& setting);

/// `io-threads` as a TOML key: `io_threads`.
std::string toml_key(const Setting& setting);
/// `io-threads` as an environment variable: `FITGAUGE_IO_THREADS`.
std::string environment_name(const Setting& setting);

/// Reads a TOML file into `config`.
/// @errors ConfigInvalid with file, line and key: unreadable, unknown, wrong type or range.
Result<void> read_toml(const std::string& path, Config& config);

/// Reads the variables of `environment` ("NAME=value") that begin with FITGAUGE_.
/// @errors ConfigInvalid for an unknown name or a value out of range.
Result<void> read_environment(const std::vector<std::string>& environment, Config& config);

/// Sets one setting from text; a list has comma-separated items.
Result<void> assign(const Setting& setting, std::string_view text, Config& config);

/// Checks across settings, such as a certificate without a key.
Result<void> check(const Config& config);

/// Returns the whole configuration as TOML, which reads back equal.
std::string to_toml(const Config& config);

}  // namespace fitgauge::daemon
