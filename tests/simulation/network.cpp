#include "network.hpp"

#include <curl/curl.h>

#include <cstdarg>

#include "world.hpp"

#undef curl_easy_setopt
#undef curl_easy_getinfo

namespace fitgauge::simulation {

Network& network() {
  static Network the;
  return the;
}

std::string Exchange::header(std::string_view name) const {
  for (const std::string& line : headers) {
    if (line.starts_with(name) && line.substr(name.size(), 2) == ": ") {
      return line.substr(name.size() + 2);
    }
  }
  return {};
}

namespace {

constexpr std::int64_t kLongestWay = 20 * kMillisecond;
constexpr std::int64_t kGlance = 200 * kMillisecond;

/// A handle of libcurl: its options by their numbers.
struct Handle {
  std::map<int, long> longs{};
  std::map<int, const void*> pointers{};
  std::map<int, void (*)()> functions{};
  std::map<int, curl_off_t> sizes{};
  long status = 0;

  const char* text(CURLoption option) const {
    const auto found = pointers.find(option);
    return found == pointers.end() ? "" : static_cast<const char*>(found->second);
  }
};

Exchange exchange_of(const Handle& handle) {
  Exchange made{.method = handle.text(CURLOPT_CUSTOMREQUEST)};
  const std::string_view url = handle.text(CURLOPT_URL);
  const std::size_t host = url.find("://") + 3;
  const std::size_t path = std::min(url.find('/', host), url.size());
  made.host = url.substr(host, path - host);
  made.path = url.substr(path);
  const auto headers = handle.pointers.find(CURLOPT_HTTPHEADER);
  const auto* line =
      headers == handle.pointers.end() ? nullptr : static_cast<const curl_slist*>(headers->second);
  for (; line != nullptr; line = line->next) made.headers.emplace_back(line->data);
  if (const auto size = handle.sizes.find(CURLOPT_POSTFIELDSIZE_LARGE);
      size != handle.sizes.end()) {
    made.body.assign(handle.text(CURLOPT_POSTFIELDS), static_cast<std::size_t>(size->second));
  }
  return made;
}

/// Waits as one does for an answer that does not come.
CURLcode wait_in_vain(const Handle& handle) {
  const auto look =
      reinterpret_cast<curl_xferinfo_callback>(handle.functions.at(CURLOPT_XFERINFOFUNCTION));
  void* const user = const_cast<void*>(handle.pointers.at(CURLOPT_XFERINFODATA));
  const std::int64_t patience = handle.longs.at(CURLOPT_TIMEOUT) * kSecond;
  const auto most =
      static_cast<std::int64_t>(draw(world_random(), static_cast<std::uint64_t>(patience)));
  const std::int64_t until = world_now() + (draw(world_random(), 4) == 0 ? patience : most / 8);
  while (world_now() < until) {
    if (look(user, 0, 0, 0, 0) != 0) return CURLE_ABORTED_BY_CALLBACK;
    sleep_for(kGlance);
  }
  return CURLE_OPERATION_TIMEDOUT;
}

std::optional<Reply> deliver(const Exchange& exchange) {
  const auto host = network().hosts.find(exchange.host);
  if (host == network().hosts.end()) return std::nullopt;
  const On outside(nullptr);
  return host->second(exchange);
}

/// A lost request turns up, behind those that were sent after it.
void deliver_late() {
  std::vector<Exchange>& late = network().late;
  if (late.empty() || draw(world_random(), 3) != 0) return;
  const Exchange exchange = std::move(late.front());
  late.erase(late.begin());
  static_cast<void>(deliver(exchange));
}

CURLcode perform(Handle& handle) {
  const Machine* const machine = current_machine();
  const auto is_dead = [machine] { return machine != nullptr && machine->is_dead; };
  handle.status = 0;
  const Exchange exchange = exchange_of(handle);
  const Weather weather = network().weather;
  sleep_for(static_cast<std::int64_t>(draw(world_random(), kLongestWay)));
  std::uint64_t fate = draw(world_random(), 1000);
  const auto is = [&fate](std::uint64_t share) {
    const bool hit = fate < share;
    fate -= hit ? 0 : share;
    return hit;
  };
  if (is_dead() || is(weather.refused)) return CURLE_COULDNT_CONNECT;
  if (is(weather.lost)) {
    if (draw(world_random(), 2) == 0) network().late.push_back(exchange);
    return wait_in_vain(handle);
  }
  const bool is_doubled = is(weather.doubled);
  const bool is_answer_lost = !is_doubled && is(weather.answer_lost);
  std::optional<Reply> reply = deliver(exchange);
  if (!reply) return CURLE_COULDNT_CONNECT;
  if (is_doubled) static_cast<void>(deliver(exchange));
  deliver_late();
  if (is_answer_lost) return wait_in_vain(handle);
  sleep_for(static_cast<std::int64_t>(draw(world_random(), kLongestWay)));
  if (is_dead()) return CURLE_RECV_ERROR;
  handle.status = reply->status;
  if (exchange.method == "GET") ++current_machine()->asked;
  const auto take =
      reinterpret_cast<curl_write_callback>(handle.functions.at(CURLOPT_WRITEFUNCTION));
  void* const user = const_cast<void*>(handle.pointers.at(CURLOPT_WRITEDATA));
  const bool is_taken = take(reply->body.data(), 1, reply->body.size(), user) == reply->body.size();
  return is_taken ? CURLE_OK : CURLE_WRITE_ERROR;
}

}  // namespace
}  // namespace fitgauge::simulation

using fitgauge::simulation::Handle;

extern "C" {

CURL* curl_easy_init() { return new Handle; }
void curl_easy_cleanup(CURL* curl) { delete static_cast<Handle*>(curl); }
void curl_easy_reset(CURL* curl) { *static_cast<Handle*>(curl) = {}; }
const char* curl_easy_strerror(CURLcode code) {
  return code == CURLE_OK ? "none" : "the simulated network failed";
}

CURLcode curl_easy_setopt(CURL* curl, CURLoption option, ...) {
  Handle& handle = *static_cast<Handle*>(curl);
  va_list list;
  va_start(list, option);
  switch (option / 10'000) {
    case 0: handle.longs[option] = va_arg(list, long); break;
    case 1: handle.pointers[option] = va_arg(list, const void*); break;
    case 2: handle.functions[option] = va_arg(list, void (*)()); break;
    default: handle.sizes[option] = va_arg(list, curl_off_t);
  }
  va_end(list);
  return CURLE_OK;
}

CURLcode curl_easy_getinfo(CURL* curl, CURLINFO info, ...) {
  va_list list;
  va_start(list, info);
  if (info == CURLINFO_RESPONSE_CODE) *va_arg(list, long*) = static_cast<Handle*>(curl)->status;
  va_end(list);
  return CURLE_OK;
}

CURLcode curl_easy_perform(CURL* curl) {
  return fitgauge::simulation::perform(*static_cast<Handle*>(curl));
}

}  // extern "C"
