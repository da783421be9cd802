#pragma once

#include "tables/iso286/tolerance_tables.hpp"
#include "tables/tabfile/tab_table.hpp"

namespace fitgauge::tabfile {

/// The tolerance tables in the layout that program 8255 reads: size range i is row 2i (BEREICH, the
/// end of the range in mm, and in each class column the upper deviation in µm) and row 2i + 1 (the
/// lower deviations). Columns: NR, BEREICH, the classes of 8255, every other class, custom columns.
/// A cell is blank where the class is not defined at the end of the range (so H14 of the first
/// range is that of 1 to 3 mm), and where a custom column does not have one value for the whole
/// range.
TabTable project(const iso286::ToleranceTables& tables, iso286::Feature feature);

}  // namespace fitgauge::tabfile
