#include "api/schemas.hpp"

namespace fitgauge::api {

using schema::Others;

void add_table_schemas(Schemas& schemas) {
  const std::string range = schema::object({
      {"feature", feature_words(), ""},
      {"classes", schema::array(schema::text()), "Of the standard, then those of the shop's own"},
      {"own", schema::array(schema::text()), "Classes of the shop's own"},
      {"size_ranges", schema::count(), ""},
  });
  schemas.push_back({"TableIndex", schema::object({{"revision", schema::text(), "Of all tables"},
                                                   {"tables", schema::array(range), ""}})});
  const std::string deviations =
      schema::object({{"upper_um", schema::number(), ""}, {"lower_um", schema::number(), ""}});
  const std::string row = schema::object({
      {"over_mm", schema::number(), "Exclusive"},
      {"up_to_mm", schema::number(), "Inclusive"},
      {"limits", schema::map(deviations),
       "By class; one that is undefined for the range is absent"},
  });
  schemas.push_back(
      {"Table",
       schema::object({{"revision", schema::text(), ""},
                       {"feature", feature_words(), ""},
                       {"rows", schema::array(row), "By size"}},
                      Others::Allowed,
                      R"({"revision":"1-f0a85b3a","feature":"hole","rows":[{"over_mm":18,)"
                      R"("up_to_mm":30,"limits":{"H7":{"upper_um":21,"lower_um":0}}}]})")});
  const std::string custom_row = schema::object(
      {
          {"over_mm", schema::exact(), "Exclusive; the upper end of the row before"},
          {"up_to_mm", schema::exact(), "Inclusive"},
          {"upper_um", schema::exact(), "Upper deviation"},
          {"lower_um", schema::exact(), "Lower deviation"},
      },
      Others::Refused);
  schemas.push_back(
      {"Column",
       schema::object({{"rows", schema::array(custom_row), "At least one, contiguous, by size"}},
                      Others::Refused,
                      R"({"rows":[{"over_mm":18,"up_to_mm":30,"upper_um":15,"lower_um":-3}]})")});
  schemas.push_back(
      {"Revision", schema::object({{"revision", schema::text(), "Of the tables from now on"}},
                                  Others::Allowed, R"({"revision":"2-1c0ffee2"})")});
}

}  // namespace fitgauge::api
