#include "program/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <set>

#include "klartext/parser.hpp"
#include "program/diagnose.hpp"

namespace fitgauge::interpreter {
namespace {

using klartext::Diagnostic;
using klartext::Severity;

/// Programs beyond this many bytes are not looked into.
constexpr std::size_t kMostBytes = std::size_t{64} << 20;

std::string_view word(FileReference::Kind kind) {
  switch (kind) {
    case FileReference::Kind::Program: return "program";
    case FileReference::Kind::Table: return "table";
    case FileReference::Kind::Mask: return "mask";
  }
  return {};
}

/// Walks a program and what it calls, each file once.
class Walk {
 public:
  Walk(const ControlDisk& disk, ProgramCache& programs) : disk_(disk), programs_(programs) {}

  void visit(const ControlFile& file) {
    if (!seen_.insert(file.path.key()).second) return;
    bytes_ += file.bytes->size();
    const auto linked = programs_.get(file);
    add(linked->diagnostics);
    for (const FileReference& reference : linked->references) follow(file.path, reference);
  }

  void visit_all(const ControlFile& main) {
    pending_.push_back(main);
    while (!pending_.empty()) {
      const ControlFile file = std::move(pending_.front());
      pending_.pop_front();
      visit(file);
    }
  }

  std::vector<Diagnostic> take() { return std::move(diagnostics_); }

 private:
  void add(const std::vector<Diagnostic>& found) {
    const std::size_t room = kMostFindings - diagnostics_.size();
    diagnostics_.insert(diagnostics_.end(), found.begin(),
                        found.begin() + static_cast<std::ptrdiff_t>(std::min(room, found.size())));
  }

  void follow(const ControlPath& program, const FileReference& reference) {
    const bool is_program = reference.kind == FileReference::Kind::Program;
    const auto path = ControlPath::resolve(reference.written, program);
    if (path.has_error()) return warn(reference, path.error().message);
    const auto file =
        disk_.find(is_program ? path->with_default_extension(kProgramExtension) : *path);
    if (!file) {
      return warn(reference,
                  fmt::format("{} '{}' does not exist: the run fails when it reaches this block",
                              word(reference.kind), reference.written));
    }
    if (!is_program) return;
    if (bytes_ <= kMostBytes) {
      pending_.push_back(*file);
      return;
    }
    warn(reference,
         "the programs named are too many to check at once; this one is checked when it is called",
         klartext::DiagnosticCode::ProgramTooLarge);
  }

  void warn(const FileReference& reference, std::string message,
            klartext::DiagnosticCode code = klartext::DiagnosticCode::FileMissing) {
    Diagnostic warning = reference.place;
    warning.code = code;
    warning.message = std::move(message);
    add({std::move(warning)});
  }

  const ControlDisk& disk_;
  ProgramCache& programs_;
  std::set<std::string> seen_;
  std::deque<ControlFile> pending_;
  std::vector<Diagnostic> diagnostics_;
  std::size_t bytes_ = 0;
};

}  // namespace

Result<std::vector<Diagnostic>> check(const ControlPath& program, const ControlDisk& disk,
                                      ProgramCache& programs) {
  const auto file = disk.find(program);
  if (!file) {
    return Error{ErrorCode::ProgramUnknown, "there is no program " + program.text()};
  }
  Walk walk(disk, programs);
  walk.visit_all(*file);
  return walk.take();
}

bool has_errors(const std::vector<Diagnostic>& diagnostics) {
  return std::any_of(diagnostics.begin(), diagnostics.end(), [](const Diagnostic& diagnostic) {
    return diagnostic.severity == Severity::Error;
  });
}

}  // namespace fitgauge::interpreter
