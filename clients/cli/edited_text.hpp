#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nc/klartext/expression.hpp"
#include "nc/probing/cycle_descriptor.hpp"

namespace fitgauge::cli {

/// A place as an editor counts (LSP 3.17): lines from 0, then UTF-16 code units.
struct Place {
  std::size_t line = 0;
  std::size_t character = 0;
};

/// UTF-8 that an editor changes piece by piece; lines end with CRLF, LF or CR. Places beyond a line
/// or the text are its end.
class EditedText {
 public:
  explicit EditedText(std::string text) : text_(std::move(text)) { find_lines(); }

  const std::string& text() const { return text_; }
  std::size_t lines() const { return starts_.size(); }
  /// Without its line end; empty beyond the last.
  std::string_view line(std::size_t number) const;
  std::size_t start(std::size_t line) const { return starts_[line]; }

  std::size_t offset(Place place) const;
  Place place(std::size_t offset) const;
  /// @param column in characters from 1, as a finding has it
  Place place_of_column(std::size_t line, std::size_t column) const;

  void replace(std::size_t begin, std::size_t end, std::string_view by);

 private:
  void find_lines();

  std::string text_;
  std::vector<std::size_t> starts_;
};

/// A Q, QL, QR or QS as it is written in a line.
struct WrittenParameter {
  std::size_t begin = 0;
  std::size_t end = 0;
  klartext::QRef parameter{};
  bool is_cycles = false;  ///< it stands left of `=` and may be a value of a cycle
};

/// Those of one line of a program or mask; not those of comments, texts and names of files.
std::vector<WrittenParameter> parameters_of(std::string_view line);

/// A line without the wrap and the blanks at its end.
std::string_view without_wrap(std::string_view line);

/// The cycle whose block a line belongs to, in either dialect.
struct CycleAt {
  const probing::CycleDescriptor* cycle = nullptr;
  std::size_t first_line = 0;
  std::size_t dialog = 0;  ///< the column behind its number in its first line
};
std::optional<CycleAt> cycle_at(const EditedText& text, std::size_t line);

}  // namespace fitgauge::cli
