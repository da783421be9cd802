#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.hpp"
#include "cli/edited_text.hpp"
#include "nc/klartext/diagnostic.hpp"
#include "nc/program/control_disk.hpp"
#include "nc/program/program_cache.hpp"

namespace fitgauge::cli {

/// A program as an editor has it.
struct OpenProgram {
  std::string uri;
  std::filesystem::path path;     ///< empty when no file has it
  interpreter::ControlPath name;  ///< as if its folder were TNC:\.
  EditedText text;
  std::uint64_t revision = 0;            ///< of the text; no two are the same
  std::optional<std::size_t> version{};  ///< that of the editor
  bool is_stale = true;                  ///< `found` is not that of the text
  std::vector<klartext::Diagnostic> found{};

  bool is_iso() const;
};

/// The programs of an editor, and the files beside them. Single-threaded.
class OpenPrograms {
 public:
  /// By URI.
  std::map<std::string, OpenProgram>& all() { return all_; }
  OpenProgram& open(const std::string& uri, std::string text);
  /// The text has changed.
  void touch(OpenProgram& program);

  /// Fills `found` with what a check says about this program.
  void check(OpenProgram& program);

  struct Target {
    std::string uri;
    std::size_t line = 0;
  };
  /// Of a line: the label that it calls or jumps to, or the file that it names.
  std::optional<Target> definition(const OpenProgram& program, std::size_t line);

  struct Renamed {
    std::vector<std::pair<Place, Place>> places;
  };
  /// By URI, the places of a parameter in this program and, unless it is a QL, in all that call it
  /// or are called, masks too.
  /// @errors FieldInvalid: the new name is none, is used already or means another kind of value; or
  ///   the control, a cycle, a table or a circle sets one of both.
  Result<std::map<std::string, Renamed>> rename(const OpenProgram& program, klartext::QRef from,
                                                std::string_view to);

 private:
  class Disk;
  std::vector<interpreter::ControlPath> connected(const OpenProgram& program, const Disk& disk);

  std::map<std::string, OpenProgram> all_;
  interpreter::ProgramCache cache_;
  std::uint64_t revisions_ = 0;
};

}  // namespace fitgauge::cli
