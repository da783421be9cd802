#pragma once

#include <signal.h>

#include <memory>
#include <string>

#include "api/services.hpp"
#include "daemon/config.hpp"
#include "http/server.hpp"
#include "plant/mtconnect/shdr_adapter.hpp"
#include "plant/virtual_control/virtual_control.hpp"
#include "service/application.hpp"

namespace fitgauge::daemon {

/// The signals that the main thread waits for; blocked in every other thread.
sigset_t waited_signals();

/// Waits a second for SIGTERM or SIGINT. @returns whether the service is to end.
bool is_to_end_after_a_second();

/// Receives the port, in decimal; written beside and renamed, so that others read a whole number.
/// @errors ConfigInvalid
Result<void> write_port_file(const std::string& path, std::uint16_t port);

/// Opens the application. While a database server is away it is tried again each second; meanwhile
/// `/livez` returns 200 at the addresses, and every other path 503.
/// @param server its addresses get the ports that were listened at.
/// @returns null when a signal ended the wait. @errors those of Application::open() and of
/// listening.
Result<std::unique_ptr<app::Application>> open_or_wait(const app::ApplicationOptions& options,
                                                       const Clock& clock,
                                                       http::ServerOptions& server,
                                                       const std::string& port_file);

/// Opens the LSV-2 port of the configuration; null where it names none. The control goes before
/// `services`. @errors as VirtualControl::start.
Result<std::unique_ptr<virtual_control::VirtualControl>> start_control(
    const Config& config, const api::Services& services);

/// Opens the SHDR port of the configuration; null where it names none. The adapter goes before
/// `services`. @errors as ShdrAdapter::start.
Result<std::unique_ptr<mtconnect::ShdrAdapter>> start_shdr(const Config& config,
                                                           const api::Services& services);

}  // namespace fitgauge::daemon
