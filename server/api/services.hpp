#pragma once

#include "formats/certificate/certificate.hpp"
#include "http/route.hpp"
#include "service/storage.hpp"

namespace fitgauge::app {

class LogIntake;
class RevisionFeed;
class MeasurementService;
class FileService;
class DocumentService;
class RunService;
class EventService;
struct Jobs;

}  // namespace fitgauge::app

namespace fitgauge::api {

class GaugesInUse;
class Metrics;
class VerdictCounts;

using http::Parameter;
using http::Request;
using http::Responder;
using http::Response;

/// Services of the resources; owned by the daemon, alive as long as the server.
struct Services {
  app::TableCatalog& tables;
  app::LogService& log;
  app::LogIntake& intake;
  app::RevisionFeed& revisions;
  app::MeasurementService& measurements;
  app::FileService& files;
  app::DocumentService& documents;
  GaugesInUse& gauges;
  app::RunService& runs;
  app::Jobs& jobs;
  app::EventService& events;
  const Metrics& metrics;
  std::shared_ptr<VerdictCounts> verdicts;
  const Clock& clock;
  std::function<app::Readiness()> readiness;
  certificate::Letterhead letterhead{};  ///< of certificates
};

/// The version of the service, from the build.
inline constexpr std::string_view kVersion = FITGAUGE_VERSION;

/// As TRY in a function that answers: gives the value of a result, or sends its error and returns.
#define TRY_OR_FAIL(responder, ...)                                  \
  __extension__({                                                    \
    auto tried_ = (__VA_ARGS__);                                     \
    if (!tried_) return (responder).fail(std::move(tried_).error()); \
    *std::move(tried_);                                              \
  })

/// For callbacks, which are copied.
using SharedResponder = std::shared_ptr<Responder>;
inline SharedResponder share(Responder responder) {
  return std::make_shared<Responder>(std::move(responder));
}

/// Responds with a result, or with its error.
inline auto answer_by(SharedResponder shared) {
  return [shared = std::move(shared)](Result<Response> made) {
    made ? shared->answer(*std::move(made)) : shared->fail(made.error());
  };
}

/// Answers with the response that `make` makes from a result.
template <class Make>
auto answer_with(Responder responder, Make make) {
  return [answer = answer_by(share(std::move(responder))), make = std::move(make)](auto found) {
    found ? answer(make(*std::move(found))) : answer(found.error());
  };
}

/// 200 with a JSON text.
inline Result<Response> json_response(Result<std::string> body) {
  return Response(200, "application/json", TRY(std::move(body)));
}

/// Bytes that came from outside, so that a browser does not run them.
inline Response foreign_bytes(std::string content_type, std::string bytes) {
  return Response(200, std::move(content_type), std::move(bytes))
      .with("Content-Security-Policy", "sandbox; default-src 'none'; style-src 'unsafe-inline'");
}

/// The status an error has when a handler returns it (RFC 9110 section 15).
int status_of(ErrorCode code);

/// The problem document (RFC 9457) of an error: type, title, status, detail, instance, code and, if
/// there are several, every bad field with its pointer.
/// @param status of a refusal by the HTTP engine; absent: by the error's code.
Response problem(const Error& error, std::optional<int> status, const Request& request);

}  // namespace fitgauge::api
