#pragma once

#include <filesystem>

#include "db/store/measurement_row.hpp"

namespace fitgauge::bench {

/// The peer: what a plain C program does. One prepared statement, stepped once a row, all rows in
/// one transaction; the same schema, WAL and synchronous=FULL, and no hashes computed.
/// @returns the seconds from BEGIN to the end of COMMIT.
double insert_bare(const std::filesystem::path& database,
                   std::span<const store::MeasurementRow> rows);

}  // namespace fitgauge::bench
