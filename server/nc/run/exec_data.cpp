#include "base/text.hpp"
#include "nc/probing/touch/fits.hpp"
#include "nc/run/channel.hpp"
#include "nc/run/statements.hpp"
#include "nc/run/values.hpp"

namespace fitgauge::interpreter {
namespace {

NcResult<ControlPath> path(Channel& channel, const klartext::Expr& expr) {
  const auto written = TRY(text(channel, expr));
  return channel.resolve(written);
}

/// Row and columns of FN 27 and FN 28.
struct Cells {
  std::int64_t row = 0;
  std::string columns;
};

NcResult<Cells> cells(Channel& channel, const klartext::Expr& expr) {
  const auto operands = channel.program().operands(std::get<klartext::NodeIndex>(expr));
  const auto row = TRY(whole(channel, operands[0]));
  auto columns = TRY(text(channel, operands[1]));
  return Cells{row, std::move(columns)};
}

using klartext::QRef;

/// The parameter `count` places after `first`. @errors beyond the last one.
NcResult<QRef> after(QRef first, std::size_t count) {
  const std::size_t place = first.number + count;
  if (place >= parameter_count(first.space)) {
    return nc_error("there is no parameter {} places after {}", count, name(first));
  }
  return QRef{first.space, static_cast<std::uint16_t>(place)};
}

}  // namespace

NcResult<void> execute(Channel& channel, const klartext::TableOpen& open) {
  const auto file = TRY(path(channel, open.path));
  return channel.tables.open(file);
}

NcResult<void> execute(Channel& channel, const klartext::TableWrite& write) {
  const auto place = TRY(cells(channel, write.cell));
  TRY(channel.tables.write(write.first, place.row, place.columns, channel.length_unit()));
  for (const std::string_view table : {"toolturn.trn", "tchprobe.tp", "preset.pr"}) {
    if (!ascii_iequals(channel.tables.open_name(), table)) continue;
    return channel.note("FN 27 changes the file {}: this run keeps the values that it began with",
                        table);
  }
  return {};
}

NcResult<void> execute(Channel& channel, const klartext::TableRead& read) {
  const auto place = TRY(cells(channel, read.cell));
  return channel.tables.read(read.first, place.row, place.columns, channel.length_unit());
}

NcResult<void> execute(Channel& channel, const klartext::SelectTable& select) {
  const auto file = TRY(path(channel, select.path));
  return channel.tables.select_datum_table(file);
}

/// QS only: numbers are flat code.
NcResult<void> execute(Channel& channel, const klartext::Assignment& assignment) {
  auto value = TRY(text(channel, assignment.value));
  return channel.parameters.set_string(assignment.target.number, std::move(value));
}

NcResult<void> execute(Channel& channel, const klartext::SetUndefined& undefine) {
  channel.parameters.undefine(undefine.target);
  return {};
}

/// FN 23: the circle through three points; FN 24: of least squares through four (decision 4).
NcResult<void> execute(Channel& channel, const klartext::CircleData& data) {
  std::array<double, 8> coordinates{};
  const std::size_t count = std::size_t{data.points} * 2;
  for (std::size_t i = 0; i < count; ++i) {
    const auto source = TRY(after(data.first_point, i));
    coordinates[i] = TRY(number(channel, source));
  }
  std::vector<probing::Point2> points;
  for (std::size_t i = 0; i < count; i += 2) points.push_back({coordinates[i], coordinates[i + 1]});
  const auto circle = TRY(probing::fit_circle(points));
  const std::array results{circle.centre.x, circle.centre.y, circle.radius};
  for (std::size_t i = 0; i < results.size(); ++i) {
    const auto target = TRY(after(data.target, i));
    TRY(channel.parameters.set(target, results[i]));
  }
  return {};
}

NcResult<void> execute(Channel& channel, const klartext::SystemWrite& write) {
  const auto value = TRY(number(channel, write.value));
  return write_system_data(channel, std::get<klartext::NodeIndex>(write.address), value);
}

}  // namespace fitgauge::interpreter
