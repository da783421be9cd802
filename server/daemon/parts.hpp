#pragma once

#include <signal.h>
#include <filesystem>

#include "api/service/metrics.hpp"
#include "plant/centre/forwarder.hpp"
#include "plant/connections.hpp"
#include "plant/mtconnect/shdr_adapter.hpp"
#include "plant/virtual_control/virtual_control.hpp"
#include "service/application.hpp"

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

/// Makes the C library of the process map each large block and return it to the kernel when it is
/// freed. By default it keeps later blocks of that size: a run of 48 MiB would leave them
/// allocated. Buffers of OpenSSL begin at a page: a handshake uses only some pages of them, and
/// the others take no memory then. Called before anything uses OpenSSL.
void set_up_allocation();

/// Raises the soft limit of open files, to the hard limit at most, so that `connections` can be
/// open in addition to the files of the database and the log. Shells and systemd begin with 1024.
/// @returns how many connections can be open then.
std::int64_t allow_connections(std::int64_t connections);

/// Returns the addresses of `listen`. @errors ConfigInvalid naming the malformed one.
Result<std::vector<http::ListenAddress>> listen_addresses(const Config& config);

/// The TLS settings of the server; none without a certificate.
std::optional<http::TlsOptions> tls_options(const Config& config);

/// Whether a start with this configuration would get as far as the database, as things are now:
/// every address is one of this machine, certificates and keys can be used and belong together, the
/// administrator's key is one, the data folder and the port file can be written. Changes nothing. A
/// port that is in use passes: the service itself may be running.
/// @errors ConfigInvalid, ListenFailed, StorageUnavailable: the first that is found.
Result<void> preflight(const Config& config, const std::string& port_file);

/// Returns the first line of the file, without surrounding blanks.
/// @errors ConfigInvalid with the file: it cannot be read, or has no key.
Result<std::string> read_admin_key(const std::string& file);

/// The file that receives the administrator's key of the first start.
std::string admin_key_out(const Config& config);

/// Prepares the administrator's key at a start. With a file, its key becomes valid, and the key of
/// an earlier file is revoked and logged. Without a file the first start that `needs_one` creates a
/// key and writes it to admin_key_out() with mode 0600; the log has the path. A revoked key stays
/// revoked.
/// @errors ConfigInvalid, and those of the storage.
Result<void> provide_admin_key(const Config& config, bool needs_one, app::KeyService& keys);

/// The signals that the main thread waits for; blocked in every other thread.
sigset_t waited_signals();

/// Waits a second for SIGTERM or SIGINT. @returns whether the service is to end.
bool is_to_end_after_a_second();

/// Writes the port in decimal to a temporary file and renames it: others read whole numbers.
/// @errors ConfigInvalid
Result<void> write_port_file(const std::string& path, std::uint16_t port);

/// Opens the application. While a database server is unreachable it tries again each second;
/// meanwhile `/livez` returns 200 at the addresses, and every other path 503.
/// @param server its addresses receive the actual ports.
/// @returns null if a signal ended the wait. @errors those of Application::open() and of listening.
Result<std::unique_ptr<app::Application>> open_or_wait(const app::ApplicationOptions& options,
                                                       const Clock& clock,
                                                       http::ServerOptions& server,
                                                       const std::string& port_file);

/// Opens the LSV-2 port of the configuration; null if it has none. The control must be destroyed
/// before `services`. @errors as start_virtual_control.
Result<std::unique_ptr<virtual_control::VirtualControl>> start_control(
    const Config& config, const api::Services& services);

/// Opens the SHDR port of the configuration; null if it has none. The adapter must be destroyed
/// before `services`. @errors as ShdrAdapter::start.
Result<std::unique_ptr<mtconnect::ShdrAdapter>> start_shdr(const Config& config,
                                                           const api::Services& services);

/// Reads the file of the connections; none for an empty path. Names of pattern files are relative
/// to its folder. @errors ConfigInvalid with file, line and key.
Result<std::vector<connections::Definition>> read_connections(const std::string& path);

/// Starts the connections; they must be destroyed before `app`. @errors as read_connections; those
/// of the storage.
Result<std::unique_ptr<connections::Connections>> start_connections(const Config& config,
                                                                    app::Application& app,
                                                                    const Clock& clock,
                                                                    const api::GaugesInUse& gauges);

/// Whether the settings of forwarding go together.
/// @errors ConfigInvalid: no centre's address, http:// beyond this machine, an unreadable key.
Result<void> check_forwarding(const Config& config);

/// Returns the centre's state of a history; none without a response within some seconds.
std::optional<app::AtCentre> ask_centre(const Config& config, std::string_view digits);

/// Starts to forward the log to the centre; null when there is none.
std::unique_ptr<forwarder::Forwarder> start_forwarder(const Config& config, app::Application& app,
                                                      forwarder::Tell tell);
/// Writes to the log of the service.
void tell_log(std::string_view event, const std::string& detail);

/// Writes number and age of records that the centre lacks. @param forwarder may be null.
void write_outbox_metrics(const forwarder::Forwarder* forwarder, const Clock& clock,
                          api::Exposition& out);

// Families of /metrics, read at each scrape. None waits for anything but the kernel.

void write_server_metrics(const http::Server& server, api::Exposition& out);
void write_application_metrics(app::Application& app, api::Exposition& out);
/// Writes the lead of `clock` over `machine`, the system's clock, after that was set back.
void write_clock_metrics(const Clock& clock, const Clock& machine, api::Exposition& out);
/// The database's files and free space, or the state of its server.
void write_storage_metrics(const app::Application& app, const std::filesystem::path& folder,
                           api::Exposition& out);
/// Writes `process_*` with the names of Prometheus' own clients, and the lost lines of the log.
void write_process_metrics(api::Exposition& out);

/// Writes the metrics of every connection, by its name.
void write_connection_metrics(const std::vector<connections::ConnectionState>& connections,
                              const Clock& clock, api::Exposition& out);

// The commands of fitgauged, with or without a running service. Each prints its result and returns
// the exit code; the caller prints an error.

/// `fitgauged backup FILE`
Result<int> run_backup(const Config& config, const std::string& file);
/// `fitgauged verify`: 1 if there are findings. @param checkpoints files from another place.
Result<int> run_verify(const Config& config, const std::vector<std::string>& checkpoints);
/// `fitgauged qualify`: compares the figures of this program with published ones, and writes
/// qualification.json and qualification.pdf to the folder; 1 when one differs.
/// @param signs whether the data folder's log key signs both, in qualification.note.
Result<int> run_qualify(const Config& config, const std::string& folder, bool signs);
/// `fitgauged log-key`: the log gets a new key, which signs from the next start on.
Result<int> run_log_key(const Config& config);
/// `fitgauged key create|revoke|list`. @param expires RFC 3339; none: never.
Result<int> run_key_create(const Config& config, const std::string& name, const std::string& role,
                           const std::optional<std::string>& expires);
Result<int> run_key_revoke(const Config& config, const std::string& name);
Result<int> run_key_list(const Config& config);

/// File with the port on 127.0.0.1 for health checks, if clients need certificates.
std::filesystem::path health_port_file(const Config& config);

/// Requests /readyz of the service with this configuration, as a health check of a container does
/// without curl.
/// @errors NotReady with the reason: no connection, no answer in 3 s, or a status other than 200.
Result<void> healthcheck(const Config& config);

/// Runs the service until SIGTERM or SIGINT; SIGHUP reads the certificates again.
/// @param port_file receives the first port, in decimal, when the socket listens; may be empty.
/// @errors those of opening the database and of listening.
Result<void> serve(const Config& config, const std::string& port_file);

inline app::ApplicationOptions application_options(const Config& config) {
  app::ApplicationOptions options;
  options.directory = config.data;
  options.address = config.database;
  if (config.durability == "off") options.synchronous = store::Synchronous::Off;
  options.commit_each = config.durability == "each";
  options.queue_limit = static_cast<std::size_t>(config.write_queue);
  options.readers = static_cast<unsigned>(config.reader_threads);
  options.run_workers = static_cast<unsigned>(config.run_workers);
  options.idempotency_retention = std::chrono::days(config.idempotency_days);
  constexpr std::int64_t kForEver = 100'000;
  options.run_retention =
      std::chrono::days(config.run_retention_days == 0 ? kForEver : config.run_retention_days);
  options.event_retention = config.event_retention;
  options.keeps_newest_run = !config.control_listen.empty();
  options.origin_name = config.origin_name;
  options.has_centre = !config.forward_to.empty();
  return options;
}

}  // namespace fitgauge::daemon
