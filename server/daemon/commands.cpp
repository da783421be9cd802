#include "daemon/parts.hpp"

#include <iostream>

#include "base/folder.hpp"
#include "service/log/log_keys.hpp"
#include "service/qualification/qualification.hpp"

namespace fitgauge::daemon {
namespace {

const SystemClock kClock;
constexpr long kHealthSeconds = 3;

Result<std::unique_ptr<app::Application>> open_application(const Config& config, bool attach) {
  app::ApplicationOptions options = application_options(config);
  if (attach) options.access = store::Access::Attach;
  return app::Application::open(options, kClock);
}

Result<std::unique_ptr<app::Application>> attach(const Config& config) {
  return open_application(config, true);
}

/// Whether the daemon never had this data folder: it is not there, or empty.
bool is_new(const std::filesystem::path& folder) {
  std::error_code failure;
  return !std::filesystem::exists(folder, failure) || std::filesystem::is_empty(folder, failure);
}

/// Address of the check: the plain one if the listener requires client certificates.
Result<std::string> address_of(const Config& config) {
  if (config.tls_client_ca.empty()) {
    const auto listen = TRY(http::parse_listen_address(config.listen.front()));
    return listen.own_address();
  }
  const auto port = read_regular(health_port_file(config));
  if (port && !port->empty()) return "127.0.0.1:" + port->substr(0, port->find('\n'));
  return Error{ErrorCode::NotReady, "no service runs on " + config.data + ": it holds no " +
                                        health_port_file(config).filename().string()};
}

/// Keeps the first line of a head.
std::size_t take_status_line(char* data, std::size_t, std::size_t size, void* line) {
  auto& kept = *static_cast<std::string*>(line);
  const std::string_view text(data, size);
  if (kept.empty()) kept = text.substr(0, text.find('\r'));
  return size;
}

std::size_t drop_body(char*, std::size_t, std::size_t size, void*) { return size; }

}  // namespace

Result<int> run_backup(const Config& config, const std::string& file) {
  const auto app = TRY(attach(config));
  const std::string covered = TRY(app->backup(file));
  std::cout << "backup written to " << file << ": " << covered << '\n';
  return 0;
}

Result<int> run_verify(const Config& config, const std::vector<std::string>& checkpoints) {
  std::map<std::string, std::string> notes;
  for (const std::string& file : checkpoints) {
    auto note = read_regular(file);
    if (!note) return config_error("cannot read the checkpoint {}: {}", file, note.error().message);
    notes[file] = *std::move(note);
  }
  const auto app = TRY(attach(config));
  const auto verification = TRY(app->verify(notes));
  for (const std::string& finding : verification.findings) std::cout << finding << '\n';
  std::cout << fmt::format("{} measurements checked, {} findings\n", verification.measurements,
                           verification.findings.size());
  if (!verification.head.empty()) std::cout << verification.head << '\n';
  if (checkpoints.empty()) {
    std::cout
        << "give --checkpoint FILE, a checkpoint from a safe place, to detect a replaced log\n";
  }
  return verification.findings.empty() ? 0 : 1;
}

Result<int> run_qualify(const Config& config, const std::string& folder, bool signs) try {
  std::vector<tlog::SigningKey> keys;
  if (signs) {
    auto read = TRY(app::read_log_keys(config.data));
    if (read.empty()) {
      return config_error(
          config.data +
          " has no log key: start the service with this folder once, or remove --data");
    }
    keys = std::move(read);
  }
  std::filesystem::create_directories(folder);
  const auto out = TRY(Folder::open(folder));
  const auto made = app::qualification::qualify(std::string(api::kVersion), kClock.now());
  const auto files = files_of(made, signs ? &keys.front() : nullptr);
  for (const auto& [name, text] : files) TRY(out.write(name, text));
  std::size_t failed = 0;
  for (const app::qualification::Check& check : made.checks) {
    if (check.passed) continue;
    ++failed;
    std::cout << fmt::format("{}: expected {}, got {}, limit {}\n", check.id, check.expected,
                             static_cast<double>(check.got), check.limit);
  }
  std::cout << fmt::format("{} checks, {} failed; see {}\n", made.checks.size(), failed, folder);
  return made.passed ? 0 : 1;
} catch (const std::exception& failure) {
  return Error::of(ErrorCode::StorageUnavailable, "the qualification could not run: {}",
                   failure.what());
}

Result<int> run_log_key(const Config& config) {
  const auto key = TRY(app::renew_log_key(config.data));
  std::cout << key << '\n';
  return 0;
}

Result<int> run_key_create(const Config& config, const std::string& name, const std::string& role,
                           const std::optional<std::string>& expires) {
  const auto known = app::role_from_word(role);
  if (!known)
    return config_error("role must be one of: viewer, operator, admin, station; got '{}'", role);
  std::optional<Timestamp> end;
  if (expires) {
    const auto time = parse_rfc3339(*expires);
    if (!time) {
      return config_error("expires must be a time such as 2027-01-01T00:00:00Z; got '{}'",
                          *expires);
    }
    end = *time;
  }
  // A key may be made before the first start, and then also makes the database.
  const auto app = TRY(open_application(config, !is_new(config.data)));
  const auto token = TRY(app->keys().create(name, *known, {}, end));
  std::cout << token << '\n';
  return 0;
}

Result<int> run_key_revoke(const Config& config, const std::string& name) {
  const auto app = TRY(attach(config));
  TRY(app->keys().revoke(name));
  return 0;
}

Result<int> run_key_list(const Config& config) {
  const auto app = TRY(attach(config));
  const auto entries = TRY(app->keys().list());
  const auto at = [](std::string_view what, const std::optional<std::int64_t>& time) {
    return time ? fmt::format("\t{} {}", what, format_rfc3339({*time})) : std::string();
  };
  for (const auto& key : entries) {
    std::cout << fmt::format("{}\t{}{}{}{}\n", key.name, app::word(key.role),
                             at("created", key.created_at_ns), at("expires", key.expires_at_ns),
                             at("revoked", key.revoked_at_ns));
  }
  return 0;
}

std::filesystem::path health_port_file(const Config& config) {
  return std::filesystem::path(config.data) / "health.port";
}

Result<void> healthcheck(const Config& config) {
  const auto failed = [](std::string what) { return Error{ErrorCode::NotReady, std::move(what)}; };
  const auto address = TRY(address_of(config));
  const bool tls = !config.tls_cert.empty() && config.tls_client_ca.empty();
  std::string line;
  http_client::CurlHandle call;
  call.begin(fmt::format("{}://{}/readyz", tls ? "https" : "http", address), "GET", {}, {});
  call.set(CURLOPT_PROXY, "");
  call.set(CURLOPT_TIMEOUT, kHealthSeconds);
  // The service's certificate names its outer address: it is not verified here.
  call.set(CURLOPT_SSL_VERIFYPEER, 0L);
  call.set(CURLOPT_SSL_VERIFYHOST, 0L);
  call.set(CURLOPT_HEADERFUNCTION, &take_status_line);
  call.set(CURLOPT_HEADERDATA, &line);
  call.set(CURLOPT_WRITEFUNCTION, &drop_body);
  const CURLcode code = call.perform();
  if (line.starts_with("HTTP/1.1 200")) return {};
  if (code == CURLE_COULDNT_CONNECT || code == CURLE_SSL_CONNECT_ERROR)
    return failed("nothing listens on " + address);
  return failed(line.empty() ? "no answer from " + address
                             : fmt::format("{} answered '{}'", address, line));
}

}  // namespace fitgauge::daemon
