#include "nc/probing/touch/fits.hpp"
#include "nc/program/diagnose.hpp"
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
  const std::string shown = parameter.is_string()
                                ? fmt::format("\"{}\"", TRY(text(channel, parameter)))
                                : std::to_string(TRY(whole(channel, parameter)));
  if (const auto found = channel.linked().label(shown)) return *found;
  return nc_error("label {} of {} is not defined in this program", shown, name(parameter));
}

/// FN 15: output that a control collects during a program run.
constexpr std::string_view kPrintFile = "%FN15RUN.A";

/// Prints a number with its sign, a text unchanged.
NcResult<std::string> printed(Channel& channel, const Expr& item) {
  if (is_text(item)) return text(channel, item);
  const auto value = TRY(number(channel, item));
  // Four decimals without trailing zeros, as controls print them.
  constexpr int kDecimals = 4;
  std::string text = to_char(value, kDecimals);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  if (channel.options.decimal_comma) std::replace(text.begin(), text.end(), '.', ',');
  return (text.front() == '-' ? "" : "+") + text;
}

/// A device that the simulated control does not have: `RS232:`, `PRINTER:`.
bool is_device(std::string_view target) {
  return target.find(':') != std::string_view::npos && !ascii_iequals(target.substr(0, 4), "TNC:");
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
  std::vector<machine::Vec3> points;
  for (std::size_t i = 0; i < count; i += 2) points.push_back({coordinates[i], coordinates[i + 1]});
  const auto circle = TRY(probing::fit_circle(points));
  const std::array results{circle.centre.x, circle.centre.y, circle.radius};
  for (std::size_t i = 0; i < results.size(); ++i) {
    const auto target = TRY(after(data.target, i));
    const double unit = channel.length_unit();
    TRY(channel.parameters.set(target, rounded_length(results[i] * unit) / unit));
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

NcResult<void> execute(Channel& channel, const klartext::ErrorStop& stop) {
  const auto code = TRY(whole(channel, stop.number));
  if (code >= 1000 && code < 1200 && !probing::error_text(code).empty()) return nc_error(code);
  return NcError{FaultKind::Error, code, fmt::format("FN 14: Error code {}", code)};
}

NcResult<void> execute(Channel& channel, const klartext::Print& print) {
  std::string line;
  for (const Expr& item : channel.program().view(print.items)) {
    const auto part = TRY(printed(channel, item));
    if (!line.empty()) line += "  ";
    line += part;
  }
  line += '\n';
  return channel.files.append(channel.linked().path().beside(kPrintFile), line);
}

NcResult<void> execute(Channel& channel, const klartext::FormattedPrint& print) {
  const auto name = TRY(text(channel, print.mask));
  const auto target = TRY(text(channel, print.target));
  const auto path = TRY(channel.resolve(name));
  if (ascii_iequals(trim(target), "SCLR:")) return {};  // closes the window; its lines stay
  const auto mask = TRY(channel.printer.mask(path));
  const auto printed = TRY(run_mask(channel, *mask));
  if (ascii_iequals(trim(target), "SCREEN:")) {
    for (const std::string& line : printed.lines) TRY(channel.log.print(line));
    return {};
  }
  if (is_device(target)) return channel.note("FN 16: nothing is connected to {}", target);
  const auto file = TRY(channel.resolve_printed(target));
  return channel.printer.print(printed, file);
}

NcResult<void> execute(Channel& channel, const klartext::ExternalFunction& function) {
  return channel.note("FN {} reaches outside of the program and has no effect here", function.fn);
}

NcResult<void> execute(Channel& channel, const klartext::BlankForm&) {
  const auto value = [&](const Expr& written) {
    const auto known = number(channel, written);
    return known ? std::optional(*known) : std::nullopt;
  };
  const auto gives_corner = [&](const Place& call) {
    return call.program != &channel.linked() && has_lower_corner(call.program->program());
  };
  for (std::string& fault : blank_faults(channel.program(), channel.place().source(), value)) {
    if (fault == kNoLowerCorner && std::ranges::any_of(channel.calls.behind_calls(), gives_corner))
      continue;
    TRY(channel.note(std::move(fault)));
  }
  return {};
}

NcResult<void> execute(Channel& channel, const klartext::WaitFor& wait) {
  const std::string_view condition = channel.program().text(wait.condition);
  if (condition.empty() || condition == "SYNC") return {};
  return channel.note("FN 20: WAIT FOR {} does not wait here", condition);
}

}  // namespace fitgauge::interpreter
