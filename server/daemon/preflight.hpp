#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "daemon/config.hpp"
#include "http/server.hpp"

namespace fitgauge::daemon {

/// The addresses of `listen`. @errors ConfigInvalid naming the one that is none.
Result<std::vector<http::ListenAddress>> listen_addresses(const Config& config);

/// What the server needs to speak TLS; none without a certificate.
std::optional<http::TlsOptions> tls_options(const Config& config);

/// Whether a start with this configuration would get as far as the database, as things are now:
/// every address is one of this machine, certificates and keys can be used and belong together, the
/// administrator's key is one, the data folder and the port file can be written. Changes nothing. A
/// port that is in use passes: the service itself may be running.
/// @errors ConfigInvalid, ListenFailed, StorageUnavailable: the first that is found.
Result<void> preflight(const Config& config, const std::string& port_file);

}  // namespace fitgauge::daemon
