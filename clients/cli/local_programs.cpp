#include "cli/nc_commands.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "api/runs/run_codec.hpp"
#include "base/allowance.hpp"
#include "base/text.hpp"
#include "cli/address.hpp"
#include "cli/folder_disk.hpp"
#include "cli/json_object.hpp"
#include "cli/local_files.hpp"
#include "cli/problem.hpp"
#include "nc/iso/parser.hpp"
#include "nc/iso/printer.hpp"
#include "nc/klartext/printer.hpp"
#include "nc/program/check.hpp"

namespace fitgauge::cli {
namespace {

using klartext::Diagnostic;
using klartext::Severity;

using Levels = std::map<std::string, std::optional<Severity>, std::less<>>;

constexpr std::string_view kCodes[] = {
#define KLARTEXT_DIAGNOSTIC(name, id) id,
#include "nc/klartext/diagnostic_codes.inc"
#undef KLARTEXT_DIAGNOSTIC
};

Outcome<Levels> read_levels(const std::vector<std::string>& written) {
  Levels levels;
  for (const std::string& level : written) {
    const std::size_t equals = level.find('=');
    const std::string_view said =
        equals == level.npos ? "" : std::string_view(level).substr(equals + 1);
    std::optional<Severity> severity;
    for (const Severity each : {Severity::Note, Severity::Warning, Severity::Error}) {
      if (said == word(each)) severity = each;
    }
    if (!severity && said != "off") {
      return Failure{
          ExitCode::Usage,
          fmt::format("--level must be CODE=off, note, warning or error; got '{}'", level)};
    }
    const std::string code = level.substr(0, equals);
    if (std::ranges::find(kCodes, code) == std::end(kCodes))
      return Failure{ExitCode::Usage, fmt::format("--level: unknown finding '{}'", code)};
    levels[code] = severity;
  }
  return levels;
}

/// An error of the program stays one: it does not run.
void apply(const Levels& levels, std::vector<Diagnostic>& found) {
  std::erase_if(found, [&](Diagnostic& each) {
    const auto level = levels.find(id(each.code));
    if (level == levels.end() || each.severity == Severity::Error) return false;
    each.severity = level->second.value_or(each.severity);
    return !level->second;
  });
}

std::string sarif_of(const Diagnostic& found) {
  JsonObject region;
  region.add_raw("startLine", std::to_string(std::max(found.range.begin.line, 1U)));
  region.add_raw("startColumn", std::to_string(std::max(found.range.begin.column, 1U)));
  std::string uri = found.program;
  std::ranges::replace(uri, '\\', '/');
  const std::string place =
      fmt::format(R"({{"physicalLocation":{{"artifactLocation":{{"uri":{}}},"region":{}}}}})",
                  json_quoted(uri), region.text());
  JsonObject result;
  result.add("ruleId", id(found.code)).add("level", word(found.severity));
  result.add_raw("message", fmt::format(R"({{"text":{}}})", json_quoted(found.message)));
  result.add_raw("locations", "[" + place + "]");
  return result.text();
}

void print(const Context& context, std::string_view format, const std::vector<Diagnostic>& found) {
  if (format == "json") return context.print("{}\n", api::diagnostics_json(found));
  std::string items;
  for (const Diagnostic& each : found) {
    if (format == "text") {
      context.print("{}\n", klartext::render(each));
    } else {
      items += (items.empty() ? "" : ",") + sarif_of(each);
    }
  }
  if (format == "sarif") {
    context.print(
        R"({{"version":"2.1.0","runs":[{{"tool":{{"driver":{{"name":"fitgauge","version":"{}"}}}},"results":[{}]}}]}})"
        "\n",
        FITGAUGE_VERSION, items);
  }
}

}  // namespace

Outcome<ExitCode> run_nc_check_local(const Context& context, const CheckOptions& options) {
  const auto levels = read_levels(options.levels);
  if (!levels) return levels.error();
  std::vector<Diagnostic> all;
  std::optional<Failure> failed;
  for (const std::string& file : options.files) {
    const auto name = local_program(file);
    if (!name) {
      failed = name.error();
      continue;
    }
    const FolderDisk disk(file);
    Allowance unlimited;
    interpreter::ProgramCache programs;
    auto found = interpreter::check(*name, disk, programs, unlimited);
    if (!found) {
      failed = Failure{ExitCode::LocalFile, file + ": " + found.error().message};
      continue;
    }
    for (Diagnostic& each : *found) each.program = disk.name_here(each.program);
    apply(*levels, *found);
    all.insert(all.end(), found->begin(), found->end());
  }
  print(context, !options.format.empty() ? options.format : context.json ? "json" : "text", all);
  if (failed) return *std::move(failed);
  auto worst = Severity::Note;
  for (const Diagnostic& each : all) worst = std::max(worst, each.severity);
  return static_cast<ExitCode>(worst);  // 0, 1, 2
}

namespace {

struct ReadProgram {
  klartext::Program program;
  bool is_iso = false;
  bool has_crlf = false;
};

/// A program of this machine, or of the service. @errors those of reading it, and ProgramFailed for
/// one with errors.
Outcome<ReadProgram> read_program(const Context& context, const std::string& file,
                                  bool from_control) {
  std::string bytes;
  if (from_control) {
    auto answer =
        expect_ok(context.client.send({.target = file_target(file)}), context.client.url());
    if (!answer) return answer.error();
    bytes = std::move(answer->body);
  } else {
    auto read = read_file(file);
    if (!read) return read.error();
    bytes = *std::move(read);
  }
  const bool is_iso = iso::is_iso(bytes, file);
  const bool has_crlf = bytes.find("\r\n") != bytes.npos;
  auto parsed = iso::parse_program(std::move(bytes), file);
  if (const Diagnostic* found = parsed.not_printed())
    return Failure{ExitCode::ProgramFailed, klartext::render(*found)};
  return ReadProgram{std::move(parsed.program), is_iso, has_crlf};
}

/// The text of a conversion; what was found is printed. @errors ProgramFailed for a block without
/// a form.
Outcome<std::string> text_of(const std::string& file, iso::Conversion converted) {
  for (const Diagnostic& found : converted.findings)
    fmt::print(stderr, "{}\n", klartext::render(found));
  if (!klartext::contains_error(converted.findings)) return std::move(converted.text);
  return Failure{ExitCode::ProgramFailed,
                 file + " has blocks that DIN/ISO cannot express: nothing was written"};
}

std::string with_crlf(std::string_view text) {
  std::string lines;
  for (const char each : text) lines.append(each == '\n' ? "\r\n" : std::string_view(&each, 1));
  return lines;
}

bool is_iso_name(std::string_view file) {
  return file.size() > 2 && ascii_iequals(file.substr(file.size() - 2), ".i");
}

}  // namespace

Outcome<ExitCode> run_nc_format(const Context& context, const FormatOptions& options) {
  if (options.in_place && options.from_control)
    return Failure{ExitCode::Usage, "--in-place is for local files: remove it with --from-control"};
  for (const std::string& file : options.files) {
    const auto read = read_program(context, file, options.from_control);
    if (!read) return read.error();
    const auto formatted =
        text_of(file, read->is_iso ? iso::to_iso(read->program, {})
                                   : iso::Conversion{klartext::format_program(read->program)});
    if (!formatted) return formatted.error();
    if (!options.in_place) {
      context.print("{}", *formatted);
      continue;
    }
    const auto written = write_file(file, read->has_crlf ? with_crlf(*formatted) : *formatted);
    if (!written) return written.error();
  }
  return ExitCode::Good;
}

Outcome<ExitCode> run_nc_convert(const Context& context, const ConvertOptions& options) {
  const bool is_iso = is_iso_name(options.file);
  if (is_iso == is_iso_name(options.target))
    return Failure{
        ExitCode::Usage,
        "exactly one of the two files must have the ending .i (DIN/ISO): nc convert bore.i bore.h"};
  const auto read = read_program(context, options.file, options.from_control);
  if (!read) return read.error();
  if (read->is_iso != is_iso)
    return Failure{ExitCode::LocalFile,
                   fmt::format("{} contains {}, which does not match its name: rename it",
                               options.file, is_iso ? "Klartext" : "DIN/ISO")};
  const auto text = text_of(options.file, is_iso ? iso::to_klartext(read->program, ".I")
                                                 : iso::to_iso(read->program, ".H"));
  if (!text) return text.error();
  if (const auto allowed = may_replace(options.target, options.force); !allowed)
    return allowed.error();
  const auto written = write_file(options.target, *text);
  return written ? Outcome<ExitCode>(ExitCode::Good) : written.error();
}

}  // namespace fitgauge::cli
