#pragma once

#include <filesystem>

#include "daemon/config.hpp"
#include "service/application.hpp"

namespace fitgauge::daemon {

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
  options.durable = config.durability != "off";
  options.commit_each = config.durability == "each";
  options.write_queue = static_cast<std::size_t>(config.write_queue);
  options.readers = static_cast<unsigned>(config.reader_threads);
  options.run_workers = static_cast<unsigned>(config.run_workers);
  options.idempotency_days = config.idempotency_days;
  options.run_retention_days = config.run_retention_days;
  options.event_retention = config.event_retention;
  options.keeps_newest_run = !config.control_listen.empty();
  options.origin_name = config.origin_name;
  options.has_centre = !config.forward_to.empty();
  return options;
}

}  // namespace fitgauge::daemon
