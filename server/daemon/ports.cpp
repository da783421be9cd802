#include "daemon/ports.hpp"

#include <fmt/format.h>

#include "api/runs/control_program.hpp"
#include "daemon/log.hpp"
#include "http/server.hpp"

namespace fitgauge::daemon {
namespace {

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

Result<std::unique_ptr<virtual_control::VirtualControl>> start_control(
    const Config& config, const api::Services& services) {
  using Control = std::unique_ptr<virtual_control::VirtualControl>;
  if (config.control_listen.empty()) return Control();
  const auto address = http::parse_listen_address(config.control_listen);
  if (!address) return address.error();
  virtual_control::VirtualControlOptions options;
  options.link.host = address->host;
  options.link.port = address->port;
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
  auto control =
      virtual_control::VirtualControl::start(std::move(options), services.files, services.runs);
  if (!control) return control.error();
  log_info("control_listening",
           fmt::format("{} on port {}, {}", config.control_model, (*control)->port(),
                       config.control_write ? "writable" : "read-only"));
  return *std::move(control);
}

Result<std::unique_ptr<mtconnect::ShdrAdapter>> start_shdr(const Config& config,
                                                           const api::Services& services) {
  using Adapter = std::unique_ptr<mtconnect::ShdrAdapter>;
  if (config.shdr_listen.empty()) return Adapter();
  const auto address = http::parse_listen_address(config.shdr_listen);
  if (!address) return address.error();
  auto adapter = mtconnect::ShdrAdapter::start(
      {.listen = *address,
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
