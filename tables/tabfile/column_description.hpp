#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tables/tabfile/tab_table.hpp"

namespace fitgauge::tabfile {

/// What a file says of its columns, by name, before the line of their names.
using ColumnDescriptions = std::map<std::string, TabColumn, std::less<>>;

/// A table has no more; a description that names more is read no further.
inline constexpr std::size_t kMostColumns = 4096;

/// Reads the lines between #STRUCTBEGIN and #STRUCTEND; texts for dialogs are passed over.
ColumnDescriptions read_struct_block(const std::vector<std::string_view>& lines);

/// Reads what stands in the parentheses of TableDescription.
ColumnDescriptions read_table_description(std::string_view text);

/// The description of all columns that have a type, as the lines of their form.
std::string write_description(const TabTable& table);

}  // namespace fitgauge::tabfile
