#include <fmt/format.h>

#include <charconv>
#include <string>

#include "http/engine/asio.hpp"
#include "http/server.hpp"

namespace fitgauge::http {

bool ListenAddress::is_loopback() const {
  error_code error;
  const auto address = asio::ip::make_address(host, error);
  return !error && address.is_loopback();
}

std::string ListenAddress::own_address() const {
  error_code error;
  const auto address = asio::ip::make_address(host, error);
  if (error) return fmt::format("{}:{}", host, port);
  const std::string loopback = address.is_v6() ? "::1" : "127.0.0.1";
  const std::string& here = address.is_unspecified() ? loopback : host;
  if (address.is_v6()) return fmt::format("[{}]:{}", here, port);
  return fmt::format("{}:{}", here, port);
}

Result<ListenAddress> parse_listen_address(std::string_view text) {
  const Error malformed{
      ErrorCode::ConfigInvalid,
      fmt::format("{} is not an address to listen on: give a numeric address and a port, as in "
                  "127.0.0.1:8286 or [::1]:8286.",
                  text)};
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos) return malformed;
  std::string_view host = text.substr(0, colon);
  const std::string_view digits = text.substr(colon + 1);
  const bool is_bracketed = host.starts_with('[') && host.ends_with(']');
  if (is_bracketed) host = host.substr(1, host.size() - 2);

  ListenAddress address{.host = std::string(host == "localhost" ? "127.0.0.1" : host)};
  const char* const end = digits.data() + digits.size();
  const auto [stop, problem] = std::from_chars(digits.data(), end, address.port);
  if (problem != std::errc{} || stop != end) return malformed;
  error_code error;
  const auto ip = asio::ip::make_address(address.host, error);
  if (error || ip.is_v6() != is_bracketed) return malformed;
  return address;
}

}  // namespace fitgauge::http
