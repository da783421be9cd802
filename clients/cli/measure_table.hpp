#pragma once

#include "cli/measure_command.hpp"
#include "formats/sheet/shop_csv.hpp"

namespace fitgauge::cli {

/// Whether the options say that a table is the shop's own.
bool is_converted(const MeasureOptions& options);

/// What the options say of a table, or of a DFQ. @errors Usage
Outcome<sheet::ShopCsvOptions> table_options(const MeasureOptions& options);

}  // namespace fitgauge::cli
