#include "service/files/file_check.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "base/text.hpp"
#include "nc/klartext/mask_file.hpp"
#include "nc/klartext/parser.hpp"
#include "nc/klartext/printer.hpp"
#include "nc/program/check.hpp"
#include "tables/tabfile/tab_reader.hpp"

namespace fitgauge::app {
namespace {

constexpr std::array<std::string_view, 5> kTableExtensions = {".tab", ".t", ".tp", ".pr", ".d"};

/// What refuses a table stands in one of its lines: `line 12`.
std::vector<klartext::Diagnostic> check_table(const interpreter::ControlFile& file,
                                              Allowance& allowance) {
  const auto table = tabfile::read_tab_file(*file.bytes, allowance);
  if (table) return {};
  const Error error = table.error();
  klartext::Diagnostic diagnostic{.message = error.message, .program = file.path.text()};
  constexpr std::string_view kLine = "line ";
  const std::string_view where = error.where;
  SourcePosition& begin = diagnostic.range.begin;
  std::from_chars(where.data() + kLine.size(), where.data() + where.size(), begin.line);
  diagnostic.range.end = begin;
  return {std::move(diagnostic)};
}

}  // namespace

Result<std::vector<klartext::Diagnostic>> check_file(const interpreter::ControlPath& path,
                                                     const interpreter::ControlDisk& disk,
                                                     interpreter::ProgramCache& programs,
                                                     Allowance& allowance) {
  const std::string_view name = path.file_name();
  const std::string extension = ascii_lower(name.substr(std::min(name.rfind('.'), name.size())));
  const bool is_mask = extension == ".a";
  const bool is_table = std::find(kTableExtensions.begin(), kTableExtensions.end(), extension) !=
                        kTableExtensions.end();
  if (!is_mask && !is_table) return interpreter::check(path, disk, programs, allowance);
  const auto file = disk.find(path);
  if (!file) return Error{ErrorCode::ProgramUnknown, "there is no file " + path.text()};
  if (is_mask) return klartext::parse_mask(*file->bytes, file->path.text()).diagnostics;
  return check_table(*file, allowance);
}

Result<std::string> format_file(const interpreter::ControlPath& path,
                                const interpreter::ControlDisk& disk) {
  const auto file = disk.find(path);
  if (!file) return Error{ErrorCode::ProgramUnknown, "there is no file " + path.text()};
  const auto parsed = klartext::parse_program(*file->bytes, file->path.text());
  for (const klartext::Diagnostic& found : parsed.diagnostics) {
    if (found.severity != klartext::Severity::Error) continue;
    return Error{ErrorCode::ProgramInvalid, "line " + std::to_string(found.range.begin.line) +
                                                ": " + found.message +
                                                "; action=check lists all that is wrong"};
  }
  return klartext::format_program(parsed.program);
}

}  // namespace fitgauge::app
