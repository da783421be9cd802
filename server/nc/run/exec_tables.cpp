#include "nc/run/channel.hpp"
#include "nc/run/statements.hpp"
#include "nc/run/values.hpp"

namespace fitgauge::interpreter {
namespace {

NcResult<ControlPath> path(Channel& channel, const klartext::Expr& expr) {
  const auto written = text(channel, expr);
  if (!written) return written.error();
  return channel.resolve(*written);
}

/// Row and columns of FN 27 and FN 28.
struct Cells {
  std::int64_t row = 0;
  std::string columns;
};

NcResult<Cells> cells(Channel& channel, const klartext::Expr& expr) {
  const auto operands = channel.program().operands(std::get<klartext::NodeIndex>(expr));
  const auto row = whole(channel, operands[0]);
  if (!row) return row.error();
  auto columns = text(channel, operands[1]);
  if (!columns) return columns.error();
  return Cells{*row, *std::move(columns)};
}

}  // namespace

NcResult<void> execute(Channel& channel, const klartext::TableOpen& open) {
  const auto file = path(channel, open.path);
  if (!file) return file.error();
  return channel.tables.open(*file);
}

NcResult<void> execute(Channel& channel, const klartext::TableWrite& write) {
  const auto place = cells(channel, write.cell);
  if (!place) return place.error();
  return channel.tables.write(write.first, place->row, place->columns, channel.length_unit());
}

NcResult<void> execute(Channel& channel, const klartext::TableRead& read) {
  const auto place = cells(channel, read.cell);
  if (!place) return place.error();
  return channel.tables.read(read.first, place->row, place->columns, channel.length_unit());
}

NcResult<void> execute(Channel& channel, const klartext::SelectTable& select) {
  const auto file = path(channel, select.path);
  if (!file) return file.error();
  return channel.tables.select_datum_table(*file);
}

}  // namespace fitgauge::interpreter
