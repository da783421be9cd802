#pragma once

#include <filesystem>

#include "api/service/metrics.hpp"
#include "base/clock.hpp"
#include "http/server.hpp"
#include "plant/plant.hpp"
#include "service/application.hpp"

namespace fitgauge::daemon {

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

}  // namespace fitgauge::daemon
