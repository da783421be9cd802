#include "service/runs/control_files.hpp"

#include "tables/tabfile/tab_table.hpp"

namespace fitgauge::app {
namespace {

constexpr double kMillimetresPerInch = 25.4;
constexpr int kHighestNumber = 65535;
constexpr std::array<std::string_view, 2> kFolders = {"TNC:\\table\\", "TNC:\\"};

interpreter::ControlPath path_in(std::string_view folder, std::string_view name) {
  return interpreter::ControlPath::parse(std::string(folder) += name).value();
}

/// A table of the control: tool.t, toolturn.trn, tchprobe.tp or preset.pr.
struct MachineTable {
  std::string path;
  tabfile::TabTable table;

  /// Finds the table of that name in `TNC:\table\`, as on TNC 640 and TNC7, or in `TNC:\`.
  /// @errors TableFileMalformed.
  static Result<std::optional<MachineTable>> find(const interpreter::ControlDisk& disk,
                                                  std::string_view name, Allowance& allowance) {
    for (const std::string_view folder : kFolders) {
      const auto file = disk.find(path_in(folder, name));
      if (!file) continue;
      auto table = tabfile::read_tab_file(*file->bytes, allowance);
      if (table) return std::optional(MachineTable{file->path.text(), *std::move(table)});
      return Error{ErrorCode::TableFileMalformed,
                   fmt::format("{}: {}", file->path.text(), table.error().message),
                   file->path.text()};
    }
    return std::optional<MachineTable>();
  }
  /// Returns a text that changes whenever the result of `find` would change. Reads no file.
  static std::string revision(const interpreter::ControlDisk& disk, std::string_view name) {
    std::string revisions;
    for (const std::string_view folder : kFolders) {
      revisions += disk.revision(path_in(folder, name)).value_or("none") + ' ';
    }
    return revisions;
  }

  /// The number in the first column of a row; none for an indexed tool (5.1).
  /// @errors TableFileMalformed.
  Result<std::optional<std::int64_t>> number_of(std::size_t row) const {
    const std::string_view text = table.cell(row, 0);
    std::int64_t number = 0;
    const char* const end = text.data() + text.size();
    const auto [behind, error] = std::from_chars(text.data(), end, number);
    if (error == std::errc() && number >= 0 && number <= kHighestNumber) {
      if (behind == end) return std::optional(number);
      if (*behind == '.') return std::optional<std::int64_t>();
    }
    return malformed(fmt::format("row number must be a whole number; got '{}'", text));
  }

  Error malformed(std::string_view what) const {
    return {ErrorCode::TableFileMalformed, fmt::format("{}: {}", path, what), path};
  }
};

/// One row. A blank cell, or a missing column, does not change its value. After the first error it
/// reads nothing more.
class MachineTableRow {
 public:
  MachineTableRow(const MachineTable& table, std::int64_t number)
      : table_(table), number_(number) {}

  int number() const { return static_cast<int>(number_); }
  /// Empty if the table has no such column.
  std::string_view text(std::string_view column) const {
    const auto cell = table_.table.text(number_, column);
    return cell ? *cell : std::string_view();
  }
  void number(std::string_view column, double& value) {
    if (const auto read = cell(column)) value = *read;
  }
  void length(std::string_view column, double& millimetres) {
    const double unit = table_.table.header().unit == "INCH" ? kMillimetresPerInch : 1;
    if (const auto read = cell(column)) millimetres = *read * unit;
  }
  void whole(std::string_view column, int& value) {
    const auto read = cell(column);
    if (!read) return;
    if (std::trunc(*read) != *read || *read < 0 || *read > kHighestNumber) {
      return fail(column, "must be a whole number from 0 to 65535");
    }
    value = static_cast<int>(*read);
  }

  /// Refuses setups that no machine can have.
  void check(const machine::Setup& setup) {
    if (error_) return;
    const auto valid = machine::validate(setup);
    if (valid) return;
    const Error error = valid.error();
    const Error& finding = error.details.front();
    fail(finding.where.substr(finding.where.rfind('/') + 1), finding.message);
  }
  void fail(std::string_view column, std::string_view what) {
    if (!error_) error_ = table_.malformed(fmt::format("row {}, {}: {}", number_, column, what));
  }
  const std::optional<Error>& error() const { return error_; }

 private:
  std::optional<double> cell(std::string_view column) {
    if (error_ || text(column).empty()) return std::nullopt;
    const auto value = table_.table.number(number_, column);
    if (value) return *value;
    error_ = table_.malformed(value.error().message);
    return std::nullopt;
  }

  const MachineTable& table_;
  const std::int64_t number_;
  std::optional<Error> error_;
};

using machine::Preset;
using machine::ProbeRow;
using machine::ProbeSetup;
using machine::Tool;
using machine::ToolSetup;
using Row = MachineTableRow;

constexpr const char* kProbeTable = "tchprobe.tp";
constexpr const char* kToolTable = "tool.t";
constexpr const char* kLatheTable = "toolturn.trn";
constexpr const char* kPresetTable = "preset.pr";
constexpr std::array kTables = {kProbeTable, kToolTable, kLatheTable, kPresetTable};

constexpr std::pair<std::string_view, double ProbeRow::*> kProbeLengths[] = {
    {"CAL_OF1", &ProbeRow::cal_of1}, {"CAL_OF2", &ProbeRow::cal_of2}, {"F", &ProbeRow::feed},
    {"FMAX", &ProbeRow::rapid},      {"DIST", &ProbeRow::distance},   {"SET_UP", &ProbeRow::set_up},
};

void read(Row& row, Tool& tool) {
  tool.number = row.number();
  tool.name = row.text("NAME");
  for (const machine::ToolColumn& column : machine::tool_columns()) {
    if (column.number == nullptr) continue;
    if (column.is_length)
      row.length(column.name, tool.*column.number);
    else
      row.number(column.name, tool.*column.number);
  }
  tool.locked = row.text("TL") == "L";
  tool.clockwise = row.text("DIRECT") != "+";
  row.whole("RT", tool.replacement);
  row.whole("CUT", tool.teeth);
  row.whole("TP_NO", tool.probe);
  // TYP is the number of a type; on newer controls it is the name, which FN 18 does not return.
  const std::string_view type = row.text("TYP");
  if (!type.empty() && type.front() >= '0' && type.front() <= '9') row.whole("TYP", tool.type);
}

void read(Row& row, machine::LatheTool& lathe) {
  row.length("ZL", lathe.zl);
  row.length("XL", lathe.xl);
  row.length("DZL", lathe.dzl);
  row.length("DXL", lathe.dxl);
  row.length("RS", lathe.rs);
  row.whole("TO", lathe.orientation);
  row.number("ORI", lathe.ori);
  for (const std::string_view column : {"YL", "DYL"}) {
    double across = 0;
    row.number(column, across);
    if (across != 0) row.fail(column, "lathe tools are in the middle of Y here");
  }
}

void read(Row& row, ProbeRow& probe) {
  probe.number = row.number();
  probe.type = row.text("TYPE");
  for (const auto& [column, value] : kProbeLengths) row.length(column, probe.*value);
  row.number("CAL_ANG", probe.cal_ang);
  if (row.text("F_PREPOS") == "FMAX_MACHINE") {
    probe.prepositioning = machine::PrePositioning::MachineRapid;
  }
  probe.track = row.text("TRACK") == "ON";
  if (row.text("REACTION") == "EMERGSTOP") {
    probe.reaction = machine::CollisionReaction::EmergencyStop;
  }
}

void read(Row& row, Preset& preset) {
  preset.number = row.number();
  preset.comment = row.text("DOC");
  machine::PresetFrame& frame = preset.frame;
  constexpr std::array<std::string_view, 3> kLinear = {"X", "Y", "Z"};
  constexpr std::array<std::string_view, 3> kSpatial = {"SPA", "SPB", "SPC"};
  // Names of the offsets of the rotary axes on the iTNC 530, where ROT is the basic rotation.
  constexpr std::array<std::string_view, 3> kRotary = {"A", "B", "C"};
  constexpr std::array<std::string_view, 3> kOffsets = {"A_OFFS", "B_OFFS", "C_OFFS"};
  constexpr std::array<std::string_view, 3> kShifts = {"X_OFFS", "Y_OFFS", "Z_OFFS"};
  for (std::size_t i = 0; i < 3; ++i) {
    row.length(kLinear[i], frame.origin[i]);
    row.number(kSpatial[i], frame.basic_rotation_deg[i]);
    row.number(kRotary[i], frame.rotary_offsets_deg[i]);
    row.number(kOffsets[i], frame.rotary_offsets_deg[i]);
    double shift = 0;
    row.number(kShifts[i], shift);
    if (shift != 0) row.fail(kShifts[i], "offsets of the linear axes are not available");
  }
  row.number("ROT", frame.basic_rotation_deg.z);
  const std::string_view locked = row.text("LOCKED");
  preset.locked = !locked.empty() && locked != "0";
}

/// Calls `read_row` for each row of a table of that name, if there is one.
template <class ReadRow>
Result<void> for_each_row(const interpreter::ControlDisk& disk, std::string_view name,
                          Allowance& allowance, const ReadRow& read_row) {
  const auto table = TRY(MachineTable::find(disk, name, allowance));
  if (!table) return {};
  for (std::size_t i = 0; i < table->table.row_count(); ++i) {
    const auto number = TRY(table->number_of(i));
    if (!number) continue;
    Row row(*table, *number);
    read_row(row);
    if (row.error()) return *row.error();
  }
  return {};
}

Result<void> read_probes(const interpreter::ControlDisk& disk, Allowance& allowance,
                         ControlTables& tables) {
  return for_each_row(disk, kProbeTable, allowance, [&tables](Row& row) {
    ProbeSetup& probe = tables.probes.emplace_back();
    read(row, probe.row);
    machine::Setup setup;
    setup.machine.tools.clear();
    setup.machine.probes = {probe};
    row.check(setup);
  });
}

/// @pre the probes are read: a tool may refer to one.
Result<void> read_tools(const interpreter::ControlDisk& disk, Allowance& allowance,
                        ControlTables& tables) {
  machine::Setup setup;
  add_rows(tables, {}, setup.machine);
  return for_each_row(disk, kToolTable, allowance, [&](Row& row) {
    if (row.number() == 0) return;  // no tool
    ToolSetup& tool = tables.tools.emplace_back();
    read(row, tool.row);
    setup.machine.tools = {tool};
    row.check(setup);
  });
}

/// @pre the tools are read: tool.t has the name, TL, LTOL and LBREAK of a lathe tool.
Result<void> read_lathe_tools(const interpreter::ControlDisk& disk, Allowance& allowance,
                              ControlTables& tables) {
  machine::Setup setup;
  add_rows(tables, {}, setup.machine);
  return for_each_row(disk, kLatheTable, allowance, [&](Row& row) {
    if (row.number() == 0) return;
    const auto known = std::ranges::find(tables.tools, row.number(),
                                         [](const ToolSetup& tool) { return tool.row.number; });
    ToolSetup& tool = known != tables.tools.end() ? *known : tables.tools.emplace_back();
    tool.row.number = row.number();
    if (tool.row.name.empty()) tool.row.name = row.text("NAME");
    tool.row.l = tool.row.r = tool.row.dl = tool.row.dr = 0;
    read(row, tool.row.lathe.emplace());
    setup.machine.tools = {tool};
    row.check(setup);
  });
}

Result<void> read_presets(const interpreter::ControlDisk& disk, Allowance& allowance,
                          ControlTables& tables) {
  return for_each_row(disk, kPresetTable, allowance, [&tables](Row& row) {
    Preset& preset = tables.presets.emplace_back();
    read(row, preset);
    machine::Setup setup;
    setup.machine.presets = {preset};
    setup.machine.active_preset = preset.number;
    row.check(setup);
  });
}

int number_of(const ToolSetup& tool) { return tool.row.number; }
int number_of(const ProbeSetup& probe) { return probe.row.number; }
int number_of(const Preset& preset) { return preset.number; }

template <class SetupRow>
void add(const std::vector<SetupRow>& added, bool given, std::vector<SetupRow>& rows) {
  std::map<int, std::size_t> places;
  for (std::size_t i = 0; i < rows.size(); ++i) places.emplace(number_of(rows[i]), i);
  for (const SetupRow& row : added) {
    const auto known = places.find(number_of(row));
    if (known == places.end()) {
      rows.push_back(row);
    } else if (!given) {
      rows[known->second] = row;
    }
  }
}

}  // namespace

Result<ControlTables> read_control_tables(const interpreter::ControlDisk& disk,
                                          Allowance& allowance) {
  ControlTables tables;
  for (const auto& read_table : {read_probes, read_tools, read_lathe_tools, read_presets}) {
    TRY(read_table(disk, allowance, tables));
  }
  return tables;
}

Result<std::shared_ptr<const ControlTables>> ControlTablesCache::read(Allowance& allowance) {
  std::string revisions;
  for (const auto name : kTables) revisions += MachineTable::revision(disk_, name);
  if (tables_ != nullptr && revisions == revisions_) return tables_;
  auto tables = TRY(read_control_tables(disk_, allowance));
  tables_ = std::make_shared<const ControlTables>(std::move(tables));
  revisions_ = std::move(revisions);
  return tables_;
}

void add_rows(const ControlTables& tables, const GivenTables& given, machine::MachineSetup& setup) {
  add(tables.tools, given.tools, setup.tools);
  add(tables.probes, given.probes, setup.probes);
  add(tables.presets, given.presets, setup.presets);
}

}  // namespace fitgauge::app
