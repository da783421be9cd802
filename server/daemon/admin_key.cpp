#include "daemon/preflight.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "base/text.hpp"
#include "daemon/log.hpp"

namespace fitgauge::daemon {
namespace {

/// The name of the key that the start makes.
constexpr const char* kName = "admin";

bool is_valid(const app::KeyEntry& key) { return !key.revoked_at; }

Result<void> take_key_of_file(const std::string& file, const std::vector<app::KeyEntry>& known,
                              app::KeyService& keys) {
  const auto token = read_admin_key(file);
  if (!token) return token.error();
  if (keys.find(*token)) return {};
  const bool replaces = std::any_of(known.begin(), known.end(), [](const app::KeyEntry& key) {
    return is_valid(key) && key.name == kName;
  });
  const auto taken =
      replaces ? keys.replace(kName, *token) : keys.create(kName, app::Role::Admin, *token);
  if (!taken && taken.error().where == "token") {
    log_warning("admin_key_refused",
                fmt::format("the key of {} was revoked before: put a new one there", file));
    return {};
  }
  if (!taken) {
    return Error{ErrorCode::ConfigInvalid,
                 fmt::format("admin-key-file {}: {}", file, taken.error().message)};
  }
  if (replaces) {
    log_warning("admin_key_replaced",
                fmt::format("the key of {} is valid now, the one it replaces is revoked", file));
  } else {
    log_info("admin_key_taken", fmt::format("the key of {} is valid", file));
  }
  return {};
}

/// Writes the key for its owner alone, beside and renamed: nobody reads half of it, and a link or
/// file of that name that others could read is replaced.
Result<void> write_key(const std::string& file, std::string_view token) {
  const std::string aside = file + ".new";
  ::unlink(aside.c_str());
  const int out = ::open(aside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
  const std::string line = std::string(token) + '\n';
  const bool written = out >= 0 && ::write(out, line.data(), line.size()) == ssize_t(line.size()) &&
                       ::fsync(out) == 0 && std::rename(aside.c_str(), file.c_str()) == 0;
  const int cause = errno;
  if (out >= 0) ::close(out);
  if (written) return {};
  ::unlink(aside.c_str());
  return Error{ErrorCode::ConfigInvalid,
               fmt::format("admin-key-out: cannot write {}: {}", file, std::strerror(cause))};
}

}  // namespace

std::string admin_key_out(const Config& config) {
  return config.admin_key_out.empty() ? std::filesystem::path(config.data) / "admin.key"
                                      : std::filesystem::path(config.admin_key_out);
}

Result<std::string> read_admin_key(const std::string& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  std::string token(trim(line));
  if (token.size() >= app::kShortestToken) return token;
  const auto invalid = [&](const std::string& what) {
    return Error{ErrorCode::ConfigInvalid, fmt::format("admin-key-file {} {}", file, what)};
  };
  if (!in.is_open()) return invalid(fmt::format("cannot be read: {}", std::strerror(errno)));
  if (token.empty()) return invalid("holds no key in its first line");
  return invalid(fmt::format("holds a key of {} characters; it needs at least {}", token.size(),
                             app::kShortestToken));
}

Result<void> provide_admin_key(const Config& config, bool needs_one, app::KeyService& keys) {
  const auto known = keys.list();
  if (!known) return known.error();
  if (!config.admin_key_file.empty()) return take_key_of_file(config.admin_key_file, *known, keys);
  const bool has_one = std::any_of(known->begin(), known->end(), [](const app::KeyEntry& key) {
    return is_valid(key) && (key.role == app::Role::Admin || key.name == kName);
  });
  if (has_one || !needs_one) return {};
  const std::string token = app::KeyService::new_token();
  const std::string file = admin_key_out(config);
  if (const auto written = write_key(file, token); !written) return written.error();
  if (const auto created = keys.create(kName, app::Role::Admin, token); !created) {
    ::unlink(file.c_str());
    return created.error();
  }
  log_info("admin_key_written", fmt::format("the administrator's key is in {}", file));
  return {};
}

}  // namespace fitgauge::daemon
