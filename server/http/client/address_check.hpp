#pragma once

#include <sys/socket.h>

namespace fitgauge::http_client {

/// Whether an address leads no further than this machine, its networks or a provider's inside:
/// loopback, private, link-local, shared, multicast, reserved, and IPv6 forms that hold one of IPv4
/// (RFC 6890 with its registries). What is neither IPv4 nor IPv6 is private.
bool is_private_address(const sockaddr& address);

}  // namespace fitgauge::http_client
