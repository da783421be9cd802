#pragma once

#include "daemon/config.hpp"
#include "service/application.hpp"

namespace fitgauge::daemon {

/// What the application needs of the configuration.
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
