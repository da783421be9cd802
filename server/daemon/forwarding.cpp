#include "daemon/connections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>

#include "daemon/log.hpp"
#include "service/log/revisions_text.hpp"

namespace fitgauge::daemon {
namespace {

constexpr std::chrono::seconds kPatienceAtStart{3};
constexpr long kOk = 200;

Error invalid_forwarding(std::string message) {
  return {ErrorCode::ConfigInvalid, std::move(message)};
}

/// `centre.example:8286` of `https://centre.example:8286/`; empty where it is no address of a
/// centre.
std::string_view authority_of(std::string_view url) {
  const std::size_t scheme = url.find("://");
  if (scheme == url.npos) return {};
  std::string_view authority = url.substr(scheme + 3);
  if (authority.ends_with('/')) authority.remove_suffix(1);
  return authority.find_first_of("/?#@ ") == authority.npos ? authority : std::string_view();
}

bool is_this_machine(std::string_view authority) {
  if (authority.starts_with("[::1]")) return true;
  const std::string_view host = authority.substr(0, authority.find(':'));
  const auto is_of_number = [](char c) { return (c >= '0' && c <= '9') || c == '.'; };
  return host == "localhost" ||
         (host.starts_with("127.") && std::all_of(host.begin(), host.end(), is_of_number));
}

std::string without_last_slash(std::string url) {
  if (url.ends_with('/')) url.pop_back();
  return url;
}

forwarder::CentreOptions centre_of(const Config& config) {
  return {.url = without_last_slash(config.forward_to),
          .key_file = config.forward_key_file,
          .authorities = config.forward_ca};
}

}  // namespace

Result<void> check_forwarding(const Config& config) {
  const std::string& url = config.forward_to;
  if (url.empty()) {
    if (config.forward_key_file.empty() && config.forward_ca.empty()) return {};
    return invalid_forwarding(
        "forward-key-file and forward-ca need forward-to, the address of the centre");
  }
  const std::string_view authority = authority_of(url);
  const bool is_plain = url.starts_with("http://");
  if (authority.empty() || !(is_plain || url.starts_with("https://"))) {
    return invalid_forwarding(fmt::format(
        "forward-to takes the address of a centre, as https://host or https://host:port, not '{}'",
        url));
  }
  if (is_plain && !config.forward_insecure && !is_this_machine(authority)) {
    return invalid_forwarding(
        fmt::format("forward-to {} would send the key and the records readable by all: "
                    "give https://, or forward-insecure",
                    url));
  }
  for (const std::string& file : {config.forward_key_file, config.forward_ca}) {
    if (!file.empty() && !std::ifstream(file).good()) {
      return invalid_forwarding(fmt::format("cannot read {}", file));
    }
  }
  return {};
}

void tell_log(std::string_view event, const std::string& detail) {
  event == "forward_goes_on" || event == "revisions_taken" ? log_info(event, detail)
                                                           : log_warning(event, detail);
}

std::optional<std::int64_t> ask_centre(const Config& config, std::string_view digits) {
  const auto until = std::chrono::steady_clock::now() + kPatienceAtStart;
  forwarder::CentreLink link(centre_of(config));
  const auto answer = link.get(fmt::format("/v1/log/revisions?station={}", digits),
                               [until] { return std::chrono::steady_clock::now() < until; });
  const auto read = api::read_revisions(answer.status == kOk ? answer.body : "");
  if (!read) return std::nullopt;
  return (*read)->page.size;
}

std::unique_ptr<forwarder::Forwarder> start_forwarder(const Config& config, app::Application& app,
                                                      Tell tell) {
  if (config.forward_to.empty()) return nullptr;
  return std::make_unique<forwarder::Forwarder>(
      app.outbox(), app.revision_intake(tell),
      forwarder::ForwarderOptions{.centre = centre_of(config), .tell = tell});
}

void write_outbox_metrics(const forwarder::Forwarder* forwarder, const Clock& clock,
                          api::Exposition& out) {
  // The families are told without a centre too.
  const auto state = forwarder == nullptr ? std::nullopt : std::optional(forwarder->state());
  out.gauge("fitgauge_outbox_rows", "Measurements that the centre does not have");
  if (state) out.sample(static_cast<double>(state->rows));
  out.gauge("fitgauge_outbox_oldest_seconds", "How long the first of them has been waiting");
  if (!state) return;
  const std::int64_t now = clock.now().nanoseconds;
  const std::int64_t oldest = state->oldest ? state->oldest->nanoseconds : now;
  out.sample(std::max(0.0, static_cast<double>(now - oldest) / kNanosecondsPerSecond));
}

}  // namespace fitgauge::daemon
