#include "nc/probing/touch/fits.hpp"
#include "nc/run/statements.hpp"

namespace fitgauge::interpreter {
namespace {

NcResult<ControlPath> path(Channel& channel, const Expr& expr) {
  const auto written = TRY(text(channel, expr));
  return channel.resolve(written);
}

/// Row and columns of FN 27 and FN 28.
struct Cells {
  std::int64_t row = 0;
  std::string columns;
};

NcResult<Cells> cells(Channel& channel, const Expr& expr) {
  const auto operands = channel.program().operands(std::get<NodeIndex>(expr));
  const auto row = TRY(whole(channel, operands[0]));
  auto columns = TRY(text(channel, operands[1]));
  return Cells{row, std::move(columns)};
}

/// The parameter `count` places after `first`. @errors beyond the last one.
NcResult<QRef> after(QRef first, std::size_t count) {
  const std::size_t place = first.number + count;
  if (place >= parameter_count(first.space))
    return nc_error("there is no parameter {} places after {}", count, name(first));
  return QRef{first.space, static_cast<std::uint16_t>(place)};
}

/// The instruction of a label that is named by a parameter: `LBL QS5`, `LBL Q0`.
NcResult<std::uint32_t> find_label(Channel& channel, const Label& label) {
  const QRef parameter = std::get<QRef>(label);
  std::string shown;
  std::optional<std::uint32_t> found;
  if (parameter.is_string()) {
    const auto named = TRY(text(channel, parameter));
    shown = fmt::format("\"{}\"", named);
    found = channel.linked().label(std::string_view(named));
  } else {
    const auto numbered = TRY(whole(channel, parameter));
    shown = std::to_string(numbered);
    if (numbered > 0) found = channel.linked().label(static_cast<std::uint32_t>(numbered));
  }
  if (found) return *found;
  return nc_error("label {} of {} is not defined in this program", shown, name(parameter));
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
  return write_system_data(channel, std::get<NodeIndex>(write.address), value);
}

NcResult<Next> execute(Channel& channel, const klartext::ConditionalJump& jump) {
  const auto holds = TRY(condition(channel, std::get<NodeIndex>(jump.condition)));
  if (!holds) return Next{};
  const auto target = TRY(find_label(channel, jump.target));
  return Next{Next::Kind::Jump, target};
}

NcResult<Next> execute(Channel& channel, const klartext::LabelCall& call, std::uint32_t counter) {
  const auto target = TRY(find_label(channel, call.label));
  if (is_absent(call.repeat)) return Next{Next::Kind::CallLabel, target};
  double& left = channel.parameters.cells()[counter];
  if (!is_defined(left)) {
    const auto count = TRY(number(channel, call.repeat));
    if (count < 0) return nc_error(1004, "REP is less than 0");
    left = std::round(count);
  }
  if (left < 1) {
    left = kUndefined;
    return Next{};
  }
  left -= 1;
  return Next{Next::Kind::Jump, target};
}

NcResult<Next> call_program(Channel& channel, const ControlPath& path) {
  auto program = TRY(channel.load_program(path));
  return Next{Next::Kind::CallProgram, 0, std::move(program)};
}

NcResult<Next> execute(Channel& channel, const klartext::CallProgram& call) {
  const auto written = TRY(text(channel, call.path));
  const auto path = TRY(channel.resolve_program(written));
  return call_program(channel, path);
}

/// Whether the program exists shows when it is called.
NcResult<void> execute(Channel& channel, const klartext::SelectProgram& select) {
  const auto written = TRY(text(channel, select.path));
  channel.selected_program = TRY(channel.resolve_program(written));
  return {};
}

NcResult<Next> execute(Channel& channel, const klartext::CallSelectedProgram&) {
  if (!channel.selected_program)
    return nc_error("CALL SELECTED PGM needs a program selected by SEL PGM before it");
  return call_program(channel, *channel.selected_program);
}

}  // namespace fitgauge::interpreter
