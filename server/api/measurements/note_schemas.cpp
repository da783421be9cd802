#include "api/measurements/note_limits.hpp"
#include "api/schemas.hpp"

namespace fitgauge::api {
namespace {

constexpr std::string_view kNew =
    R"({"cause":"Insert worn","measure":"Insert changed","operator":"Kim"})";
constexpr std::string_view kStored =
    R"({"id":"n1-5f0c9a3e77d21b40","measurement_id":"m1-5f0c9a3e77d21b40","cause":"Insert worn",)"
    R"("measure":"Insert changed","operator":"Kim","received_at":"2026-11-20T07:00:01.25Z"})";
constexpr std::string_view kCatalogue =
    R"({"causes":["Insert worn","Part clamped askew"],"measures":["Insert changed","Part scrapped"]})";

schema::Fields given_note_fields() {
  return schema::optional({
      {"cause", schema::text(kLongestEntry), "Why the value is what it is"},
      {"measure", schema::text(kLongestEntry), "What was done about it"},
      {"text", schema::text(kLongestNoteText), "Whatever else; one of the three is there"},
      {"operator", schema::text(kLongestEntry), "Who says so"},
  });
}

}  // namespace

void add_note_schemas(Schemas& schemas) {
  schemas.push_back(
      {"NewNote", schema::object(given_note_fields(), schema::Others::Refused, kNew)});
  const schema::Fields stored = {
      {"id", schema::text(), "Opaque; sorts nowhere"},
      {"measurement_id", schema::text(), "The record it stands beside"},
      {"caller", schema::text(), "The name of the key that stored it", false},
      {"received_at", schema::time(), "In UTC"},
  };
  schemas.push_back(
      {"Note", schema::object(given_note_fields() + stored, schema::Others::Allowed, kStored)});
  schemas.push_back(
      {"Notes", schema::object({{"notes", schema::array(schema::ref("Note")), "Oldest first"}})});
  const std::string entries = schema::array(schema::text(kLongestEntry));
  schemas.push_back(
      {"Catalogue", schema::object({{"causes", entries, "In the order they are offered, each once"},
                                    {"measures", entries, "The same of what can be done"}},
                                   schema::Others::Refused, kCatalogue)});
  schemas.push_back(
      {"Catalogues",
       schema::object({{"catalogues",
                        schema::array(schema::object(
                            {{"name", schema::text(), "As in the path"},
                             {"modified_at", schema::time(), "When it was stored, in UTC"}})),
                        "By name"}})});
}

}  // namespace fitgauge::api
