#include "daemon/commands.hpp"

#include <openssl/bio.h>
#include <openssl/ssl.h>
#include <sys/socket.h>
#include <sys/time.h>

#include <iostream>

#include "api/services.hpp"
#include "base/folder.hpp"
#include "base/regular_file.hpp"
#include "http/server.hpp"
#include "service/log/log_keys.hpp"
#include "service/qualification/qualification.hpp"

namespace fitgauge::daemon {
namespace {

const SystemClock kClock;

Result<std::unique_ptr<app::Application>> open_application(const Config& config, bool attach) {
  app::ApplicationOptions options = application_options(config);
  options.attach = attach;
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

constexpr std::string_view kRequest =
    "GET /readyz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";

constexpr std::chrono::seconds kHealthPatience{3};

using Bio = std::unique_ptr<BIO, decltype(&BIO_free_all)>;
using SslContext = std::unique_ptr<SSL_CTX, decltype(&SSL_CTX_free)>;

/// Address of the check: if the listener requires client certificates, the plain one for health
/// checks.
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

void limit_waiting(BIO* connection) {
  const int socket = static_cast<int>(BIO_get_fd(connection, nullptr));
  const timeval limit{.tv_sec = kHealthPatience.count(), .tv_usec = 0};
  setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
  setsockopt(socket, SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof limit);
}

/// Repeats a call that a stop of this process has interrupted, within its time limit.
template <class Call>
int uninterrupted(BIO* connection, const Call& call) {
  const auto end = std::chrono::steady_clock::now() + kHealthPatience;
  int result = call();
  while (result <= 0 && BIO_should_retry(connection) && std::chrono::steady_clock::now() < end) {
    result = call();
  }
  return result;
}

}  // namespace

Result<int> run_backup(const Config& config, const std::string& file) {
  const auto app = TRY(attach(config));
  TRY(app->backup(file));
  std::cout << "backup written to " << file << '\n';
  return 0;
}

Result<int> run_verify(const Config& config, const std::vector<std::string>& checkpoints) {
  std::map<std::string, std::string> notes;
  for (const std::string& file : checkpoints) {
    auto note = read_regular(file);
    if (!note) {
      return Error{ErrorCode::ConfigInvalid,
                   fmt::format("cannot read the checkpoint {}: {}", file, note.error().message)};
    }
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
      return Error{
          ErrorCode::ConfigInvalid,
          config.data +
              " has no log key: start the service with this folder once, or remove --data"};
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
  return Error{ErrorCode::StorageUnavailable,
               fmt::format("the qualification could not run: {}", failure.what())};
}

Result<int> run_log_key(const Config& config) {
  const auto key = TRY(app::renew_log_key(config.data));
  std::cout << key << '\n';
  return 0;
}

Result<int> run_key_create(const Config& config, const std::string& name, const std::string& role,
                           const std::optional<std::string>& expires) {
  const auto known = app::role_from_word(role);
  if (!known) {
    return Error{
        ErrorCode::ConfigInvalid,
        fmt::format("role must be one of: viewer, operator, admin, station; got '{}'", role)};
  }
  std::optional<Timestamp> end;
  if (expires) {
    const auto time = parse_rfc3339(*expires);
    if (!time) {
      return Error{
          ErrorCode::ConfigInvalid,
          fmt::format("expires must be a time such as 2027-01-01T00:00:00Z; got '{}'", *expires)};
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
  const auto app = attach(config);
  if (!app) return app.error();
  const auto entries = TRY((*app)->keys().list());
  for (const app::KeyEntry& entry : entries) {
    std::cout << fmt::format(
        "{}\t{}\tcreated {}{}{}\n", entry.name, app::word(entry.role),
        format_rfc3339(entry.created_at),
        entry.expires_at ? "\texpires " + format_rfc3339(*entry.expires_at) : std::string(),
        entry.revoked_at ? "\trevoked " + format_rfc3339(*entry.revoked_at) : std::string());
  }
  return 0;
}

std::filesystem::path health_port_file(const Config& config) {
  return std::filesystem::path(config.data) / "health.port";
}

Result<void> healthcheck(const Config& config) {
  const auto failed = [](std::string what) { return Error{ErrorCode::NotReady, std::move(what)}; };
  const auto asked = TRY(address_of(config));
  const std::string& address = asked;

  const SslContext context(SSL_CTX_new(TLS_client_method()), &SSL_CTX_free);
  const bool tls = !config.tls_cert.empty() && config.tls_client_ca.empty();
  // The service's certificate names its outer address: it is not verified here.
  const Bio connection(tls ? BIO_new_ssl_connect(context.get()) : BIO_new(BIO_s_connect()),
                       &BIO_free_all);
  if (!connection || BIO_set_conn_hostname(connection.get(), address.c_str()) <= 0 ||
      BIO_do_connect(connection.get()) <= 0) {
    return failed("nothing listens on " + address);
  }
  limit_waiting(connection.get());
  BIO* const io = connection.get();
  if (uninterrupted(io, [io] {
        return BIO_write(io, kRequest.data(), static_cast<int>(kRequest.size()));
      }) <= 0) {
    return failed("cannot write to " + address);
  }
  char answer[64] = {};
  const int length = uninterrupted(io, [&] { return BIO_read(io, answer, sizeof answer); });
  const std::string_view text(answer, length > 0 ? static_cast<std::size_t>(length) : 0);
  const std::string_view line = text.substr(0, text.find('\r'));
  if (!line.starts_with("HTTP/1.1 200")) {
    return failed(line.empty() ? "no answer from " + address
                               : fmt::format("{} answered '{}'", address, line));
  }
  return {};
}

}  // namespace fitgauge::daemon
