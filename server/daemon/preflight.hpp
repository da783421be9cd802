#pragma once

#include <signal.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "api/services.hpp"
#include "base/result.hpp"
#include "daemon/config.hpp"
#include "http/server.hpp"
#include "plant/mtconnect/shdr_adapter.hpp"
#include "plant/virtual_control/virtual_control.hpp"
#include "service/application.hpp"
#include "service/documents/key_service.hpp"

namespace fitgauge::daemon {

/// From now on the C library takes a large block from the kernel by itself and gives it back as
/// soon as it is freed. Left alone it learns from the first large block that such are common, and
/// keeps every later one: a run that has held 48 MiB would leave them behind. Of the whole process.
void give_large_blocks_back();

/// Raises the soft limit of open files, to the hard limit at most, so that `connections` can
/// be open beside the files of the database and the log. Shells and systemd begin with 1024.
/// @returns how many connections can be open then.
std::int64_t allow_connections(std::int64_t connections);

/// The addresses of `listen`. @errors ConfigInvalid naming the one that is none.
Result<std::vector<http::ListenAddress>> listen_addresses(const Config& config);

/// The TLS settings of the server; none without a certificate.
std::optional<http::TlsOptions> tls_options(const Config& config);

/// Whether a start with this configuration would get as far as the database, as things are now:
/// every address is one of this machine, certificates and keys can be used and belong together, the
/// administrator's key is one, the data folder and the port file can be written. Changes nothing. A
/// port that is in use passes: the service itself may be running.
/// @errors ConfigInvalid, ListenFailed, StorageUnavailable: the first that is found.
Result<void> preflight(const Config& config, const std::string& port_file);

/// The first line of the file, without blanks around it.
/// @errors ConfigInvalid naming the file: it cannot be read, or holds no key.
Result<std::string> read_admin_key(const std::string& file);

/// The file that receives the administrator's key of the first start.
std::string admin_key_out(const Config& config);

/// Prepares the administrator's key at a start. With a file, its key is valid afterwards: a key
/// that an earlier file gave and this one does not is revoked, and the log says so. Without a file
/// the first start that `needs_one` makes a key and writes it to admin_key_out(), with mode 0600;
/// the log has the path. A key that was revoked stays revoked.
/// @errors ConfigInvalid, and those of the storage.
Result<void> provide_admin_key(const Config& config, bool needs_one, app::KeyService& keys);

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
