#include "daemon/preflight.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "daemon/connections.hpp"
#include "service/state/readiness.hpp"

namespace fitgauge::daemon {
namespace {

/// The bodies of usual requests are smaller and pay nothing.
constexpr int kLargeBlock = 1 << 20;
/// As many as the C library allows by itself. It would count the processors in the middle of a
/// run, and open a file for that.
constexpr long kArenasOfAProcessor = 8;

/// For the database with its readers, the listeners, timers and the log.
constexpr rlim_t kOtherFiles = 256;

namespace fs = std::filesystem;

/// A folder that is there, or the nearest one above it that is: where the missing ones will be
/// made.
fs::path nearest_existing(fs::path folder) {
  std::error_code ignored;
  folder = fs::absolute(folder, ignored);
  while (!fs::exists(folder, ignored) && folder.has_relative_path()) folder = folder.parent_path();
  return folder;
}

/// Whether files can be made in `folder`. `what` names the setting.
Result<void> check_folder(const std::string& what, const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) {
    return Error{ErrorCode::ConfigInvalid,
                 fmt::format("{}: {} is not a folder", what, folder.string())};
  }
  if (access(folder.c_str(), W_OK | X_OK) != 0) {
    return Error{ErrorCode::ConfigInvalid, fmt::format("{}: cannot write to {}: {}", what,
                                                       folder.string(), std::strerror(errno))};
  }
  return {};
}

/// Whether a file can be made there. `what` names the setting.
Result<void> check_file(const std::string& what, const fs::path& file) {
  std::error_code ignored;
  if (file.empty()) return {};
  if (fs::is_directory(file, ignored)) {
    return Error{ErrorCode::ConfigInvalid, fmt::format("{}: {} is a folder", what, file.string())};
  }
  return check_folder(what, file.has_parent_path() ? file.parent_path() : fs::path("."));
}

}  // namespace

void give_large_blocks_back() {
  mallopt(M_MMAP_THRESHOLD, kLargeBlock);
  mallopt(M_ARENA_MAX, static_cast<int>(kArenasOfAProcessor * sysconf(_SC_NPROCESSORS_ONLN)));
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
    auto address = http::parse_listen_address(text);
    if (!address) return address.error();
    addresses.push_back(*std::move(address));
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
  const auto addresses = listen_addresses(config);
  if (!addresses) return addresses.error();
  for (const http::ListenAddress& address : *addresses) {
    if (const auto free = http::check_listen(address); !free) return free.error();
  }
  for (const std::string& text : {config.control_listen, config.shdr_listen}) {
    if (text.empty()) continue;
    const auto address = http::parse_listen_address(text);
    if (!address) return address.error();
    if (const auto free = http::check_listen(*address); !free) return free.error();
  }
  if (const auto connections = read_connections(config.connections); !connections) {
    return connections.error();
  }
  if (const auto tls = tls_options(config)) {
    if (const auto usable = http::check_tls(*tls); !usable) return usable.error();
  }
  if (!config.admin_key_file.empty()) {
    if (const auto key = read_admin_key(config.admin_key_file); !key) return key.error();
  }
  if (!config.database.empty()) {
    if (const auto usable = app::check_database(config.database); !usable) return usable.error();
  }
  if (const auto data = check_folder("data", nearest_existing(config.data)); !data)
    return data.error();
  if (const auto out = check_file("admin-key-out", config.admin_key_out); !out) return out;
  return check_file("port-file", port_file);
}

}  // namespace fitgauge::daemon
