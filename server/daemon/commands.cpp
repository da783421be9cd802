#include "daemon/commands.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <system_error>

#include "daemon/application_options.hpp"
#include "service/log/log_keys.hpp"

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

}  // namespace

Result<int> run_backup(const Config& config, const std::string& file) {
  const auto app = attach(config);
  if (!app) return app.error();
  if (const auto written = (*app)->backup(file); !written) return written.error();
  std::cout << "backup written to " << file << '\n';
  return 0;
}

Result<int> run_verify(const Config& config, const std::vector<std::string>& checkpoints) {
  std::map<std::string, std::string> notes;
  for (const std::string& file : checkpoints) {
    std::ifstream in(file, std::ios::binary);
    notes[file] = {std::istreambuf_iterator<char>(in), {}};
    if (!in.is_open() || in.bad()) {
      return Error{ErrorCode::ConfigInvalid, "cannot read the checkpoint " + file};
    }
  }
  const auto app = attach(config);
  if (!app) return app.error();
  const auto verification = (*app)->verify(notes);
  if (!verification) return verification.error();
  for (const std::string& finding : verification->findings) std::cout << finding << '\n';
  std::cout << fmt::format("{} measurements checked, {} findings\n", verification->measurements,
                           verification->findings.size());
  if (!verification->head.empty()) std::cout << verification->head << '\n';
  if (checkpoints.empty()) {
    std::cout << "without a checkpoint kept elsewhere (--checkpoint FILE) this cannot tell whether "
                 "all of it was replaced\n";
  }
  return verification->findings.empty() ? 0 : 1;
}

Result<int> run_log_key(const Config& config) {
  const auto key = app::renew_log_key(config.data);
  if (!key) return key.error();
  std::cout << *key << '\n';
  return 0;
}

Result<int> run_key_create(const Config& config, const std::string& name, const std::string& role) {
  const auto known = app::role_from_word(role);
  if (!known) {
    return Error{ErrorCode::ConfigInvalid,
                 fmt::format("role is viewer, operator, admin or station, not '{}'", role)};
  }
  // A key may be made before the first start; then the database is made too.
  const auto app = open_application(config, !is_new(config.data));
  if (!app) return app.error();
  const auto token = (*app)->keys().create(name, *known);
  if (!token) return token.error();
  std::cout << *token << '\n';
  return 0;
}

Result<int> run_key_revoke(const Config& config, const std::string& name) {
  const auto app = attach(config);
  if (!app) return app.error();
  if (const auto revoked = (*app)->keys().revoke(name); !revoked) return revoked.error();
  return 0;
}

Result<int> run_key_list(const Config& config) {
  const auto app = attach(config);
  if (!app) return app.error();
  const auto entries = (*app)->keys().list();
  if (!entries) return entries.error();
  for (const app::KeyEntry& entry : *entries) {
    std::cout << fmt::format(
        "{}\t{}\tcreated {}{}\n", entry.name, word(entry.role), format_rfc3339(entry.created_at),
        entry.revoked_at ? "\trevoked " + format_rfc3339(*entry.revoked_at) : std::string());
  }
  return 0;
}

}  // namespace fitgauge::daemon
