#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tables/iso286/tolerance_tables.hpp"

namespace fitgauge::api {

/// The classes named by `H7,JS7`; all of the feature when the text is empty.
/// @errors ClassUnknown, also for a class of the other feature; QueryInvalid for an empty name.
Result<std::vector<iso286::ClassId>> chosen_classes(std::string_view names, iso286::Feature feature,
                                                    const iso286::ToleranceTables& tables);

/// One feature's table as JSON: a row a size range, an undefined class is absent.
std::string table_json(iso286::Feature feature, const std::vector<iso286::ClassId>& classes,
                       const iso286::ToleranceTables& tables);

/// The same as CSV: two columns a class, an undefined class is blank.
std::string table_csv(const std::vector<iso286::ClassId>& classes,
                      const iso286::ToleranceTables& tables);

/// The index of /v1/tables.
std::string table_index_json(const iso286::ToleranceTables& tables);

}  // namespace fitgauge::api
