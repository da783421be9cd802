#include "api/schemas.hpp"

namespace fitgauge::api {

using schema::Others;

void add_file_schemas(Schemas& schemas) {
  const std::string file = schema::object({
      {"path", schema::text(), "As the control writes it"},
      {"href", schema::text(), "Where this service has it"},
      {"size", schema::count(), "In bytes"},
      {"modified_at", schema::time(), "In UTC"},
  });
  schemas.push_back(
      {"Files",
       schema::object(
           {{"files", schema::array(file), "By path"}}, Others::Allowed,
           R"({"files":[{"path":"TNC:\\nc_prog\\bore.h","href":"/v1/files/nc_prog/bore.h",)"
           R"("size":214,"modified_at":"2026-11-20T07:00:00Z"}]})")});
  const std::string note = schema::object({
      {"message", schema::text(), ""},
      {"line", schema::count(), "From 1"},
      {"column", schema::count(), "From 1"},
  });
  schemas.push_back(
      {"Diagnostic",
       schema::object(
           {
               {"severity", schema::words({"error", "warning"}), "An error refuses a run"},
               {"code", schema::text(), "Stable"},
               {"message", schema::text(), "What is wrong and what to do"},
               {"program", schema::text(), "The file it is in"},
               {"line", schema::count(), "From 1"},
               {"column", schema::count(), "From 1"},
               {"block", schema::null_or(schema::count()), "The block number, where there is one"},
               {"source", schema::text(), "The line as written"},
               {"notes", schema::array(note), "Other places that belong to it", false},
           },
           Others::Allowed,
           R"({"severity":"error","code":"nc.label_unknown","message":"label 5 is not defined",)"
           R"("program":"TNC:\\nc_prog\\bore.h","line":3,"column":1,"block":2,"source":"2 CALL LBL 5"})")});
  schemas.push_back(
      {"Diagnostics", schema::object({{"diagnostics", schema::array(schema::ref("Diagnostic")),
                                       "Empty: all is well"}})});
}

}  // namespace fitgauge::api
