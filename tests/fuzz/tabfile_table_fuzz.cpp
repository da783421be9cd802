// Any bytes as a table file: what is refused names its line, and a table that was read is the same
// after it was written and read again.

#include "tables/tabfile/tab_table.hpp"
#include "target.hpp"

using namespace fitgauge;
using namespace fitgauge::tabfile;

void take(std::string_view bytes) {
  fitgauge::Allowance unlimited;
  const auto table = read_tab_file(bytes, unlimited);
  if (!table) {
    const Error& error = table.error();
    return require(error.code == ErrorCode::TableFileMalformed && !error.where.empty());
  }
  for (std::size_t row = 0; row < table->row_count(); ++row) {
    for (std::size_t column = 0; column < table->columns().size(); ++column) {
      require(table->cell(row, column).find('\n') == std::string_view::npos);
    }
  }
  const auto again = read_tab_file(write_tab(*table), unlimited);
  require(again && *again == *table);
}
