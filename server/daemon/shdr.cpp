#include "daemon/shdr.hpp"

#include <fmt/format.h>

#include "daemon/log.hpp"

namespace fitgauge::daemon {

Result<std::unique_ptr<shdr::ShdrAdapter>> start_shdr(const Config& config,
                                                      const api::Services& services) {
  using Adapter = std::unique_ptr<shdr::ShdrAdapter>;
  if (config.shdr_listen.empty()) return Adapter();
  const auto address = http::parse_listen_address(config.shdr_listen);
  if (!address) return address.error();
  auto adapter = shdr::ShdrAdapter::start({.listen = *address,
                                           .sent_away =
                                               [](std::string_view peer, std::string_view why) {
                                                 log_warning("shdr_agent_sent_away",
                                                             fmt::format("{}: {}", peer, why));
                                               }},
                                          services.measurements, services.events, services.clock);
  if (!adapter) return adapter.error();
  log_info("shdr_listening", fmt::format("port {}", (*adapter)->port()));
  return *std::move(adapter);
}

}  // namespace fitgauge::daemon
