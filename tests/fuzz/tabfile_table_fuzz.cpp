// Any bytes as a table file: what is refused names its line, and a table that was read is the same
// after it was written and read again.

#include "tables/tabfile/tab_table.hpp"

using namespace fitgauge;
using namespace fitgauge::tabfile;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fitgauge::Allowance unlimited;
  const auto table = read_tab_file({reinterpret_cast<const char*>(data), size}, unlimited);
  if (!table) {
    const Error& error = table.error();
    if (error.code != ErrorCode::TableFileMalformed || error.where.empty()) std::abort();
    return 0;
  }
  for (std::size_t row = 0; row < table->row_count(); ++row) {
    for (std::size_t column = 0; column < table->columns().size(); ++column) {
      if (table->cell(row, column).find('\n') != std::string_view::npos) std::abort();
    }
  }
  const auto again = read_tab_file(write_tab(*table), unlimited);
  if (!again || !(*again == *table)) std::abort();
  return 0;
}
