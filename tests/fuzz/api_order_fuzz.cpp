// Any bytes as the order of a run, with its setup: what is refused says where, and an order that
// was read can be sent again as it is kept.

#include "api/runs/run_codec.hpp"

using namespace fitgauge;
using namespace fitgauge::api;

namespace {

Result<app::NamedDocument> no_setup(const std::string& name) {
  return Error{ErrorCode::SetupUnknown, "there is no setup " + name};
}

Result<app::RunOrder> decode(std::string_view text) {
  auto body = parse_json(text);
  if (!body) return body.error();
  return decode_run_order(*std::move(body), no_setup, {});
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto order = decode({reinterpret_cast<const char*>(data), size});
  if (!order) {
    if (order.error().message.empty()) std::abort();
    return 0;
  }
  const auto again = decode(order->request);
  if (!again || again->request != order->request) std::abort();
  return 0;
}
