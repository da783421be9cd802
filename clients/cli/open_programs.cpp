#include "cli/open_programs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <memory>
#include <set>
#include <system_error>

#include "base/allowance.hpp"
#include "base/text.hpp"
#include "cli/address.hpp"
#include "cli/input_file.hpp"
#include "http/engine/request_head.hpp"
#include "nc/iso/parser.hpp"
#include "nc/klartext/source_text.hpp"
#include "nc/program/check.hpp"
#include "nc/program/parameter.hpp"

namespace fitgauge::cli {
namespace {

namespace fs = std::filesystem;
using interpreter::ControlPath;
using klartext::QRef;

constexpr std::string_view kFileScheme = "file://";

fs::path path_of(std::string_view uri) {
  std::string path;
  const std::size_t begin = uri.find('/', kFileScheme.size());
  const bool is_file = uri.starts_with(kFileScheme) && begin != uri.npos &&
                       http::append_percent_decoded(path, uri.substr(begin), false) &&
                       path.find('\0') == path.npos;
  return is_file ? fs::path(path).lexically_normal() : fs::path();
}

std::string uri_of(const fs::path& path) {
  std::string uri(kFileScheme);
  for (const fs::path& part : path)
    if (part != "/") uri += '/' + percent_encoded(part.string());
  return uri;
}

bool is_program(const fs::path& path) {
  const std::string extension = ascii_lower(path.extension().string());
  return extension == ".h" || extension == ".i";
}

/// The label that a block calls or jumps to; null if it does neither.
const klartext::Label* called_label(const klartext::Statement& statement) {
  if (const auto* call = std::get_if<klartext::LabelCall>(&statement)) return &call->label;
  const auto* jump = std::get_if<klartext::ConditionalJump>(&statement);
  return jump == nullptr ? nullptr : &jump->target;
}

bool is_same(const klartext::Program& program, const klartext::Label& a, const klartext::Label& b) {
  const auto* first = std::get_if<klartext::Text>(&a);
  const auto* second = std::get_if<klartext::Text>(&b);
  if (first == nullptr || second == nullptr) return a == b;
  return ascii_iequals(program.text(*first), program.text(*second));
}

/// A block that sets or reads several parameters in a row has this one among them.
bool is_in_row(const klartext::Program& program, QRef parameter) {
  const auto holds = [parameter](QRef first, std::ptrdiff_t count) {
    return count > 1 && first.space == parameter.space && parameter.number >= first.number &&
           parameter.number < first.number + count;
  };
  const auto columns_of = [&program](const klartext::Expr& cell) {
    const auto columns = program.operands(std::get<klartext::NodeIndex>(cell)).back();
    const auto* names = std::get_if<klartext::Text>(&columns);
    return names == nullptr ? 1 : std::ranges::count(program.text(*names), ',') + 1;
  };
  return std::ranges::any_of(program.blocks(), [&](const klartext::Block& block) {
    if (const auto* circle = std::get_if<klartext::CircleData>(&block.statement))
      return holds(circle->target, 3) || holds(circle->first_point, 2 * circle->points);
    if (const auto* read = std::get_if<klartext::TableRead>(&block.statement))
      return holds(read->first, columns_of(read->cell));
    const auto* written = std::get_if<klartext::TableWrite>(&block.statement);
    return written != nullptr && holds(written->first, columns_of(written->cell));
  });
}

bool is_of_control(QRef parameter) {
  return parameter.space == klartext::QSpace::Q && parameter.number >= 100 &&
         parameter.number < 200;
}

Error refusal(std::string message) { return Error{ErrorCode::FieldInvalid, std::move(message)}; }

}  // namespace

bool OpenProgram::is_iso() const { return iso::is_iso(text.text(), name.text()); }

/// The folder of a program with the texts that the editor has instead of its files.
class OpenPrograms::Disk final : public interpreter::ControlDisk {
 public:
  Disk(const OpenPrograms& programs, const OpenProgram& main)
      : programs_(programs), folder_(main.path.parent_path()), main_(main) {}

  const OpenProgram* open(const ControlPath& path) const {
    if (path == main_.name) return &main_;
    const auto here = local(path);
    for (const auto& [uri, program] : programs_.all_)
      if (here && program.path == here->lexically_normal()) return &program;
    return nullptr;
  }
  std::optional<interpreter::ControlFile> find(const ControlPath& path) const override {
    const OpenProgram* program = open(path);
    const auto here = local(path);
    if (program == nullptr && !here) return std::nullopt;
    auto bytes = program != nullptr ? program->text.text() : read_file(here->string());
    if (!bytes) return std::nullopt;
    return interpreter::ControlFile{path, std::make_shared<const std::string>(*std::move(bytes)),
                                    revision(path).value_or("")};
  }
  std::optional<std::string> revision(const ControlPath& path) const override {
    if (const OpenProgram* program = open(path)) return fmt::format("open {}", program->revision);
    const auto here = local(path);
    std::error_code failed;
    if (here)
      return fmt::format("{} {} {}", here->string(), fs::file_size(*here, failed),
                         fs::last_write_time(*here, failed).time_since_epoch().count());
    // The service makes these of its tables.
    const bool is_made = ascii_iequals(path.file_name(), "82553_hole.tab") ||
                         ascii_iequals(path.file_name(), "82553_shaft.tab");
    return is_made ? std::optional<std::string>("made") : std::nullopt;
  }
  bool has_directory(std::string_view) const override { return false; }
  std::optional<std::string> uri(const ControlPath& path) const {
    if (const OpenProgram* program = open(path)) return program->uri;
    const auto here = local(path);
    return here ? std::optional(uri_of(here->lexically_normal())) : std::nullopt;
  }
  /// The files and folders of the folder, by name in small letters: case does not count on a
  /// control. Listed once.
  const std::map<std::string, fs::path>& entries() const {
    std::error_code failed;
    if (entries_.empty()) {
      for (const auto& entry : fs::directory_iterator(folder_, failed))
        entries_.emplace(ascii_lower(entry.path().filename().string()), entry.path());
    }
    return entries_;
  }

 private:
  std::optional<fs::path> local(const ControlPath& path) const {
    std::string below = path.text().substr(path.text().find('\\') + 1);
    std::ranges::replace(below, '\\', '/');
    const std::size_t name = below.find('/');
    const auto found = entries().find(ascii_lower(below.substr(0, name)));
    if (found == entries().end()) return std::nullopt;
    const fs::path here =
        name == below.npos ? found->second : found->second / below.substr(name + 1);
    std::error_code failed;
    return fs::is_regular_file(here, failed) ? std::optional(here) : std::nullopt;
  }

  const OpenPrograms& programs_;
  fs::path folder_;
  const OpenProgram& main_;
  mutable std::map<std::string, fs::path> entries_;
};

OpenProgram& OpenPrograms::open(const std::string& uri, std::string text) {
  fs::path path = path_of(uri);
  auto name = ControlPath::parse(
      "TNC:\\" + (path.empty() ? std::string(base_name(uri)) : path.filename().string()));
  if (!name) name = ControlPath::parse(uri.ends_with(".i") ? "TNC:\\PROGRAM.I" : "TNC:\\PROGRAM.H");
  all_.erase(uri);
  return all_
      .emplace(uri, OpenProgram{uri, std::move(path), *std::move(name), EditedText(std::move(text)),
                                ++revisions_})
      .first->second;
}

void OpenPrograms::touch(OpenProgram& program) {
  program.revision = ++revisions_;
  program.is_stale = true;
}

void OpenPrograms::check(OpenProgram& program) {
  program.is_stale = false;
  Allowance unlimited;
  auto found = interpreter::check(program.name, Disk(*this, program), cache_, unlimited);
  program.found = found ? *std::move(found) : std::vector<klartext::Diagnostic>();
  std::erase_if(program.found, [&](const klartext::Diagnostic& each) {
    return each.program != program.name.text();
  });
}

std::optional<OpenPrograms::Target> OpenPrograms::definition(const OpenProgram& program,
                                                             std::size_t line) {
  const auto parsed = iso::parse_program(program.text.text(), program.name.text()).program;
  const klartext::Label* label = nullptr;
  for (const klartext::Block& block : parsed.blocks()) {
    const SourceRange range = parsed.range(block.written);
    if (range.begin.line <= line + 1 && line + 1 <= range.end.line && label == nullptr)
      label = called_label(block.statement);
  }
  for (const klartext::Block& block : parsed.blocks()) {
    const auto* definition = std::get_if<klartext::LabelDefinition>(&block.statement);
    if (label != nullptr && definition != nullptr && is_same(parsed, definition->label, *label))
      return Target{program.uri, parsed.range(block.written).begin.line - 1};
  }
  const Disk disk(*this, program);
  const auto linked = cache_.get(disk, program.name);
  for (const auto& reference : linked->references) {
    if (reference.place.range.begin.line != line + 1) continue;
    const auto path = ControlPath::resolve(reference.written, program.name);
    if (!path) continue;
    const bool is_file = reference.kind != interpreter::FileReference::Kind::Program;
    const auto uri = disk.uri(
        is_file ? *path
                : path->with_default_extension(interpreter::program_extension(program.name)));
    if (uri) return Target{*uri, 0};
  }
  return std::nullopt;
}

/// This program, what it calls or is called by, and so on, with their masks: files of its folder.
std::vector<ControlPath> OpenPrograms::connected(const OpenProgram& program, const Disk& disk) {
  using Kind = interpreter::FileReference::Kind;
  std::deque<ControlPath> waiting{program.name};
  for (const auto& [lower, path] : disk.entries()) {
    const auto name = ControlPath::parse("TNC:\\" + path.filename().string());
    if (name && is_program(path)) waiting.push_back(*name);
  }
  std::map<std::string, ControlPath> known;
  std::multimap<std::string, std::string> calls;
  for (; !waiting.empty(); waiting.pop_front()) {
    const ControlPath caller = waiting.front();
    if (!known.emplace(caller.key(), caller).second) continue;
    const auto linked = cache_.get(disk, caller);
    if (linked == nullptr) continue;
    for (const auto& reference : linked->references) {
      const auto written = ControlPath::resolve(reference.written, caller);
      if (!written || reference.kind == Kind::Table) continue;
      const bool is_called = reference.kind == Kind::Program;
      const ControlPath path =
          is_called ? written->with_default_extension(interpreter::program_extension(caller))
                    : *written;
      if (!disk.uri(path)) continue;
      calls.emplace(caller.key(), path.key());
      calls.emplace(path.key(), caller.key());
      if (is_called) waiting.push_back(path);
      if (!is_called) known.emplace(path.key(), path);
    }
  }
  std::vector<ControlPath> reached{program.name};
  std::set<std::string> seen{program.name.key()};
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const auto [begin, end] = calls.equal_range(reached[i].key());
    for (auto at = begin; at != end; ++at)
      if (seen.insert(at->second).second) reached.push_back(known.at(at->second));
  }
  return reached;
}

Result<std::map<std::string, OpenPrograms::Renamed>> OpenPrograms::rename(
    const OpenProgram& program, QRef from, std::string_view to) {
  const auto name = interpreter::parse_parameter_name(to);
  if (!name) return name.error();
  if (name->space != from.space)
    return refusal(
        fmt::format("{} must stay of its kind: Q, QL, QR or QS", interpreter::name(from)));
  for (const QRef each : {from, *name}) {
    if (is_of_control(each))
      return refusal(fmt::format("the control and its cycles set {}: Q100 to Q199 keep their names",
                                 interpreter::name(each)));
  }
  const Disk disk(*this, program);
  std::map<std::string, Renamed> renamed;
  const auto files =
      from.space == klartext::QSpace::Ql ? std::vector{program.name} : connected(program, disk);
  for (const ControlPath& path : files) {
    const auto file = disk.find(path);
    if (!file) continue;
    const EditedText text(disk.open(path) != nullptr ? *file->bytes
                                                     : klartext::decode_source(*file->bytes));
    const auto parsed = iso::parse_program(text.text(), path.text()).program;
    for (std::size_t line = 0; line < text.lines(); ++line) {
      for (const auto& written : parameters_of(text.line(line))) {
        const auto shown = fmt::format("{}, line {}", path.file_name(), line + 1);
        if (written.parameter == *name && from != *name)
          return refusal(fmt::format("{} is used already: {}", interpreter::name(*name), shown));
        if (written.parameter != from) continue;
        if (written.is_cycles && cycle_at(text, line))
          return refusal(
              fmt::format("{} is a parameter of a cycle: {}", interpreter::name(from), shown));
        renamed[*disk.uri(path)].places.emplace_back(text.place(text.start(line) + written.begin),
                                                     text.place(text.start(line) + written.end));
      }
    }
    for (const QRef each : {from, *name}) {
      if (is_in_row(parsed, each))
        return refusal(
            fmt::format("a block of {} sets or reads several parameters in a row, {} among "
                        "them: rename it there first",
                        path.file_name(), interpreter::name(each)));
    }
  }
  return renamed;
}

}  // namespace fitgauge::cli
