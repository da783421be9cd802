#pragma once

#include <string>

#include "tables/tabfile/tab_table.hpp"

namespace fitgauge::tabfile {

/// The file of a table in the form its header names; read_tab gives the same table back.
std::string write_tab(const TabTable& table);

}  // namespace fitgauge::tabfile
