#include "daemon/admin_key.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iostream>

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

}  // namespace

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
  const auto created = keys.create(kName, app::Role::Admin);
  if (!created) return created.error();
  std::cout << "fitgauged: the administrator's key, shown this once: " << *created << std::endl;
  return {};
}

}  // namespace fitgauge::daemon
