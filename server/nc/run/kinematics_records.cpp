#include "nc/run/run_log.hpp"

#include "tables/tabfile/tab_table.hpp"

namespace fitgauge::interpreter {
namespace {

using machine::Axis;
using machine::AxisMount;
using machine::Kinematics;
using machine::RotaryAxis;
using machine::Vec3;
using tabfile::TabTable;

/// The row of a record that is not an axis: the offset of the tool.
constexpr std::string_view kTool = "TOOL";
constexpr std::string_view kOnTable = "TABLE";
constexpr std::string_view kOnHead = "HEAD";
constexpr std::string_view kZero = "ZERO";

ControlPath records_path() { return ControlPath::parse("TNC:\\table\\DATA450.KD").value(); }

NcError broken(std::string_view what) {
  return nc_error(1096, "{}: {}", records_path().text(), what);
}

struct Record {
  std::vector<RotaryAxis> axes;
  Vec3 offset;
};

Result<Vec3> read_vector(const TabTable& table, std::int64_t row,
                         const std::array<std::string_view, 3>& columns) {
  Vec3 vector;
  for (std::size_t k = 0; k < 3; ++k) vector[k] = TRY(table.number(row, columns[k]));
  return vector;
}

/// Adds a row to the records.
Result<void> add_row(const TabTable& table, std::int64_t row,
                     std::map<std::string, Record>& records) {
  const auto wrong = [](std::string what) {
    return Error{ErrorCode::FieldInvalid, std::move(what)};
  };
  const Vec3 point = TRY(read_vector(table, row, {"X", "Y", "Z"}));
  Record& record = records[std::string(TRY(table.text(row, "NAME")))];
  const std::string_view part = TRY(table.text(row, "AXIS"));
  if (part == kTool) {
    record.offset = point;
    return {};
  }
  const auto axis = std::ranges::find_if(
      machine::kAllAxes, [&](Axis candidate) { return machine::name(candidate) == part; });
  const std::string_view mount = TRY(table.text(row, "ON"));
  if (axis == machine::kAllAxes.end() || !is_rotary(*axis))
    return wrong("AXIS must be one of: A, B, C, TOOL");
  if (mount != kOnTable && mount != kOnHead) return wrong("ON must be one of: TABLE, HEAD");
  if (std::ranges::count(record.axes, *axis, &RotaryAxis::axis) > 0)
    return wrong("the axis is repeated");
  const Vec3 direction = TRY(read_vector(table, row, {"I", "J", "K"}));
  if (direction == Vec3{}) return wrong("the direction must not be zero");
  // Records of older versions, without zeros, lack this column.
  const double zero = table.find_column(kZero) ? TRY(table.number(row, kZero)) : 0;
  record.axes.push_back(
      {*axis, mount == kOnTable ? AxisMount::Table : AxisMount::Head, point, direction, zero});
  return {};
}

TabTable empty_table() {
  constexpr std::size_t kName = 16;
  constexpr std::size_t kWord = 5;
  constexpr std::size_t kNumber = 24;  // the shortest text of any double
  std::vector<tabfile::TabColumn> columns{{.name = "NR", .width = kWord},
                                          {.name = "NAME", .width = kName},
                                          {.name = "AXIS", .width = kWord},
                                          {.name = "ON", .width = kWord}};
  for (const char* name : {"X", "Y", "Z", "I", "J", "K"})
    columns.push_back({.name = name, .width = kNumber});
  columns.push_back({.name = std::string(kZero), .width = kNumber});
  return TabTable({.name = "DATA450 .KD", .unit = "MM", .form = tabfile::HeaderForm::None},
                  std::move(columns));
}

void append(TabTable& table, const std::string& name, std::string_view part, std::string_view on,
            const Vec3& point, const Vec3& direction, double zero_deg) {
  std::vector<std::string> cells{fmt::to_string(table.row_count()), name, std::string(part),
                                 std::string(on)};
  for (const Vec3& vector : {point, direction}) {
    for (std::size_t k = 0; k < 3; ++k) cells.push_back(fmt::format("{}", vector[k]));
  }
  cells.push_back(fmt::format("{}", zero_deg));
  table.append_row({cells.begin(), cells.end()}).value();
}

}  // namespace

NcResult<probing::KinematicsRecords> read_kinematics_records(const RunFiles& files,
                                                             Allowance& allowance) {
  const auto file = files.find(records_path());
  if (!file) return probing::KinematicsRecords{};
  const auto table = tabfile::read_tab_file(*file->bytes, allowance);
  if (!table) return broken(table.error().message);
  std::map<std::string, Record> found;
  for (std::int64_t row = 0; row < static_cast<std::int64_t>(table->row_count()); ++row) {
    if (const auto added = add_row(*table, row, found); !added)
      return broken(fmt::format("row {}: {}", row, added.error().message));
  }
  probing::KinematicsRecords records;
  for (auto& [name, record] : found)
    records.emplace(name, Kinematics(std::move(record.axes), record.offset));
  return records;
}

NcResult<void> write_kinematics_records(RunFiles& files,
                                        const probing::KinematicsRecords& records) {
  TabTable table = empty_table();
  for (const auto& [name, model] : records) {
    for (const RotaryAxis& axis : model.axes()) {
      append(table, name, machine::name(axis.axis),
             axis.mount == AxisMount::Table ? kOnTable : kOnHead, axis.centre, axis.direction,
             axis.zero_deg);
    }
    append(table, name, kTool, {}, model.offset(), {}, 0);
  }
  return files.write(records_path(), tabfile::write_tab(table));
}

}  // namespace fitgauge::interpreter
