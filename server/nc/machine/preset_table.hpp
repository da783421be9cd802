#pragma once

#include <map>
#include <string>

#include "nc/machine/frames.hpp"

namespace fitgauge::machine {

/// The last row that preset.pr can have.
inline constexpr int kLastPreset = 9999;

/// A row of preset.pr.
struct Preset {
  int number = 0;       ///< NO; row 0 is the preset set by hand or by a cycle with Q305 = 0
  std::string comment;  ///< DOC
  PresetFrame frame;
  bool locked = false;  ///< LOCKED: write-protected

  friend bool operator==(const Preset&, const Preset&) = default;
};

/// preset.pr. Not thread-safe; a write replaces a whole row. Row 0 always exists.
class PresetTable {
 public:
  PresetTable();
  const Preset* find(int number) const;
  void write(const Preset& preset);
  const std::map<int, Preset>& rows() const { return rows_; }

 private:
  std::map<int, Preset> rows_;
};

}  // namespace fitgauge::machine
