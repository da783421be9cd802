#include "api/statistics/computation.hpp"

#include "api/handlers.hpp"
#include "app/runs/run_service.hpp"

namespace fitgauge::api {

http::Route computation(const Services& services, std::string pattern,
                        Result<std::string> (*compute)(const JsonValue& body), std::string summary,
                        std::string description) {
  http::Route route;
  route.method = http::Method::Post;
  route.pattern = std::move(pattern);
  route.handler = [&services, compute](const http::Request& request, http::Responder responder) {
    const auto shared = share(std::move(responder));
    services.runs.prepare(
        [compute, &request, shared] {
          const auto body = parse_json(request.body());
          if (!body) return shared->fail(body.error());
          auto answer = compute(*body);
          if (!answer) return shared->fail(answer.error());
          shared->answer({200, "application/json", *std::move(answer)});
        },
        [shared](Error error) { shared->fail(std::move(error)); });
  };
  route.summary = std::move(summary);
  route.description = std::move(description);
  route.body = {.use = http::BodyUse::Required,
                .media_types = {"application/json"},
                .limit = kLargestValuesBody};
  route.access = "viewer";
  return route;
}

}  // namespace fitgauge::api
