#include <fmt/format.h>

#include <array>

#include "nc/probing/touch/fits.hpp"
#include "nc/run/channel.hpp"
#include "nc/run/statements.hpp"
#include "nc/run/system_data.hpp"
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

using klartext::QRef;

/// The parameter `count` places after `first`. @errors beyond the last one.
NcResult<QRef> after(QRef first, std::size_t count) {
  const std::size_t place = first.number + count;
  if (place >= parameter_count(first.space)) {
    return nc_error(fmt::format("there is no parameter {} places after {}", count, name(first)));
  }
  return QRef{first.space, static_cast<std::uint16_t>(place)};
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

/// QS only: numbers are flat code.
NcResult<void> execute(Channel& channel, const klartext::Assignment& assignment) {
  auto value = text(channel, assignment.value);
  if (!value) return value.error();
  return channel.parameters.set_string(assignment.target.number, *std::move(value));
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
    const auto source = after(data.first_point, i);
    if (!source) return source.error();
    const auto value = number(channel, *source);
    if (!value) return value.error();
    coordinates[i] = *value;
  }
  std::vector<probing::Point2> points;
  for (std::size_t i = 0; i < count; i += 2) points.push_back({coordinates[i], coordinates[i + 1]});
  const auto circle = probing::fit_circle(points);
  if (!circle) return from_cycle(circle.error());
  const std::array results{circle->centre.x, circle->centre.y, circle->radius};
  for (std::size_t i = 0; i < results.size(); ++i) {
    const auto target = after(data.target, i);
    if (!target) return target.error();
    if (auto set = channel.parameters.set(*target, results[i]); !set) return set;
  }
  return {};
}

NcResult<void> execute(Channel& channel, const klartext::SystemWrite& write) {
  const auto value = number(channel, write.value);
  if (!value) return value.error();
  return write_system_data(channel, std::get<klartext::NodeIndex>(write.address), *value);
}

}  // namespace fitgauge::interpreter
