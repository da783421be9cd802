#include "nc/run/statements.hpp"
#include "tables/tabfile/characters.hpp"

namespace fitgauge::interpreter {
namespace {

using tabfile::TabTable;

/// FN 27 and FN 28 name up to eight columns.
constexpr std::size_t kMostColumns = 8;

/// "X,Y,D" and the parameters X, X + 1, X + 2 they are read into or written from.
struct ColumnTarget {
  std::string_view column;
  QRef parameter;
};

NcResult<std::vector<ColumnTarget>> targets(std::string_view columns, QRef first) {
  std::vector<ColumnTarget> targets;
  for (const std::string_view column : split(columns, ',')) {
    const std::size_t place = first.number + targets.size();
    if (targets.size() == kMostColumns)
      return nc_error("more than {} columns are named", kMostColumns);
    if (place >= parameter_count(first.space))
      return nc_error("there are not enough parameters after {}", name(first));
    targets.push_back({trim(column), {first.space, static_cast<std::uint16_t>(place)}});
  }
  return targets;
}

/// Program units in one unit of the table, for columns of lengths.
double unit_of(const TabTable& table, std::string_view column, double length_unit) {
  const auto index = table.find_column(column);
  if (!index) return 1;
  const std::string& type = table.columns()[*index].type;
  if (type != "L" && type != "LENGTH") return 1;
  return (table.header().unit == "INCH" ? kMillimetresPerInch : 1) / length_unit;
}

NcError no_table_error() {
  return nc_error("no table is open: write FN 26: TABOPEN before this block");
}

/// Millimetres or degrees in one unit of a datum table.
double datum_unit(const TabTable& table, machine::Axis axis) {
  return table.header().unit == "INCH" && !is_rotary(axis) ? kMillimetresPerInch : 1;
}

}  // namespace

NcResult<TableAccess::Table> TableAccess::load(const ControlPath& path, std::string_view what) {
  auto file = files_.find(path);
  if (!file) return nc_error("{} {} does not exist", what, path.text());
  if (std::none_of(opened_.begin(), opened_.end(),
                   [&](const OpenedTable& table) { return table.path == path; })) {
    opened_.push_back({file->path, file->source});
  }
  Known& known = known_[path.key()];
  if (known.content == nullptr || known.revision != file->revision) {
    known = {file->revision, file->table};
    if (known.content == nullptr) {
      auto read = tabfile::read_tab_file(*file->bytes, allowance_);
      if (read.has_error())
        return nc_error("{} {} cannot be read: {}", what, path.text(), read.error().message);
      known.content = std::make_shared<const TabTable>(*std::move(read));
    }
  }
  return Table{file->path, known.content};
}

NcResult<void> TableAccess::load_as(std::shared_ptr<Table>& table, std::shared_ptr<Table>& other,
                                    const ControlPath& path, std::string_view what) {
  TRY(save(table));
  table.reset();
  const bool is_shared = other != nullptr && other->path == path;
  if (is_shared) TRY(save(other));
  table = std::make_shared<Table>(TRY(load(path, what)));
  if (is_shared) other = table;
  return {};
}

NcResult<void> TableAccess::save(const std::shared_ptr<Table>& table) {
  if (table == nullptr || table->changed == nullptr) return {};
  table->changed.reset();
  return files_.write(table->path, tabfile::write_tab(*table->content));
}

TabTable& TableAccess::editable(Table& table) {
  if (table.changed == nullptr) {
    table.changed = std::make_shared<TabTable>(*table.content);
    table.content = table.changed;
  }
  return *table.changed;
}

NcResult<void> TableAccess::open(const ControlPath& path) {
  return load_as(open_, datum_, path, "table");
}

NcResult<void> TableAccess::read(QRef first, std::int64_t row, std::string_view columns,
                                 double length_unit) const {
  if (!open_) return no_table_error();
  const auto named = TRY(targets(columns, first));
  const TabTable& table = *open_->content;
  const auto failed = [&](const Error& error) {
    return nc_error("table {}: {}", open_->path.text(), error.message);
  };
  for (const auto& [column, parameter] : named) {
    if (parameter.is_string()) {
      const auto cell = table.text(row, column);
      if (!cell) return failed(cell.error());
      TRY(parameters_.set_string(parameter.number, std::string(*cell)));
      continue;
    }
    const auto value = table.number(row, column);
    if (!value) return failed(value.error());
    const double scaled = *value * unit_of(table, column, length_unit);
    TRY(parameters_.set(parameter, scaled));
  }
  return {};
}

NcResult<void> TableAccess::write(QRef first, std::int64_t row, std::string_view columns,
                                  double length_unit) {
  if (!open_) return no_table_error();
  const auto named = TRY(targets(columns, first));
  TabTable& table = editable(*open_);
  const bool is_tool_table = ascii_iequals(open_->path.file_name(), "tool.t");
  for (const auto& [column, parameter] : named) {
    if (!parameters_.is_defined(parameter)) return undefined_error(parameter);
    const auto set = parameter.is_string()
                         ? table.set_text(row, column, *parameters_.string(parameter.number))
                         : table.set_number(row, column,
                                            *parameters_.number(parameter) /
                                                unit_of(table, column, length_unit));
    if (!set) return nc_error("table {}: {}", open_->path.text(), set.error().message);
    for (const machine::ToolColumn& known : machine::tool_columns()) {
      if (!is_tool_table || known.nr == 0 || !ascii_iequals(known.name, column)) continue;
      const bool is_inch = known.is_length && table.header().unit == "INCH";
      const double unit = is_inch ? kMillimetresPerInch : 1;
      tool_cells_.push_back({static_cast<int>(row), known.nr, *table.number(row, column) * unit});
    }
  }
  return {};
}

NcResult<void> TableAccess::select_datum_table(const ControlPath& path) {
  return load_as(datum_, open_, path, "datum table");
}

NcResult<std::optional<double>> TableAccess::datum(std::int64_t row, machine::Axis axis) const {
  if (!datum_) return nc_error(1043, "write SEL TABLE before this block");
  const TabTable& table = *datum_->content;
  const auto failed = [&](const Error& error) {
    return nc_error("datum table {}: {}", datum_->path.text(), error.message);
  };
  const auto found = table.find_row(row);
  if (!found) return failed(found.error());
  const auto column = table.find_column(name(axis));
  if (!column || table.cell(*found, *column).empty()) return std::optional<double>();
  const auto value = table.number(row, name(axis));
  if (!value) return failed(value.error());
  return std::optional(*value * datum_unit(table, axis));
}

NcResult<void> TableAccess::write_datum(std::int64_t row, const machine::AxisWords& values) {
  if (!datum_) return nc_error(1043, "write SEL TABLE before this block");
  for (const machine::Axis axis : machine::kAllAxes) {
    if (!values[axis]) continue;
    TabTable& table = editable(*datum_);
    const auto set = table.set_number(row, name(axis), *values[axis] / datum_unit(table, axis));
    if (!set) return nc_error("datum table {}: {}", datum_->path.text(), set.error().message);
  }
  return save(datum_);
}

NcResult<void> TableAccess::close() {
  TRY(save(open_));
  return save(datum_);
}

QParameters::QParameters()
    : cells_(kFirstConstant, kUndefined), strings_(parameter_count(QSpace::Qs)) {}

std::optional<double> QParameters::number(QRef parameter) const {
  const double value = cells_[cell_of(parameter)];
  return interpreter::is_defined(value) ? std::optional(value) : std::nullopt;
}

NcResult<void> QParameters::set(QRef parameter, double value) {
  if (!std::isfinite(value))
    return nc_error("the value for {} is not a finite number", name(parameter));
  cells_[cell_of(parameter)] = value;
  return {};
}

void QParameters::set_q(std::uint16_t number, double value) { cells_[kFirstQ + number] = value; }

const std::string* QParameters::string(std::uint16_t number) const {
  return strings_[number] ? &*strings_[number] : nullptr;
}

NcResult<void> QParameters::set_string(std::uint16_t number, std::string value) {
  const std::size_t size = tabfile::count_characters(value);
  if (size > kLongestString) {
    return nc_error("QS{} cannot take {} characters; a string parameter holds {}", number, size,
                    kLongestString);
  }
  strings_[number] = std::move(value);
  return {};
}

void QParameters::undefine(QRef parameter) {
  if (parameter.is_string()) {
    strings_[parameter.number].reset();
  } else {
    cells_[cell_of(parameter)] = kUndefined;
  }
}

bool QParameters::is_defined(QRef parameter) const {
  return parameter.is_string() ? strings_[parameter.number].has_value()
                               : number(parameter).has_value();
}

std::vector<double> QParameters::save_locals(const LinkedProgram& program) const {
  const auto ql = cells_.begin() + kFirstQl;
  std::vector<double> saved(ql, ql + kLocals);
  const auto counters =
      cells_.begin() + static_cast<std::ptrdiff_t>(kFirstConstant + program.constants().size());
  saved.insert(saved.end(), counters, counters + program.counters());
  return saved;
}

void QParameters::enter(const LinkedProgram& program, std::span<const double> saved) {
  if (cells_.size() < program.cells()) cells_.resize(program.cells(), kUndefined);
  const auto ql = cells_.begin() + kFirstQl;
  const auto constants = std::copy(program.constants().begin(), program.constants().end(),
                                   cells_.begin() + kFirstConstant);
  if (saved.empty()) {
    std::fill_n(ql, kLocals, kUndefined);
    std::fill_n(constants, program.counters(), kUndefined);
  } else {
    std::copy_n(saved.begin(), kLocals, ql);
    std::copy(saved.begin() + kLocals, saved.end(), constants);
  }
}

std::vector<ParameterValue> QParameters::all() const {
  std::vector<ParameterValue> values;
  const auto add_numbers = [&](QSpace space) {
    for (std::uint16_t i = 0; i < parameter_count(space); ++i) {
      // Adding 0 makes the negative zero of COS 90 a plain one.
      if (const auto value = number({space, i})) values.push_back({{space, i}, *value + 0.0});
    }
  };
  add_numbers(QSpace::Q);
  add_numbers(QSpace::Qr);
  for (std::uint16_t i = 0; i < parameter_count(QSpace::Qs); ++i) {
    if (strings_[i]) values.push_back({{QSpace::Qs, i}, *strings_[i]});
  }
  add_numbers(QSpace::Ql);
  return values;
}

NcError undefined_error(QRef parameter) {
  return nc_error("parameter {} is undefined; assign it before this block reads it",
                  name(parameter));
}

}  // namespace fitgauge::interpreter
