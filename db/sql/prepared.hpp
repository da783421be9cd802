#pragma once

#include <cstdint>
#include <string_view>

#include "base/digest.hpp"

namespace fitgauge::store::sql {

/// What a NULL stands for: an engine that knows its types before the values asks.
enum class Kind : std::uint8_t { Integer, Text, Bytes };

/// A statement that an engine has prepared, with the row it stands at. Parameters count from 1,
/// columns from 0. Texts that are bound and read are not copied: those bound live until the
/// statement has run, those read until its next step.
class Prepared {
 public:
  Prepared() = default;
  Prepared(const Prepared&) = delete;
  Prepared& operator=(const Prepared&) = delete;
  virtual ~Prepared() = default;

  virtual void bind_null(int index, Kind kind) = 0;
  virtual void bind_integer(int index, std::int64_t value) = 0;
  virtual void bind_text(int index, std::string_view value) = 0;
  virtual void bind_blob(int index, std::string_view bytes) = 0;

  /// Runs to the end, whatever rows there are. An engine may put off what gives none; what fails
  /// then is told by a later call, at the latest by the commit.
  virtual void run() = 0;
  /// @returns whether there is a next row.
  virtual bool step() = 0;
  virtual void reset() noexcept = 0;

  virtual int columns() const = 0;
  virtual bool is_null(int column) const = 0;
  virtual std::int64_t integer(int column) const = 0;  ///< a truth value is 0 or 1
  virtual std::string_view text(int column) const = 0;
  virtual std::string_view blob(int column) const = 0;

  /// Lets the connection forget pages of the file that nothing has changed.
  virtual void release_pages() noexcept {}
};

}  // namespace fitgauge::store::sql
