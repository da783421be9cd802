#include "api/resources.hpp"
#include "api/wire/request_facts.hpp"
#include "base/json/json_writer.hpp"
#include "service/log/log_service.hpp"
#include "service/measurements/measurement_service.hpp"

namespace fitgauge::api {
namespace {

constexpr std::string_view kText = "text/plain; charset=utf-8";

Response text_response(std::string text, std::string_view caching) {
  return Response(200, std::string(kText), std::move(text))
      .with("Cache-Control", std::string(caching));
}

/// The head of the measurements, or of the changes.
template <bool of_changes>
void checkpoint(const Services& services, const Request&, Responder responder) {
  if constexpr (!of_changes) {
    responder.answer(text_response(services.log.head()->note, "no-store"));
  } else {
    services.log.changes_head(answer_with(std::move(responder), [](std::string note) {
      return text_response(std::move(note), "no-store");
    }));
  }
}

template <bool of_changes>
void keys(const Services& services, const Request&, Responder responder) {
  responder.answer(text_response(
      of_changes ? services.log.changes_keys() : services.log.verifier_keys(), "no-cache"));
}

template <bool of_changes>
void tile(const Services& services, const Request& request, Responder responder) {
  services.log.tile(*request.text("path"), of_changes,
                    answer_with(std::move(responder), [](app::LogService::TileBytes tile) {
                      return Response(200, "application/octet-stream", std::move(tile.bytes))
                          .with("Cache-Control",
                                tile.is_full ? "private, max-age=31536000, immutable" : "no-cache");
                    }));
}

std::string proof_json(const app::LogService::Proof& proof) {
  return json_object([&](JsonWriter& json) {
    json.member("index", proof.index).member("size", proof.head->checkpoint.size);
    json.member("leaf", tlog::to_base64(proof.leaf));
    json.list("hashes", proof.path, tlog::to_base64).member("checkpoint", proof.head->note);
  });
}

void prove(const Services& services, const Request& request, Responder responder) {
  const auto id = TRY_OR_FAIL(responder, services.measurements.parse_id(*request.text("id")));
  services.log.prove(id, answer_with(std::move(responder), [](const auto& proof) {
                       return Response(200, "application/json", proof_json(proof))
                           .with("Cache-Control", "no-store");
                     }));
}

/// A tree's head, keys and tiles.
template <bool of_changes>
void add_tree_routes(Routes& add) {
  const std::string path = of_changes ? "/v1/log/changes/" : "/v1/log/";
  const std::string of = of_changes ? "Changes" : "";
  const std::string log = of_changes ? "the log of changes" : "the log";
  add("GET " + path + "checkpoint get" + of + "Checkpoint viewer", checkpoint<of_changes>,
      {.summary = "The signed head of " + log,
       .description = of_changes
                          ? "A C2SP tlog-checkpoint, as for the log. Its name is the name of the "
                            "log and `/changes`."
                          : "A C2SP tlog-checkpoint: the log's name, its size and the root of its "
                            "tree as a signed note. A new one at most once a second.",
       .response_types = {},
       .outcomes = {{.meaning = "A signed note", .media_types = {"text/plain"}}}});
  add("GET " + path + (of_changes ? "key getChangesKeys viewer" : "key getLogKeys viewer"),
      keys<of_changes>,
      {.summary = of_changes ? "The keys that verify checkpoints of changes"
                             : "The keys that verify checkpoints",
       .description = of_changes ? "The keys of the log, with the name of the log of changes."
                                 : "C2SP vkeys, one a line, the newest first.",
       .response_types = {},
       .outcomes = {{.meaning = "Verifier keys", .media_types = {"text/plain"}}}});
  add("GET " + path + "tile/{path*} get" + of + "Tile viewer 404", tile<of_changes>,
      {.summary = "A tile of " + log,
       .description = of_changes
                          ? "An entry is a change as /v1/changes answers it, with the number of "
                            "its id (5 of c5-…); a change longer than 65,535 bytes has "
                            "`before_sha256` and `after_sha256`, of the texts, in their place."
                          : "As C2SP tlog-tiles name them: `0/000`, `1/x001/067.p/3`, and "
                            "`entries/000` for the records themselves.",
       .parameters = {path_parameter(
           "path", "Level or `entries`, index, and `.p/` with its width if it is not full")},
       .response_types = {},
       .outcomes = {{.meaning = "Hashes, or entries with their lengths, as bytes",
                     .media_types = {"application/octet-stream"}}}});
}

constexpr std::string_view kKinds[] = {"tables", "plan",  "budget",     "gauge",     "calibration",
                                       "study",  "setup", "connection", "catalogue", "key"};

std::optional<std::string> text_of(const Request& request, std::string_view name) {
  const auto given = request.text(name);
  return given ? std::optional<std::string>(*given) : std::nullopt;
}
std::optional<std::int64_t> time_of(const Request& request, std::string_view name) {
  const auto given = request.time(name);
  return given ? std::optional(given->nanoseconds) : std::nullopt;
}

void list_changes(const Services& services, const Request& request, Responder responder) {
  services.log.changes({.kind = text_of(request, "kind"),
                        .name = text_of(request, "name"),
                        .from_ns = time_of(request, "from"),
                        .to_ns = time_of(request, "to")},
                       std::string(request.text("after").value_or("0")),
                       request.integer("limit").value_or(100),
                       answer_with(std::move(responder), [&request](const auto& page) {
                         auto response = json_response(json_object([&page](JsonWriter& json) {
                           json.key("changes").begin_array();
                           for (const std::string& change : page.changes) json.raw(change);
                           json.end_array().key("next");
                           page.has_more ? json.value(page.last) : json.null();
                           json.key("last");
                           page.last.empty() ? json.null() : json.value(page.last);
                         }));
                         if (page.has_more) response->with("Link", next_link(request, page.last));
                         return response;
                       }));
}

}  // namespace

void add_log_routes(Routes& add) {
  add_tree_routes<false>(add);
  add_tree_routes<true>(add);
  add("GET /v1/measurements/{id}/proof getProof viewer 404", prove,
      {.summary = "The proof that a measurement is in the log",
       .description = "Waits up to 1.1 s for a checkpoint that covers the measurement.",
       .parameters = {path_parameter("id", "Id of the record")},
       .outcomes = {{.meaning = "The path from its leaf to the root of a signed checkpoint",
                     .schema = "Proof"}}});
}

void add_changes_schemas(Schemas& schemas) {
  const std::string content = schema::null_or(R"({"type":"object","additionalProperties":true})");
  schemas.push_back(
      {"Change",
       schema::object(
           {{"id", schema::text(), "Names the history too; `after` takes it"},
            {"at", schema::time(), "Time in UTC"},
            {"caller", schema::null_or(schema::text()), "The name of the key; null: none"},
            {"kind", schema::words({std::begin(kKinds), std::end(kKinds)}), ""},
            {"name", schema::text(), "Name of the document, key, gauge or class"},
            {"action", schema::words({"created", "replaced", "deleted", "revoked"}), ""},
            {"before", content, "Document before the change; null if it was new"},
            {"after", content, "Document after the change; null after a deletion"}})});
  schemas.push_back(
      {"Changes", schema::object({{"changes", schema::array(schema::ref("Change")), "Oldest first"},
                                  {"next", schema::null_or(schema::text()),
                                   "Cursor for `after`; null on the last page"},
                                  {"last", schema::null_or(schema::text()),
                                   "Id of the newest change read, for `after` later. Null before "
                                   "the first change"}})});
}

void add_changes_routes(Routes& add) {
  add("GET /v1/changes listChanges viewer", list_changes,
      {.summary = "Changes of documents, tables and keys: who, when, before and after",
       .description =
           "Tables, plans, budgets, gauges, calibrations, setups, catalogues, connections "
           "and keys, without secrets. A change is never altered or deleted.",
       .parameters =
           {query("kind", http::Words{{std::begin(kKinds), std::end(kKinds)}},
                  "Changes of this kind"),
            query("name", "Changes of this name"),
            query("from", http::Time{}, "Changes from this time on"),
            query("to", http::Time{}, "Changes before this time"),
            query("limit", http::Integer{1, 1000},
                  "Maximum number of changes of a page, fewer if they are long (default: 100)"),
            query("after", "`next` or `last` of an earlier page, or an id")},
       .outcomes = {{.meaning = "A page, oldest first", .schema = "Changes"}}});
}

}  // namespace fitgauge::api
