#include "api/resources.hpp"

#include "api/handlers.hpp"
#include "base/base64.hpp"
#include "base/json/json_writer.hpp"
#include "service/log/log_service.hpp"
#include "service/measurements/measurement_service.hpp"

namespace fitgauge::api {
namespace {

constexpr std::string_view kText = "text/plain; charset=utf-8";

http::Response checkpoint(const Services& services) {
  return http::Response(200, std::string(kText), services.log.head()->note)
      .with("Cache-Control", "no-store");
}

http::Response keys(const Services& services) {
  return http::Response(200, std::string(kText), services.log.verifier_keys())
      .with("Cache-Control", "no-cache");
}

void tile(const Services& services, const http::Request& request, http::Responder responder) {
  services.log.tile(*request.text("path"), [shared = share(std::move(responder))](
                                               Result<app::LogService::TileBytes> tile) {
    if (!tile) return shared->fail(tile.error());
    http::Response response(200, "application/octet-stream", std::move(tile->bytes));
    response.with("Cache-Control",
                  tile->is_full ? "private, max-age=31536000, immutable" : "no-cache");
    shared->answer(std::move(response));
  });
}

std::string proof_json(const app::LogService::Proof& proof) {
  std::string body;
  JsonWriter json(body);
  json.begin_object()
      .member("index", proof.index)
      .member("size", proof.head->checkpoint.size)
      .member("leaf", tlog::to_base64(proof.leaf))
      .key("hashes")
      .begin_array();
  for (const tlog::Hash& hash : proof.path) json.value(tlog::to_base64(hash));
  json.end_array().member("checkpoint", proof.head->note).end_object();
  return body;
}

void prove(const Services& services, const http::Request& request, http::Responder responder) {
  const auto id = services.measurements.parse_id(*request.text("id"));
  if (!id) return responder.fail(id.error());
  services.log.prove(
      *id, [shared = share(std::move(responder))](const Result<app::LogService::Proof>& proof) {
        if (!proof) return shared->fail(proof.error());
        shared->answer(http::Response(200, "application/json", proof_json(*proof))
                           .with("Cache-Control", "no-store"));
      });
}

}  // namespace

void add_log_routes(std::vector<http::Route>& routes, const Services& services) {
  routes.push_back({
      .pattern = "/v1/log/checkpoint",
      .handler = [&services](const http::Request&) -> Result<http::Response> {
        return checkpoint(services);
      },
      .summary = "The signed head of the log",
      .description =
          "A C2SP tlog-checkpoint: the log's name, its size and the root of its tree as a "
          "signed note. A new one at most once a second.",
      .response_types = {},
      .access = "viewer",
      .operation = "getCheckpoint",
      .tag = "log",
      .outcomes = {{.meaning = "A signed note", .media_types = {"text/plain"}}},
  });
  routes.push_back({
      .pattern = "/v1/log/key",
      .handler = [&services](const http::Request&) -> Result<http::Response> {
        return keys(services);
      },
      .summary = "The keys that verify checkpoints",
      .description = "C2SP vkeys, one a line, the newest first.",
      .response_types = {},
      .access = "viewer",
      .operation = "getLogKeys",
      .tag = "log",
      .outcomes = {{.meaning = "Verifier keys", .media_types = {"text/plain"}}},
  });
  routes.push_back({
      .pattern = "/v1/log/tile/{path*}",
      .handler = with(services, tile),
      .summary = "A tile of the log",
      .description =
          "As C2SP tlog-tiles name them: `0/000`, `1/x001/067.p/3`, and `entries/000` for "
          "the records themselves.",
      .parameters = {{.name = "path",
                      .place = http::ParameterPlace::Path,
                      .description = "Level or `entries`, index, and `.p/` with its width where it "
                                     "is not full"}},
      .response_types = {},
      .access = "viewer",
      .operation = "getTile",
      .tag = "log",
      .outcomes = {{.meaning = "Hashes, or records with their lengths",
                    .media_types = {"application/octet-stream"}}},
      .refusals = {404},
  });
  routes.push_back({
      .pattern = "/v1/measurements/{id}/proof",
      .handler = with(services, prove),
      .summary = "The proof that a measurement stands in the log",
      .description = "Waits up to 1.1 s for a checkpoint that covers the measurement.",
      .parameters = {{.name = "id",
                      .place = http::ParameterPlace::Path,
                      .description = "As the record names it"}},
      .access = "viewer",
      .operation = "getProof",
      .tag = "log",
      .outcomes = {{.meaning = "The path from its leaf to the root of a signed checkpoint",
                    .schema = "Proof"}},
      .refusals = {404},
  });
}

}  // namespace fitgauge::api
