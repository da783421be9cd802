#include "api/posting.hpp"

#include <utility>

#include "api/wire/request_facts.hpp"

namespace fitgauge::api {

http::Parameter idempotency_parameter() {
  return {.name = "Idempotency-Key",
          .place = http::ParameterPlace::Header,
          .description = "Makes a repeat answer what the first was answered"};
}

SharedPosting begin_posting(const Services& services, const http::Request& request,
                            http::Responder responder) {
  auto posting = std::make_shared<Posting>(Posting{services, request, std::move(responder)});
  auto key = idempotency_key(request);
  if (!key) {
    posting->responder.fail(key.error());
    return nullptr;
  }
  if (*key) {
    posting->scope = app::IdempotencyScope{.caller = std::string(caller_name(request).value_or("")),
                                           .method = "POST",
                                           .path = std::string(request.path()),
                                           .key = **std::move(key),
                                           .body = request.body()};
  }
  return posting;
}

http::Response response_of(app::Answer answer) {
  http::Response response(answer.status, std::move(answer.content_type), std::move(answer.body));
  if (!answer.location.empty()) response.with("Location", std::move(answer.location));
  return response;
}

http::Response replayed(app::Answer kept) {
  return response_of(std::move(kept)).with("Idempotency-Replayed", "true");
}

}  // namespace fitgauge::api
