#include "api/mtconnect/mtconnect_resource.hpp"

#include <fmt/format.h>

#include <memory>

#include "api/handlers.hpp"
#include "api/mtconnect/mtconnect_document.hpp"
#include "app/log/log_service.hpp"
#include "app/measurements/measurement_service.hpp"

namespace fitgauge::api {
namespace {

using mtconnect::Agent;
using mtconnect::Streams;

constexpr std::int64_t kMostObservations = 10'000;
constexpr std::int64_t kMostSequence = std::int64_t{1} << 53;
constexpr std::string_view kXml = "text/xml";

Agent agent_of(const Services& services) {
  // The gauge is there as long as its log is: since before the first measurement.
  return {.origin = services.log.origin(), .now = services.clock.now(), .began = Timestamp{}};
}

http::Response document(int status, std::string text) {
  return http::Response(status, std::string(kXml), std::move(text))
      .with("Cache-Control", "no-store");
}

http::Response probe(const Services& services) {
  return document(200, mtconnect::devices_document(agent_of(services)));
}

/// What a document of one request is made of.
struct Gathering {
  SharedResponder responder;
  Agent agent;
  std::vector<std::unique_ptr<app::KeptMeasurement>> measurements{};
};

void answer_current(const Gathering& gathering, const std::vector<app::MeasurementGroup>& groups) {
  Streams streams(gathering.agent);
  streams.add_availability();
  streams.add_assets();
  if (gathering.measurements.empty()) {
    streams.add_unavailable();
    streams.add_counts({}, gathering.agent.began);
  } else {
    const app::Measurement& newest = **gathering.measurements.front();
    streams.add(newest);
    mtconnect::Counts counts;
    for (const app::MeasurementGroup& group : groups) {
      counts.good += group.good;
      counts.rework += group.rework;
      counts.reject += group.reject;
      counts.indeterminate += group.indeterminate;
    }
    streams.add_counts(counts, newest.received_at);
  }
  const std::uint64_t next = mtconnect::feature_sequence(gathering.agent.newest) + 1;
  gathering.responder->answer(document(200, streams.document(next)));
}

void current(const Services& services, const http::Request&, http::Responder responder) {
  const auto gathering = std::make_shared<Gathering>(
      Gathering{.responder = share(std::move(responder)), .agent = agent_of(services)});
  app::MeasurementQuery query;
  query.newest_first = true;
  services.measurements.list(
      query, 0, 1,
      [gathering](const app::Measurement& measurement) {
        gathering->measurements.push_back(std::make_unique<app::KeptMeasurement>(measurement));
      },
      [gathering, &services](Result<app::ListPage> page) {
        if (!page) return gathering->responder->fail(page.error());
        gathering->agent.newest = page->as_of;
        app::MeasurementQuery counted;
        counted.as_of = page->as_of;
        services.measurements.summary(
            counted, "tolerance_class",
            [gathering](const Result<std::vector<app::MeasurementGroup>>& groups) {
              if (!groups) return gathering->responder->fail(groups.error());
              answer_current(*gathering, *groups);
            });
      });
}

void answer_sample(const Gathering& gathering, std::uint64_t from, std::size_t count,
                   const app::ListPage& page) {
  const std::uint64_t end = mtconnect::feature_sequence(page.as_of) + 1;
  if (from > end) {
    return gathering.responder->answer(
        document(404, mtconnect::error_document(gathering.agent, "OUT_OF_RANGE",
                                                fmt::format("from goes from 1 to {}", end))));
  }
  Streams streams(gathering.agent);
  if (from == 1) streams.add_availability();
  std::uint64_t next = page.next ? mtconnect::part_sequence(*page.next) + 2 : end;
  for (const auto& measurement : gathering.measurements) {
    if (streams.count() >= count) {
      next = mtconnect::part_sequence((*measurement)->row);
      break;
    }
    streams.add(**measurement, from);
  }
  gathering.responder->answer(document(200, streams.document(next)));
}

void sample(const Services& services, const http::Request& request, http::Responder responder) {
  const auto from = static_cast<std::uint64_t>(request.integer("from").value_or(1));
  const auto count = static_cast<std::size_t>(request.integer("count").value_or(100));
  const auto gathering = std::make_shared<Gathering>(
      Gathering{.responder = share(std::move(responder)), .agent = agent_of(services)});
  app::MeasurementQuery query;
  query.history = true;
  const std::int64_t first = std::max<std::int64_t>(mtconnect::measurement_at(from), 1);
  services.measurements.list(
      query, first - 1, count / 2 + 1,
      [gathering](const app::Measurement& measurement) {
        gathering->measurements.push_back(std::make_unique<app::KeptMeasurement>(measurement));
      },
      [gathering, from, count](Result<app::ListPage> page) {
        if (!page) return gathering->responder->fail(page.error());
        gathering->agent.newest = page->as_of;
        answer_sample(*gathering, from, count, *page);
      });
}

http::Route route(std::string_view name, std::string_view operation, http::Handler handler,
                  std::string_view summary) {
  return {
      .pattern = fmt::format("/mtconnect/{}", name),
      .handler = std::move(handler),
      .summary = std::string(summary),
      .response_types = {std::string(kXml)},
      .access = "viewer",
      .operation = std::string(operation),
      .tag = "connections",
      .outcomes = {{.meaning = "An MTConnect document", .media_types = {std::string(kXml)}}},
  };
}

}  // namespace

void add_mtconnect_routes(std::vector<http::Route>& routes, const Services& services) {
  routes.push_back(route(
      "probe", "probeMtconnect",
      [&services](const http::Request&) -> Result<http::Response> { return probe(services); },
      "MTConnectDevices 2.4: the device Gauge and what it observes"));
  routes.push_back(route("current", "currentMtconnect", with(services, current),
                         "MTConnectStreams 2.4: the newest measurement, and counts by verdict"));
  routes.push_back(route("sample", "sampleMtconnect", with(services, sample),
                         "MTConnectStreams 2.4: measurements of the log, from a sequence on"));
  routes.back().parameters = {{.name = "from",
                               .type = http::Integer{.min = 1, .max = kMostSequence},
                               .description = "The first sequence; 1 when absent"},
                              {.name = "count",
                               .type = http::Integer{.min = 2, .max = kMostObservations},
                               .description = "About how many observations; 100 when absent"}};
  routes.back().description =
      "Measurement n has the sequences 2n (its part) and 2n + 1. A `from` beyond the log is 404 "
      "with an "
      "MTConnectError document.";
  routes.back().outcomes.push_back({.status = 404,
                                    .meaning = "MTConnectError: `from` is beyond the log",
                                    .media_types = {std::string(kXml)}});
}

}  // namespace fitgauge::api
