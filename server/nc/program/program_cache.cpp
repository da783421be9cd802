#include "nc/program/program_cache.hpp"

#include "nc/iso/parser.hpp"
#include "nc/program/diagnose.hpp"
#include "tables/tabfile/tab_table.hpp"

namespace fitgauge::interpreter {
namespace {

std::string key_of(const ControlPath& path, std::string_view revision) {
  return fmt::format("{}|{}", path.key(), revision);
}

std::string_view word(FileReference::Kind kind) {
  return word_of(kind, {"program", "table", "mask"});
}

/// Checks a program and the programs that it calls, each file once.
class Walk {
 public:
  Walk(const ControlDisk& disk, ProgramCache& programs, Allowance& allowance)
      : disk_(disk), programs_(programs), allowance_(allowance) {}

  /// @returns whether there is such a program.
  bool visit_all(const ControlPath& main) {
    seen_.insert(main.key());
    if (!visit(main)) return false;
    while (!pending_.empty()) {
      const Named named = std::move(pending_.front());
      pending_.pop_front();
      if (allowance_.is_spent()) {
        warn(named.reference,
             "the programs named are too many to check at once; this one is checked when it is "
             "called",
             DiagnosticCode::ProgramTooLarge);
      } else {
        visit_called(named);
      }
    }
    return true;
  }

  std::vector<Diagnostic> take() { return std::move(diagnostics_); }

 private:
  /// A program to check, and the place of its name.
  struct Named {
    ControlPath path;
    FileReference reference;
    bool has_corner = false;  ///< a caller has the lower corner of the blank
  };

  void visit_called(const Named& named) {
    const auto before = static_cast<std::ptrdiff_t>(diagnostics_.size());
    has_corner_ = named.has_corner;
    visit(named.path);
    if (!named.has_corner) return;
    drop(before, [](const Diagnostic& found) { return found.message == kNoLowerCorner; });
  }

  bool visit(const ControlPath& path) {
    const auto linked = programs_.get(disk_, path);
    if (linked == nullptr) return false;
    const auto& known = linked->with_error_blocks;
    has_corner_ = has_corner_ || known == nullptr || has_lower_corner(known->program());
    add(linked->diagnostics);
    const auto before = static_cast<std::ptrdiff_t>(diagnostics_.size());
    for (const FileReference& reference : linked->references) follow(path, reference);
    if (known == nullptr) return true;
    drop(before, [&](const auto& found) { return is_ignored(known->program(), found); });
    return true;
  }

  /// Drops findings from the place `first` on.
  void drop(std::ptrdiff_t first, const auto& is_dropped) {
    const auto dropped =
        std::remove_if(diagnostics_.begin() + first, diagnostics_.end(), is_dropped);
    diagnostics_.erase(dropped, diagnostics_.end());
  }

  void add(const std::vector<Diagnostic>& found) {
    const std::size_t room = kMostFindings - diagnostics_.size();
    diagnostics_.insert(diagnostics_.end(), found.begin(),
                        found.begin() + static_cast<std::ptrdiff_t>(std::min(room, found.size())));
  }

  void follow(const ControlPath& program, const FileReference& reference) {
    const bool is_program = reference.kind == FileReference::Kind::Program;
    const auto path = ControlPath::resolve(reference.written, program);
    if (path.has_error()) return warn(reference, path.error().message);
    ControlPath named =
        is_program ? path->with_default_extension(program_extension(program)) : *path;
    if (!disk_.exists(named)) {
      return warn(reference,
                  fmt::format("{} '{}' does not exist: the run fails when it reaches this block",
                              word(reference.kind), reference.written));
    }
    if (!reference.columns.empty()) return read_cells(named, reference);
    if (!is_program || !seen_.insert(named.key()).second) return;
    pending_.push_back({std::move(named), reference, has_corner_});
  }

  /// Warns of the first missing column of the table, or of a missing row.
  void read_cells(const ControlPath& path, const FileReference& reference) {
    auto& table = tables_[path.key()];
    if (table == nullptr) {
      const auto file = disk_.find(path);
      if (!file) return;
      table = file->table;
      if (table == nullptr) {
        auto read = tabfile::read_tab_file(*file->bytes, allowance_);
        if (read.has_error()) return;  // another block finds it
        table = std::make_shared<const tabfile::TabTable>(*std::move(read));
      }
    }
    const auto lacks = [&](const Result<std::size_t>& found) {
      if (found) return false;
      warn(reference, found.error().message + ": the run fails when it reaches this block");
      return true;
    };
    for (std::string_view left = reference.columns; !left.empty();)
      if (lacks(table->find_column(trim(take_field(left, ','))))) return;
    if (reference.row) lacks(table->find_row(*reference.row));
  }

  void warn(const FileReference& reference, std::string message,
            DiagnosticCode code = DiagnosticCode::FileMissing) {
    Diagnostic warning = reference.place;
    warning.code = code;
    warning.message = std::move(message);
    add({std::move(warning)});
  }

  const ControlDisk& disk_;
  ProgramCache& programs_;
  Allowance& allowance_;
  bool has_corner_ = false;  ///< of the program that is looked at, or of its callers
  std::set<std::string> seen_;
  std::map<std::string, std::shared_ptr<const tabfile::TabTable>> tables_;
  std::deque<Named> pending_;
  std::vector<Diagnostic> diagnostics_;
};

}  // namespace

std::shared_ptr<const LinkedFile> ProgramCache::at_hand(const std::string& key) {
  const std::lock_guard lock(mutex_);
  const auto it = index_.find(key);
  if (it == index_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, it->second);
  return it->second->file;
}

std::shared_ptr<const LinkedFile> ProgramCache::get(const ControlDisk& disk,
                                                    const ControlPath& path) {
  const auto revision = disk.revision(path);
  if (!revision) return nullptr;
  if (auto linked = at_hand(key_of(path, *revision))) return linked;
  auto file = disk.find(path);
  return file ? get(*std::move(file)) : nullptr;
}

std::shared_ptr<const LinkedFile> ProgramCache::get(ControlFile file) {
  const std::string key = key_of(file.path, file.revision);
  // Files that a run wrote have no revision that other runs share.
  const bool cached = file.source != FileSource::Run;
  if (cached) {
    if (auto linked = at_hand(key)) return linked;
  }
  std::string source = *file.bytes;
  file.bytes.reset();  // a large program is not held twice
  auto linked = std::make_shared<const LinkedFile>(
      link(iso::parse_program(std::move(source), file.path.text()), file.path));
  if (!cached) return linked;

  const std::lock_guard lock(mutex_);
  if (const auto it = index_.find(key); it != index_.end()) return it->second->file;
  entries_.push_front({key, linked});
  index_[key] = entries_.begin();
  bytes_ += linked->memory_bytes;
  while (bytes_ > capacity_ && entries_.size() > 1) {
    bytes_ -= entries_.back().file->memory_bytes;
    index_.erase(entries_.back().key);
    entries_.pop_back();
  }
  return linked;
}

Result<std::vector<Diagnostic>> check(const ControlPath& program, const ControlDisk& disk,
                                      ProgramCache& programs, Allowance& allowance) {
  Walk walk(disk, programs, allowance);
  if (!walk.visit_all(program))
    return Error{ErrorCode::ProgramUnknown, "program not found: " + program.text()};
  return walk.take();
}

}  // namespace fitgauge::interpreter
