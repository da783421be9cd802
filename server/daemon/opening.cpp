#include "daemon/preflight.hpp"

#include <time.h>

#include <csignal>
#include <cstdio>
#include <fstream>

#include "api/runs/run_posting.hpp"
#include "api/wire/problem.hpp"
#include "daemon/log.hpp"

namespace fitgauge::daemon {
namespace {

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
  const std::string aside = path + ".new";
  {
    std::remove(aside.c_str());  // a FIFO would wait for a reader
    std::ofstream file(aside);
    file << port << '\n';
    if (!file.flush()) return Error{ErrorCode::ConfigInvalid, "cannot write the port file " + path};
  }
  if (std::rename(aside.c_str(), path.c_str()) != 0) {
    return Error{ErrorCode::ConfigInvalid, "cannot write the port file " + path};
  }
  return {};
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
  for (std::size_t i = 0; i < server.listen.size(); ++i) {
    server.listen[i].port = waiting->ports().at(i);
  }
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
      virtual_control::VirtualControl::start(std::move(options), services.files, services.runs));
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
  auto adapter = mtconnect::ShdrAdapter::start(
      {.listen = address,
       .sent_away =
           [](std::string_view peer, std::string_view why) {
             log_warning("shdr_agent_sent_away", fmt::format("{}: {}", peer, why));
           }},
      services.measurements, services.events, services.clock);
  if (!adapter) return adapter.error();
  log_info("shdr_listening", fmt::format("port {}", (*adapter)->port()));
  return *std::move(adapter);
}

}  // namespace fitgauge::daemon
