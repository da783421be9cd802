// Any bytes as the order of a run, with its setup: what is refused says where, and an order that
// was read can be sent again as it is kept.

#include "api/runs/run_codec.hpp"
#include "target.hpp"

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

void take(std::string_view bytes) {
  const auto order = decode(bytes);
  require(order.has_value() || !order.error().message.empty());
  if (!order) return;
  const auto again = decode(order->request);
  require(again && again->request == order->request);
}
