#include "daemon/parts.hpp"

#include <malloc.h>
#include <openssl/crypto.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

#include "api/runs/run_posting.hpp"
#include "base/folder.hpp"
#include "daemon/log.hpp"
#include "db/store/database.hpp"

namespace fitgauge::daemon {
namespace {

/// The bodies of usual requests are smaller and pay nothing.
constexpr int kLargeBlock = 1 << 20;
/// Number of arenas that the C library allows by default. It would count the processors in the
/// middle of a run, and open a file for that.
constexpr long kArenasOfAProcessor = 8;
constexpr std::size_t kPage = 4096;
constexpr std::size_t kTlsRecord = 16'384;

/// For the database with its readers, the listeners, timers and the log.
constexpr rlim_t kOtherFiles = 256;

namespace fs = std::filesystem;

/// An existing folder, or its nearest existing parent, in which the missing ones will be created.
fs::path nearest_existing(fs::path folder) {
  std::error_code ignored;
  folder = fs::absolute(folder, ignored);
  while (!fs::exists(folder, ignored) && folder.has_relative_path()) folder = folder.parent_path();
  return folder;
}

/// Whether files can be made in `folder`. `what` names the setting.
Result<void> check_folder(const std::string& what, const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored))
    return config_error("{}: {} is not a folder", what, folder.string());
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    return config_error("{}: cannot write to {}: {}", what, folder.string(), std::strerror(errno));
  return {};
}

/// Whether a file can be made there. `what` names the setting.
Result<void> check_file(const std::string& what, const fs::path& file) {
  std::error_code ignored;
  if (file.empty()) return {};
  if (fs::is_directory(file, ignored))
    return config_error("{}: {} is a folder", what, file.string());
  return check_folder(what, file.has_parent_path() ? file.parent_path() : fs::path("."));
}

/// The name of the key that the start makes.
constexpr const char* kName = "admin";

bool is_valid(const store::ApiKey& key) { return !key.revoked_at_ns; }

Result<void> take_key_of_file(const std::string& file, const std::vector<store::ApiKey>& known,
                              app::KeyService& keys) {
  const auto token = TRY(read_admin_key(file));
  if (keys.find(token)) return {};
  const bool replaces = std::ranges::any_of(
      known, [](const store::ApiKey& key) { return is_valid(key) && key.name == kName; });
  const auto taken =
      replaces ? keys.replace(kName, token) : keys.create(kName, app::Role::Admin, token);
  if (!taken && taken.error().where == "token") {
    log_warning("admin_key_refused",
                fmt::format("the key in {} was revoked: put a new key into the file", file));
    return {};
  }
  if (!taken) return config_error("admin-key-file {}: {}", file, taken.error().message);
  if (replaces) {
    log_warning("admin_key_replaced",
                fmt::format("the key in {} is valid now, and the old key is revoked", file));
  } else {
    log_info("admin_key_taken", fmt::format("the key in {} is valid", file));
  }
  return {};
}

/// For OpenSSL: its buffers begin at a page.
void* allocate(std::size_t size) {
  const bool is_buffer = size == kPage || (size > kTlsRecord && size < 2 * kTlsRecord);
  return is_buffer ? memalign(kPage, size) : std::malloc(size);
}

using Opened = Result<std::unique_ptr<app::Application>>;

Result<std::unique_ptr<http::Server>> start_waiting_server(const http::ServerOptions& options,
                                                           const std::string& why) {
  std::vector<http::Route> routes;
  const auto live = [](const http::Request&) -> Result<http::Response> {
    return http::Response(200, "application/json", std::string(R"({"status":"live"})"));
  };
  routes.push_back({.pattern = "/livez", .handler = live});
  http::ServerHooks hooks;
  hooks.format_error = [why](const Error&, std::optional<int>, const http::Request& request) {
    return api::problem(
        {ErrorCode::StorageUnavailable, "the service waits for its database: " + why}, std::nullopt,
        request);
  };
  return http::Server::start(options, http::RouteTable(std::move(routes)), std::move(hooks));
}

/// A setup that is not there yet, or no more, is no reason not to start.
machine::Setup machine_of(const Config& config, const api::Services& services) {
  auto setup = api::machine_of_setup(services, config.control_setup);
  if (setup) return *std::move(setup);
  log_warning("control_setup_unusable",
              fmt::format("setup '{}': {}; the control shows the default machine until a restart",
                          config.control_setup, setup.error().message));
  return {};
}

}  // namespace

void set_up_allocation() {
  mallopt(M_MMAP_THRESHOLD, kLargeBlock);
  mallopt(M_ARENA_MAX, static_cast<int>(kArenasOfAProcessor * sysconf(_SC_NPROCESSORS_ONLN)));
  CRYPTO_set_mem_functions([](std::size_t size, const char*, int) { return allocate(size); },
                           [](void* block, std::size_t size, const char*, int) {
                             return block == nullptr ? allocate(size) : std::realloc(block, size);
                           },
                           [](void* block, const char*, int) { std::free(block); });
}

std::int64_t allow_connections(std::int64_t connections) {
  const rlim_t needed = static_cast<rlim_t>(connections) + kOtherFiles;
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return connections;
  if (limit.rlim_cur < needed) {
    // RLIM_INFINITY is the largest value there is.
    rlimit raised = limit;
    raised.rlim_cur = std::min(needed, limit.rlim_max);
    if (setrlimit(RLIMIT_NOFILE, &raised) == 0) limit = raised;
  }
  if (limit.rlim_cur >= needed) return connections;
  const rlim_t left = limit.rlim_cur > kOtherFiles ? limit.rlim_cur - kOtherFiles : 1;
  return static_cast<std::int64_t>(std::min(left, static_cast<rlim_t>(connections)));
}

Result<std::vector<http::ListenAddress>> listen_addresses(const Config& config) {
  std::vector<http::ListenAddress> addresses;
  for (const std::string& text : config.listen) {
    auto address = TRY(http::parse_listen_address(text));
    addresses.push_back(std::move(address));
  }
  return addresses;
}

std::optional<http::TlsOptions> tls_options(const Config& config) {
  if (config.tls_cert.empty()) return std::nullopt;
  return http::TlsOptions{.certificate_file = config.tls_cert,
                          .key_file = config.tls_key,
                          .client_ca_file = config.tls_client_ca,
                          .require_client_certificate = !config.tls_client_ca.empty()};
}

Result<void> preflight(const Config& config, const std::string& port_file) {
  const auto addresses = TRY(listen_addresses(config));
  for (const http::ListenAddress& address : addresses) TRY(http::check_listen(address));
  for (const std::string& text : {config.control_listen, config.shdr_listen}) {
    if (text.empty()) continue;
    const auto address = TRY(http::parse_listen_address(text));
    TRY(http::check_listen(address));
  }
  TRY(read_connections(config.connections));
  if (const auto tls = tls_options(config)) TRY(http::check_tls(*tls));
  if (!config.admin_key_file.empty()) TRY(read_admin_key(config.admin_key_file));
  if (!config.database.empty()) TRY(store::postgres::check_server(config.database));
  TRY(check_folder("data", nearest_existing(config.data)));
  TRY(check_file("admin-key-out", config.admin_key_out));
  return check_file("port-file", port_file);
}

std::string admin_key_out(const Config& config) {
  return config.admin_key_out.empty() ? std::filesystem::path(config.data) / "admin.key"
                                      : std::filesystem::path(config.admin_key_out);
}

Result<std::string> read_admin_key(const std::string& file) {
  const auto text = read_regular(file);
  std::string token(text ? trim(text->substr(0, text->find('\n'))) : "");
  if (token.size() >= app::kShortestToken) return token;
  const auto invalid = [&](const std::string& what) {
    return config_error("admin-key-file {} {}", file, what);
  };
  if (!text) return invalid("cannot be read: " + text.error().message);
  if (token.empty()) return invalid("has no key in its first line");
  return invalid(fmt::format("has a key of {} characters; a key must have at least {}",
                             token.size(), app::kShortestToken));
}

Result<void> provide_admin_key(const Config& config, bool needs_one, app::KeyService& keys) {
  const auto known = TRY(keys.list());
  if (!config.admin_key_file.empty()) return take_key_of_file(config.admin_key_file, known, keys);
  const bool has_one = std::ranges::any_of(known, [](const store::ApiKey& key) {
    return is_valid(key) && (key.role == app::Role::Admin || key.name == kName);
  });
  if (has_one || !needs_one) return {};
  const std::string token = app::KeyService::new_token();
  const std::string file = admin_key_out(config);
  // Only for its owner; an old file is replaced, since others could read it.
  if (const auto written = replace_file(file, token + '\n', 0600); !written)
    return config_error("admin-key-out: cannot write {}: {}", file, written.error().message);
  if (const auto created = keys.create(kName, app::Role::Admin, token); !created) {
    ::unlink(file.c_str());
    return created.error();
  }
  log_info("admin_key_written", fmt::format("the administrator's key is in {}", file));
  return {};
}

sigset_t waited_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) sigaddset(&signals, signal);
  return signals;
}

bool is_to_end_after_a_second() {
  const sigset_t signals = waited_signals();
  constexpr timespec kSecond{.tv_sec = 1, .tv_nsec = 0};
  const int signal = sigtimedwait(&signals, nullptr, &kSecond);
  return signal == SIGTERM || signal == SIGINT;
}

Result<void> write_port_file(const std::string& path, std::uint16_t port) {
  if (replace_file(path, std::to_string(port) + '\n', 0666)) return {};
  return config_error("cannot write the port file " + path);
}

Result<std::unique_ptr<app::Application>> open_or_wait(const app::ApplicationOptions& options,
                                                       const Clock& clock,
                                                       http::ServerOptions& server,
                                                       const std::string& port_file) {
  const auto is_away = [&](const Opened& opened) {
    return !opened && !options.address.empty() &&
           opened.error().code == ErrorCode::StorageUnavailable;
  };
  Opened opened = app::Application::open(options, clock);
  if (!is_away(opened)) return opened;
  log_warning("database_awaited", opened.error().message);
  const auto waiting = TRY(start_waiting_server(server, opened.error().message));
  for (std::size_t i = 0; i < server.listen.size(); ++i)
    server.listen[i].port = waiting->ports().at(i);
  if (!port_file.empty()) TRY(write_port_file(port_file, server.listen.front().port));
  do {
    if (is_to_end_after_a_second()) return std::unique_ptr<app::Application>();
    opened = app::Application::open(options, clock);
  } while (is_away(opened));
  return opened;
}

Result<std::unique_ptr<virtual_control::VirtualControl>> start_control(
    const Config& config, const api::Services& services) {
  using Control = std::unique_ptr<virtual_control::VirtualControl>;
  if (config.control_listen.empty()) return Control();
  const auto address = TRY(http::parse_listen_address(config.control_listen));
  virtual_control::VirtualControlOptions options;
  options.link.host = address.host;
  options.link.port = address.port;
  options.model = config.control_model;
  options.is_writable = config.control_write;
  options.setup = machine_of(config, services);
  options.start = [&services,
                   setup = config.control_setup](const interpreter::ControlPath& program) {
    return api::start_program(services, program, setup);
  };
  options.sent_away = [](std::string_view peer, std::string_view why) {
    log_warning("control_client_sent_away", fmt::format("{}: {}", peer, why));
  };
  auto control = TRY(
      virtual_control::start_virtual_control(std::move(options), services.files, services.runs));
  log_info("control_listening",
           fmt::format("{} on port {}, {}", config.control_model, control->port(),
                       config.control_write ? "writable" : "read-only"));
  return control;
}

Result<std::unique_ptr<mtconnect::ShdrAdapter>> start_shdr(const Config& config,
                                                           const api::Services& services) {
  using Adapter = std::unique_ptr<mtconnect::ShdrAdapter>;
  if (config.shdr_listen.empty()) return Adapter();
  const auto address = TRY(http::parse_listen_address(config.shdr_listen));
  auto adapter = TRY(mtconnect::ShdrAdapter::start(
      {.listen = address,
       .sent_away =
           [](std::string_view peer, std::string_view why) {
             log_warning("shdr_agent_sent_away", fmt::format("{}: {}", peer, why));
           }},
      services.measurements, services.events, services.clock));
  log_info("shdr_listening", fmt::format("port {}", adapter->port()));
  return adapter;
}

}  // namespace fitgauge::daemon
