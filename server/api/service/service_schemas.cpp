#include "api/schemas.hpp"

namespace fitgauge::api {

using schema::Others;

void add_service_schemas(Schemas& schemas) {
  schemas.push_back(
      {"Resync", schema::object({{"detail", schema::text(), "Read the lists again"}})});
  schemas.push_back({"TableChanged",
                     schema::object({{"feature", feature_words(), "Whose table"},
                                     {"tolerance_class", schema::text(), "The column that changed"},
                                     {"table_revision", schema::text(), "In force from now on"}})});
  schemas.push_back(
      {"Event",
       schema::any_of({schema::ref("Measurement"), schema::ref("RunFinished"), schema::ref("Note"),
                       schema::ref("TableChanged"), schema::ref("Resync")})});
  schemas.push_back({"Live", schema::object({{"status", schema::words({"live"}), ""}},
                                            Others::Allowed, R"({"status":"live"})")});
  schemas.push_back({"Ready", schema::object({
                                  {"status", schema::words({"ready"}), ""},
                                  {"version", schema::text(), ""},
                                  {"database", schema::text(), ""},
                                  {"table_revision", schema::text(), ""},
                                  {"log",
                                   schema::object({{"name", schema::text(), "Of its checkpoints"},
                                                   {"size", schema::count(), "Measurements in it"},
                                                   {"root", schema::text(), "Of its tree"}}),
                                   "The newest signed head"},
                              })});
  const std::string entry = schema::object({
      {"pointer", schema::text(), "The place in the body (RFC 6901); rows count from 0"},
      {"line", schema::count(), "Of CSV and NDJSON, from 1", false},
      {"code", schema::text(), "Stable"},
      {"detail", schema::text(), "What is wrong and what to do"},
  });
  schemas.push_back(
      {"Problem",
       schema::object(
           {
               {"type", schema::text(), "urn:fitgauge:problem: and the code"},
               {"title", schema::text(), "The same for every problem of the code"},
               {"status", schema::integer(400, 599), "As in the status line"},
               {"detail", schema::text(), "What is wrong and what to do"},
               {"instance", schema::text(), "This request, as the log names it"},
               {"code", schema::text(), "Stable; reference/errors.md lists all"},
               {"where", schema::text(), "The parameter or the place, where it is one", false},
               {"errors", schema::array(entry), "Every field that cannot be accepted", false},
               {"diagnostics", schema::array(schema::ref("Diagnostic")),
                "Of program.invalid: every finding", false},
               {"head", schema::ref("LogHead"), "Of log.position and log.forked: what is here",
                false},
           },
           Others::Allowed,
           R"({"type":"urn:fitgauge:problem:class.unknown","title":"Unknown tolerance class",)"
           R"("status":404,"detail":"H19 is not a tolerance class of the tables",)"
           R"("instance":"urn:fitgauge:request:1","code":"class.unknown"})")});
  const std::string any = R"({"type":"object"})";
  schemas.push_back(
      {"Description", schema::object({{"openapi", schema::text(), "The version of OpenAPI"},
                                      {"info", any, ""},
                                      {"servers", schema::array(any), ""},
                                      {"tags", schema::array(any), "Groups of operations"},
                                      {"paths", any, "The operations"},
                                      {"components", any, "Schemas, responses, security"}})});
}

}  // namespace fitgauge::api
