#include "api/statistics/computation.hpp"

#include "api/handlers.hpp"
#include "service/jobs.hpp"

namespace fitgauge::api {

http::Route route_of(const Services& services, Computation computation) {
  http::Route route;
  route.method = http::Method::Post;
  route.pattern = std::move(computation.pattern);
  route.handler = [&services, compute = computation.compute](const http::Request& request,
                                                             http::Responder responder) {
    services.jobs.figures.run(
        [compute, &request]() -> Result<http::Response> {
          const auto body = parse_json(request.body());
          if (!body) {
            Error error = body.error();
            if (error.code == ErrorCode::BodyTooLarge)
              error.message.append(": ").append(kOfManyValues);
            return error;
          }
          return json_response(compute(*body));
        },
        answer_by(share(std::move(responder))));
  };
  route.summary = std::move(computation.summary);
  route.description = std::move(computation.description);
  route.body = {.use = http::BodyUse::Required,
                .media_types = {"application/json"},
                .limit = kLargestValuesBody,
                .when_too_large = std::string(kOfManyValues),
                .schema = std::move(computation.reads)};
  route.operation = std::move(computation.operation);
  route.tag = std::move(computation.tag);
  route.outcomes = {{.meaning = "What was computed", .schema = std::move(computation.answers)}};
  route.access = "viewer";
  return route;
}

}  // namespace fitgauge::api
