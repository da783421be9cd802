#pragma once

#include <string>
#include <string_view>

#include "cli/measure_command.hpp"
#include "sheet/shop_csv.hpp"

namespace fitgauge::cli {

/// Whether the options say that a table is the shop's own.
bool is_converted(const MeasureOptions& options);

/// The table as the service takes it. @errors Usage for an option, LocalFile for the table.
Outcome<std::string> converted_table(std::string_view bytes, const MeasureOptions& options);

/// What the options say of a table, or of a DFQ. @errors Usage
Outcome<sheet::ShopCsvOptions> table_options(const MeasureOptions& options);

}  // namespace fitgauge::cli
