#include "service/runs/machine_table.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>

namespace fitgauge::app {
namespace {

constexpr double kMillimetresPerInch = 25.4;
constexpr int kHighestNumber = 65535;
constexpr std::array<std::string_view, 2> kFolders = {"TNC:\\table\\", "TNC:\\"};

interpreter::ControlPath path_in(std::string_view folder, std::string_view name) {
  return interpreter::ControlPath::parse(std::string(folder) += name).value();
}

}  // namespace

Error MachineTable::malformed(std::string_view what) const {
  return {ErrorCode::TableFileMalformed, fmt::format("{}: {}", path, what), path};
}

Result<std::optional<MachineTable>> MachineTable::find(const interpreter::ControlDisk& disk,
                                                       std::string_view name,
                                                       Allowance& allowance) {
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

std::string MachineTable::revision(const interpreter::ControlDisk& disk, std::string_view name) {
  std::string revisions;
  for (const std::string_view folder : kFolders) {
    revisions += disk.revision(path_in(folder, name)).value_or("none") + ' ';
  }
  return revisions;
}

Result<std::optional<std::int64_t>> MachineTable::number_of(std::size_t row) const {
  const std::string_view text = table.cell(row, 0);
  std::int64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [behind, error] = std::from_chars(text.data(), end, number);
  if (error == std::errc() && number >= 0 && number <= kHighestNumber) {
    if (behind == end) return std::optional(number);
    if (*behind == '.') return std::optional<std::int64_t>();
  }
  return malformed(fmt::format("'{}' is not the number of a row", text));
}

std::string_view MachineTableRow::text(std::string_view column) const {
  const auto cell = table_.table.text(number_, column);
  return cell ? *cell : std::string_view();
}

std::optional<double> MachineTableRow::cell(std::string_view column) {
  if (error_ || text(column).empty()) return std::nullopt;
  const auto value = table_.table.number(number_, column);
  if (value) return *value;
  error_ = table_.malformed(value.error().message);
  return std::nullopt;
}

void MachineTableRow::number(std::string_view column, double& value) {
  if (const auto read = cell(column)) value = *read;
}

void MachineTableRow::length(std::string_view column, double& millimetres) {
  const double unit = table_.table.header().unit == "INCH" ? kMillimetresPerInch : 1;
  if (const auto read = cell(column)) millimetres = *read * unit;
}

void MachineTableRow::whole(std::string_view column, int& value) {
  const auto read = cell(column);
  if (!read) return;
  if (std::trunc(*read) != *read || *read < 0 || *read > kHighestNumber) {
    return fail(column, "must be a whole number from 0 to 65535");
  }
  value = static_cast<int>(*read);
}

void MachineTableRow::check(const machine::Setup& setup) {
  if (error_) return;
  const auto valid = machine::validate(setup);
  if (valid) return;
  const Error error = valid.error();
  const Error& finding = error.details.front();
  fail(finding.where.substr(finding.where.rfind('/') + 1), finding.message);
}

void MachineTableRow::fail(std::string_view column, std::string_view what) {
  if (!error_) error_ = table_.malformed(fmt::format("row {}, {}: {}", number_, column, what));
}

}  // namespace fitgauge::app
