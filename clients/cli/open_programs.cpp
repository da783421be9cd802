#include "cli/open_programs.hpp"

#include "cli/local_files.hpp"
#include "cli/nc_commands.hpp"
#include "http/engine/request_head.hpp"
#include "nc/iso/parser.hpp"

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
                       http::append_percent_decoded(path, uri.substr(begin), false);
  return is_file ? fs::path(path).lexically_normal() : fs::path();
}

std::string uri_of(const fs::path& path) {
  std::string uri(kFileScheme);
  for (const fs::path& part : path)
    if (part != "/") uri += '/' + percent_encoded(part.string());
  return uri;
}

/// The bytes of the character that begins here.
std::size_t width(char first) {
  const auto byte = static_cast<unsigned char>(first);
  return byte < 0x80 ? 1 : byte < 0xE0 ? 2 : byte < 0xF0 ? 3 : 4;
}
std::size_t units(char first) { return width(first) == 4 ? 2 : 1; }

/// Returns the label that a block calls or jumps to; null if there is none.
const klartext::Label* called_label(const klartext::Statement& statement) {
  if (const auto* call = std::get_if<klartext::LabelCall>(&statement)) return &call->label;
  const auto* jump = std::get_if<klartext::ConditionalJump>(&statement);
  return jump == nullptr ? nullptr : &jump->target;
}

bool is_same_label(const klartext::Program& program, const klartext::Label& a,
                   const klartext::Label& b) {
  const auto* first = std::get_if<klartext::Text>(&a);
  const auto* second = std::get_if<klartext::Text>(&b);
  if (first == nullptr || second == nullptr) return a == b;
  return ascii_iequals(program.text(*first), program.text(*second));
}

/// A file that a program names, or nothing if that is no path.
std::optional<ControlPath> named(const interpreter::FileReference& reference,
                                 const ControlPath& program) {
  auto path = ControlPath::resolve(reference.written, program);
  if (!path) return std::nullopt;
  if (reference.kind != interpreter::FileReference::Kind::Program) return *path;
  return path->with_default_extension(interpreter::program_extension(program));
}

/// The reason why a parameter is not renamed to or from this name, by the line that has `written`.
std::string obstacle(QRef from, QRef to, std::string_view line, const WrittenParameter& written) {
  constexpr int kLongestRow = 8;
  const auto has = [&line](std::string_view word) { return line.find(word) != line.npos; };
  const bool is_row = has("CDATA") || has("D23 ") || has("D24 ") || (has("TAB") && has(","));
  for (const QRef each : {from, to}) {
    const bool is_in_row = is_row && each.space == written.parameter.space &&
                           each.number >= written.parameter.number &&
                           each.number < written.parameter.number + kLongestRow;
    if (is_in_row) return "may belong to a row of parameters there";
  }
  if (written.parameter == to) return "is used already";
  return written.parameter == from && written.is_cycles ? "is a parameter of a cycle" : "";
}

}  // namespace

void EditedText::find_lines() {
  static std::uint64_t last_revision = 0;
  revision_ = ++last_revision;
  tree_.reset();
  starts_.assign(1, 0);
  for (std::size_t at = 0; (at = text_.find_first_of("\r\n", at)) != text_.npos;) {
    at += text_.compare(at, 2, "\r\n") == 0 ? 2U : 1U;
    starts_.push_back(at);
  }
}

std::string_view EditedText::line(std::size_t number) const {
  if (number >= starts_.size()) return {};
  const auto rest = std::string_view(text_).substr(starts_[number]);
  return rest.substr(0, rest.find_first_of("\r\n"));
}

std::size_t EditedText::column(Place place) const {
  const std::string_view line = this->line(place.line);
  std::size_t at = 0;
  for (std::size_t seen = 0; at < line.size(); at += width(line[at])) {
    seen += units(line[at]);
    if (seen > place.character) break;
  }
  return at;
}

Place EditedText::place(std::size_t line, std::size_t column) const {
  const std::string_view written = this->line(line);
  Place place{line, 0};
  for (std::size_t at = 0; at < std::min(column, written.size()); at += width(written[at]))
    place.character += units(written[at]);
  return place;
}

Place EditedText::place_of_column(std::size_t line, std::size_t column) const {
  const std::string_view written = this->line(line);
  std::size_t at = line == 0 && written.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  for (; column > 1 && at < written.size(); --column) at += width(written[at]);
  return place(line, at);
}

void EditedText::replace(Place begin, Place end, std::string_view by) {
  const auto offset = [this](Place place) {
    return place.line < starts_.size() ? starts_[place.line] + column(place) : text_.size();
  };
  const std::size_t first = offset(begin);
  text_.replace(first, std::max(first, offset(end)) - first, by);
  find_lines();
}

bool EditedText::is_iso() const { return iso::is_iso(text_, name_); }

const klartext::Program& EditedText::tree() const {
  if (!tree_) tree_ = iso::parse_program(text_, name_).program;
  return *tree_;
}

/// Folder of a program, with the editor's texts in place of its files.
class OpenPrograms::Disk final : public interpreter::ControlDisk {
 public:
  Disk(const OpenPrograms& programs, const OpenProgram& main) : programs_(programs), main_(main) {
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator(main.path.parent_path(), failed))
      entries_.emplace(ascii_lower(entry.path().filename().string()), entry.path());
  }

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
    if (const OpenProgram* program = open(path))
      return fmt::format("open {}", program->text.revision());
    std::error_code failed;
    if (const auto here = local(path))
      return fmt::format("{} {} {}", here->string(), fs::file_size(*here, failed),
                         fs::last_write_time(*here, failed).time_since_epoch().count());
    // The service makes these files from its tables.
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
  /// By name in lower case, because a control ignores case.
  const std::map<std::string, fs::path>& entries() const { return entries_; }

 private:
  std::optional<fs::path> local(const ControlPath& path) const {
    if (main_.path.empty()) return std::nullopt;
    const fs::path folder = main_.path.parent_path();
    return find_below(folder.empty() ? "." : folder, path.text());
  }

  const OpenPrograms& programs_;
  const OpenProgram& main_;
  std::map<std::string, fs::path> entries_;
};

OpenProgram& OpenPrograms::open(const std::string& uri, std::string text) {
  fs::path path = path_of(uri);
  const std::string base(path.empty() ? base_name(uri) : path.filename().string());
  auto name = ControlPath::parse("TNC:\\" + base);
  if (!name) name = ControlPath::parse(uri.ends_with(".i") ? "TNC:\\PROGRAM.I" : "TNC:\\PROGRAM.H");
  OpenProgram program{uri, std::move(path), *name, EditedText(std::move(text), name->text())};
  return all_.insert_or_assign(uri, std::move(program)).first->second;
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

std::optional<std::pair<std::string, std::size_t>> OpenPrograms::definition(
    const OpenProgram& program, std::size_t line) {
  const klartext::Program& parsed = program.text.tree();
  const klartext::Label* label = nullptr;
  for (const klartext::Block& block : parsed.blocks()) {
    const SourceRange range = parsed.range(block.written);
    if (range.begin.line <= line + 1 && line + 1 <= range.end.line && label == nullptr)
      label = called_label(block.statement);
  }
  for (const klartext::Block& block : parsed.blocks()) {
    const auto* target = std::get_if<klartext::LabelDefinition>(&block.statement);
    if (label != nullptr && target != nullptr && is_same_label(parsed, target->label, *label))
      return std::pair(program.uri, std::size_t{parsed.range(block.written).begin.line} - 1);
  }
  const Disk disk(*this, program);
  for (const auto& reference : cache_.get(disk, program.name)->references) {
    const auto path = named(reference, program.name);
    const auto uri = path ? disk.uri(*path) : std::nullopt;
    if (uri && reference.place.range.begin.line == line + 1) return std::pair(*uri, std::size_t{0});
  }
  return std::nullopt;
}

/// This program, its called programs and callers, and so on, with their masks: files of its folder.
std::vector<ControlPath> OpenPrograms::connected(const OpenProgram& program, const Disk& disk) {
  std::deque<ControlPath> waiting{program.name};
  for (const auto& [lower, path] : disk.entries()) {
    const auto name = ControlPath::parse("TNC:\\" + path.filename().string());
    if (name && (lower.ends_with(".h") || lower.ends_with(".i"))) waiting.push_back(*name);
  }
  std::map<std::string, ControlPath> known;
  std::multimap<std::string, std::string> calls;
  for (; !waiting.empty(); waiting.pop_front()) {
    const ControlPath caller = waiting.front();
    const auto linked =
        known.emplace(caller.key(), caller).second ? cache_.get(disk, caller) : nullptr;
    if (linked == nullptr) continue;
    for (const auto& reference : linked->references) {
      const auto path = named(reference, caller);
      if (!path || reference.kind == interpreter::FileReference::Kind::Table) continue;
      if (!disk.uri(*path)) continue;
      calls.emplace(caller.key(), path->key());
      calls.emplace(path->key(), caller.key());
      const bool is_called = reference.kind == interpreter::FileReference::Kind::Program;
      if (is_called) waiting.push_back(*path);
      if (!is_called) known.emplace(path->key(), *path);
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

Result<Changes> OpenPrograms::rename(const OpenProgram& program, const WrittenParameter& from,
                                     std::string_view to) {
  const auto refuse = [](QRef parameter, std::string_view reason) {
    return Error::of(ErrorCode::FieldInvalid, "{} {}", interpreter::name(parameter), reason);
  };
  const QRef old = from.parameter;
  const auto name = TRY(interpreter::parse_parameter_name(to));
  if (name.space != old.space) return refuse(old, "must keep its kind: Q, QL, QR or QS");
  for (const QRef each : {old, name}) {
    if (each.space == klartext::QSpace::Q && each.number >= 100 && each.number < 200)
      return refuse(each, "is set by the control: Q100 to Q199 keep their names");
  }
  const Disk disk(*this, program);
  Changes changes;
  const bool is_local = old.space == klartext::QSpace::Ql;
  for (const auto& path : is_local ? std::vector{program.name} : connected(program, disk)) {
    const auto file = disk.find(path);
    if (!file) continue;
    const OpenProgram* here = disk.open(path);
    const EditedText text(here != nullptr ? *file->bytes : klartext::decode_source(*file->bytes),
                          path.text());
    for (std::size_t line = 0; line < text.lines(); ++line) {
      for (const WrittenParameter& written : parameters_of(text, line)) {
        const std::string reason = obstacle(old, name, text.line(line), written);
        if (!reason.empty() && old != name)
          return refuse(written.parameter,
                        fmt::format("{}: {}, line {}", reason, path.file_name(), line + 1));
        if (written.parameter == old)
          changes[*disk.uri(path)].push_back(
              {text.place(line, written.begin), text.place(line, written.end), std::string(to)});
      }
    }
  }
  return changes;
}

}  // namespace fitgauge::cli
