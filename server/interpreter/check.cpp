#include "interpreter/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <set>

#include "interpreter/diagnose.hpp"
#include "klartext/parser.hpp"

namespace fitgauge::interpreter {
namespace {

using klartext::Diagnostic;
using klartext::DiagnosticCode;
using klartext::Severity;

std::string_view word(FileReference::Kind kind) {
  switch (kind) {
    case FileReference::Kind::Program:
      return "program";
    case FileReference::Kind::Table:
      return "table";
    case FileReference::Kind::Mask:
      return "mask";
  }
  return {};
}

/// Walks a program and what it calls, each file once.
class Walk {
 public:
  Walk(const ControlDisk& disk, ProgramCache& programs) : disk_(disk), programs_(programs) {}

  void visit(const ControlFile& file) {
    if (!seen_.insert(file.path.key()).second) return;
    const auto linked = programs_.get(file);
    add(linked->diagnostics);
    if (linked->program != nullptr) {
      for (const FileReference& reference : linked->program->references()) {
        follow(*linked->program, reference);
      }
    }
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

  void follow(const LinkedProgram& program, const FileReference& reference) {
    const bool is_program = reference.kind == FileReference::Kind::Program;
    const auto path = ControlPath::resolve(reference.written, program.path());
    if (path.has_error()) {
      warn(program, reference, path.error().message);
      return;
    }
    const auto file =
        disk_.find(is_program ? path->with_default_extension(kProgramExtension) : *path);
    if (!file) {
      warn(program, reference,
           fmt::format("{} '{}' does not exist: the run fails when it reaches this block",
                       word(reference.kind), reference.written));
    } else if (is_program) {
      pending_.push_back(*file);
    }
  }

  void warn(const LinkedProgram& program, const FileReference& reference, std::string message) {
    const auto& source = program.program();
    add({diagnose(source, source.blocks()[reference.block], Severity::Warning,
                  DiagnosticCode::FileMissing, std::move(message))});
  }

  const ControlDisk& disk_;
  ProgramCache& programs_;
  std::set<std::string> seen_;
  std::deque<ControlFile> pending_;
  std::vector<Diagnostic> diagnostics_;
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
