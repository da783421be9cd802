#pragma once

#include "formats/certificate/certificate.hpp"
#include "http/route.hpp"
#include "service/state/readiness.hpp"

namespace fitgauge::app {

class TableCatalog;
class LogService;
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

}  // namespace fitgauge::api
