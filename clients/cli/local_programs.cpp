#include "cli/nc_commands.hpp"

#include "api/runs/run_codec.hpp"
#include "cli/local_files.hpp"
#include "nc/iso/parser.hpp"
#include "nc/klartext/parser.hpp"
#include "tables/tabfile/characters.hpp"

namespace fitgauge::cli {
namespace {

using klartext::Diagnostic;
using klartext::DiagnosticCode;
using klartext::Severity;

struct Code {
  std::string_view id;
  bool is_error;  ///< always
};
constexpr Code kCodes[] = {
#define KLARTEXT_DIAGNOSTIC(name, id) {id, false},
#define KLARTEXT_ERROR(name, id) {id, true},
#include "nc/klartext/diagnostic_codes.inc"
};

JsonObject sarif_region(SourceRange range) {
  JsonObject region;
  region.add("startLine", std::max(range.begin.line, 1U));
  region.add("startColumn", std::max(range.begin.column, 1U));
  return region;
}

std::string sarif_artifact(std::string uri) {
  std::ranges::replace(uri, '\\', '/');
  return fmt::format(R"({{"uri":{}}})", json_string(percent_encoded(uri, "/:")));
}

JsonObject sarif_place(const std::string& uri, SourceRange range) {
  JsonObject place;
  place.add_raw("physicalLocation", fmt::format(R"({{"artifactLocation":{},"region":{}}})",
                                                sarif_artifact(uri), sarif_region(range).text()));
  return place;
}

std::string sarif_message(const std::string& text) {
  return fmt::format(R"({{"text":{}}})", json_string(text));
}

std::string sarif_fix(const Diagnostic& found, const klartext::DiagnosticRemedy& remedy) {
  std::string changes;
  for (const auto& [range, by] : remedy.edits)
    changes += fmt::format(
        R"({}{{"deletedRegion":{},"insertedContent":{}}})", changes.empty() ? "" : ",",
        sarif_region(range).add("endColumn", range.end.column).text(), sarif_message(by));
  return fmt::format(
      R"({{"description":{},"artifactChanges":[{{"artifactLocation":{},"replacements":[{}]}}]}})",
      sarif_message(remedy.title), sarif_artifact(found.program), changes);
}

std::string sarif_of(const Diagnostic& found) {
  JsonObject result;
  result.add("ruleId", id(found.code)).add("level", word(found.severity));
  result.add_raw("message", sarif_message(found.message));
  result.add_raw("locations", "[" + sarif_place(found.program, found.range).text() + "]");
  std::string others;
  for (const klartext::DiagnosticNote& note : found.notes) {
    JsonObject place = sarif_place(note.program.empty() ? found.program : note.program, note.range);
    place.add_raw("message", sarif_message(note.message));
    others += (others.empty() ? "" : ",") + place.text();
  }
  if (!others.empty()) result.add_raw("relatedLocations", "[" + others + "]");
  std::string fixes;
  for (const klartext::DiagnosticRemedy& remedy : found.remedies) {
    if (!remedy.edits.empty()) fixes += (fixes.empty() ? "" : ",") + sarif_fix(found, remedy);
  }
  if (!fixes.empty()) result.add_raw("fixes", "[" + fixes + "]");
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
        R"({{"version":"2.1.0","runs":[{{"tool":{{"driver":{{"name":"fitgauge","version":"{}"}}}},"columnKind":"unicodeCodePoints","results":[{}]}}]}})"
        "\n",
        FITGAUGE_VERSION, items);
  }
}

/// The content of a file of the service. @errors as of the service
Outcome<std::vector<Diagnostic>> found_there(const Context& context, const std::string& file) {
  const auto answer =
      TRY(context.send({.method = "POST", .target = file_target(file) + "?action=check"}));
  const auto document = TRY(context.document_of(answer));
  std::vector<Diagnostic> all;
  for (const JsonValue& item : document.member("diagnostics").items) {
    Diagnostic& found = all.emplace_back();
    for (const Severity each : {Severity::Note, Severity::Warning, Severity::Error}) {
      if (item.text_of("severity") == word(each)) found.severity = each;
    }
    const auto* code = std::ranges::find(kCodes, item.text_of("code"), &Code::id);
    if (code != std::end(kCodes)) found.code = static_cast<DiagnosticCode>(code - kCodes);
    found.message = item.text_of("message");
    found.program = item.text_of("program");
    found.source = item.text_of("source");
    const auto place_of = [](const JsonValue& of) {
      const auto number = [&of](std::string_view name) {
        return read_number<std::uint32_t>(of.text_of(name)).value_or(0);
      };
      return SourceRange{.begin = {number("line"), number("column")}, .end = {}};
    };
    found.range = place_of(item);
    found.block = read_number<std::uint32_t>(item.text_of("block"));
    for (const JsonValue& note : item.member("notes").items) {
      found.notes.push_back({.message = std::string(note.text_of("message")),
                             .range = place_of(note),
                             .program = std::string(note.text_of("program"))});
    }
  }
  return all;
}

struct CheckOptions {
  std::vector<std::string> files;
  bool from_control = false;  ///< use files of the service
  std::string format{};       ///< text, json or sarif; text when empty, json with --json
  std::vector<std::string> levels{};
  RunOptions run{};  ///< with a setup_file the programs also run on it
};

/// `nc check FILE…`: checks local programs without a service, or programs of the service, and the
/// programs they call. Exit code 0: nothing or notes, 1: warnings, 2: errors. @errors LocalFile,
/// Refused for the setup, Usage for a malformed level or parameter.
Outcome<ExitCode> run_nc_check(const Context& context, const CheckOptions& options) {
  const auto levels = TRY(read_levels(options.levels));
  if (options.from_control && !options.run.setup_file.empty())
    return Failure{ExitCode::Usage, "--setup is for local files: remove it with --from-control"};
  std::vector<Diagnostic> all;
  std::optional<Failure> failed;
  for (const std::string& file : options.files) {
    RunOptions run = options.run;
    run.program = file;
    auto found = options.from_control ? found_there(context, file) : found_here(run);
    if (!found) {
      failed = found.error();
      continue;
    }
    apply_levels(levels, *found);
    for (Diagnostic& each : *found) {  // another file may call this one
      const bool is_known = std::ranges::any_of(all, [&](const Diagnostic& other) {
        return other.program == each.program && other.code == each.code &&
               other.range == each.range && other.message == each.message;
      });
      if (!is_known) all.push_back(std::move(each));
    }
  }
  print(context, !options.format.empty() ? options.format : context.json ? "json" : "text", all);
  if (failed) return *std::move(failed);
  auto worst = Severity::Note;
  for (const Diagnostic& each : all) worst = std::max(worst, each.severity);
  return static_cast<ExitCode>(worst);  // 0, 1, 2
}

struct ReadProgram {
  klartext::Program program;
  bool is_iso = false;
  bool has_crlf = false;
  bool has_mark = false;  ///< the byte order mark of UTF-8
  bool is_utf8 = true;    ///< else Windows-1252

  /// A text in the encoding and with the line ends that the file has.
  std::string as_written(std::string_view text) const;
};

constexpr std::string_view kMark = "\xEF\xBB\xBF";

std::string ReadProgram::as_written(std::string_view text) const {
  std::map<std::string, char> bytes;
  for (int byte = 0x80; byte < 0x100; ++byte)
    bytes[utf8_from_windows1252(std::string(1, static_cast<char>(byte)))] = static_cast<char>(byte);
  std::string written(has_mark ? kMark : "");
  for (std::size_t at = 0, next = 0; at < text.size(); at = next) {
    next = tabfile::skip_characters(text, at, 1);
    const auto character = std::string(text.substr(at, next - at));
    const auto byte = bytes.find(character);
    if (!is_utf8 && byte != bytes.end()) {
      written += byte->second;
    } else {
      written += has_crlf && character == "\n" ? "\r\n" : character;
    }
  }
  return written;
}

/// Reads a local program or one of the service.
/// @errors those of reading it, and ProgramFailed for a program with errors.
Outcome<ReadProgram> read_program(const Context& context, const std::string& file,
                                  bool from_control) {
  std::string bytes;
  if (from_control) {
    auto answer = TRY(context.send({.target = file_target(file)}));
    bytes = std::move(answer.body);
  } else {
    bytes = TRY(read_file(file));
  }
  const bool is_iso = iso::is_iso(bytes, file);
  ReadProgram read{.program = {},
                   .is_iso = is_iso,
                   .has_crlf = bytes.find("\r\n") != bytes.npos,
                   .has_mark = bytes.starts_with(kMark),
                   .is_utf8 = is_utf8(bytes)};
  auto parsed = iso::parse_program(std::move(bytes), file);
  if (const Diagnostic* found = parsed.not_printed())
    return Failure{ExitCode::ProgramFailed, klartext::render(*found)};
  read.program = std::move(parsed.program);
  return read;
}

/// The text of a conversion; prints its findings. @errors ProgramFailed: a block has no such form.
Outcome<std::string> text_of(const std::string& file, iso::Conversion converted) {
  for (const Diagnostic& found : converted.findings)
    fmt::print(stderr, "{}\n", klartext::render(found));
  if (!klartext::has_errors(converted.findings)) return std::move(converted.text);
  return Failure{ExitCode::ProgramFailed,
                 file + " has blocks that DIN/ISO cannot express: nothing was written"};
}

bool is_iso_name(std::string_view file) {
  return file.size() > 2 && ascii_iequals(file.substr(file.size() - 2), ".i");
}

struct FormatOptions {
  std::vector<std::string> files;
  bool in_place = false;  ///< writes the files; otherwise prints
  bool from_control = false;
};

/// `nc format FILE…`: formats a program as a control lists it; a file keeps its encoding and line
/// ends.
/// @errors LocalFile, ProgramFailed for an unreadable program.
Outcome<ExitCode> run_nc_format(const Context& context, const FormatOptions& options) {
  if (options.in_place && options.from_control)
    return Failure{ExitCode::Usage, "--in-place is for local files: remove it with --from-control"};
  for (const std::string& file : options.files) {
    const auto read = TRY(read_program(context, file, options.from_control));
    const auto formatted =
        TRY(text_of(file, read.is_iso ? iso::to_iso(read.program, {})
                                      : iso::Conversion{klartext::format_program(read.program)}));
    if (!options.in_place) {
      context.print("{}", formatted);
      continue;
    }
    TRY(write_file(file, read.as_written(formatted)));
  }
  return ExitCode::Good;
}

struct ConvertOptions {
  std::string file;
  std::string target;         ///< a file here
  bool from_control = false;  ///< `file` is on the service
  bool force = false;         ///< replace a file that is there
};

/// `nc convert A.i A.h` and `A.h A.i`: the program in the other dialect. @errors Usage for other
/// names, LocalFile, ProgramFailed for a program with errors or a block without a form there.
Outcome<ExitCode> run_nc_convert(const Context& context, const ConvertOptions& options) {
  const bool is_iso = is_iso_name(options.file);
  if (is_iso == is_iso_name(options.target))
    return Failure{
        ExitCode::Usage,
        "exactly one of the two files must have the ending .i (DIN/ISO): nc convert bore.i bore.h"};
  const auto read = TRY(read_program(context, options.file, options.from_control));
  if (read.is_iso != is_iso)
    return Failure::of(ExitCode::LocalFile,
                       "{} contains {}, which does not match its name: rename it", options.file,
                       is_iso ? "Klartext" : "DIN/ISO");
  const auto text = TRY(text_of(options.file, is_iso ? iso::to_klartext(read.program, ".I")
                                                     : iso::to_iso(read.program, ".H")));
  TRY(may_replace(options.target, options.force));
  const auto written = write_file(options.target, read.as_written(text));
  return written ? Outcome<ExitCode>(ExitCode::Good) : written.error();
}

}  // namespace

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
      return Failure::of(ExitCode::Usage,
                         "--level must be CODE= and one of: off, note, warning, error; got '{}'",
                         level);
    }
    const std::string code = level.substr(0, equals);
    const auto* known = std::ranges::find(kCodes, code, &Code::id);
    if (known == std::end(kCodes))
      return Failure::of(ExitCode::Usage, "--level: unknown finding '{}'", code);
    if (known->is_error)
      return Failure::of(ExitCode::Usage, "--level: '{}' is always an error: correct the program",
                         code);
    levels[code] = severity;
  }
  return levels;
}

void apply_levels(const Levels& levels, std::vector<Diagnostic>& found) {
  std::erase_if(found, [&](Diagnostic& each) {
    const auto level = levels.find(id(each.code));
    if (level == levels.end() || each.severity == Severity::Error) return false;
    each.severity = level->second.value_or(each.severity);
    return !level->second;
  });
}

void add_levels(CLI::App& command, std::vector<std::string>& levels) {
  add_repeated(command, "--level", levels, "Level of a code: CODE=off, note, warning or error");
}

void add_programs(CLI::App& nc, Action& chosen) {
  const auto [check, checked] =
      add_command(nc, "check", "Check programs, local or on the control", chosen, run_nc_check);
  check->add_option("files", checked->files, "Local files, or paths on the control")->required();
  check->add_flag("--from-control", checked->from_control, "Use files of the service");
  check->add_option("--format", checked->format, "Format of the findings: text, json, sarif")
      ->check(CLI::IsMember({"text", "json", "sarif"}));
  add_levels(*check, checked->levels);
  check
      ->add_option("--setup", checked->run.setup_file,
                   "JSON file with a setup; the check also runs the programs on it")
      ->type_name("FILE");
  add_repeated(*check, "--set", checked->run.parameters,
               "Parameter that is set before block 0 of this run: Q1=25");

  const auto [format, formatted] =
      add_command(nc, "format", "Format programs as a control does", chosen, run_nc_format);
  format->add_option("files", formatted->files, "Local files, or paths on the control")->required();
  format->add_flag("--in-place", formatted->in_place, "Write to the files (default: print)");
  format->add_flag("--from-control", formatted->from_control, "Use files of the service");

  const auto [convert, converted] = add_command(
      nc, "convert", "DIN/ISO to Klartext or back: nc convert a.i a.h", chosen, run_nc_convert);
  convert->add_option("file", converted->file, "Local file, or path on the control")->required();
  convert->add_option("target", converted->target, "Local file for the converted program")
      ->required();
  convert->add_flag("--from-control", converted->from_control, "Use a program of the service");
  convert->add_flag("--force", converted->force, "Replace an existing file");
}

}  // namespace fitgauge::cli
