#pragma once

#include "base/digest.hpp"
#include "db/store/measurement_row.hpp"

namespace fitgauge::store::sql {

/// The meaning of a NULL, for an engine that knows its types before the values.
enum class Kind : std::uint8_t { Integer, Text, Bytes };

/// A statement that an engine has prepared, with its current row. Parameters count from 1, columns
/// from 0. Texts are not copied: bound texts must live until the statement has run, read texts live
/// until its next step.
class Prepared {
 public:
  Prepared& operator=(Prepared&&) = delete;  // neither copied nor moved
  virtual ~Prepared() = default;

  virtual void bind_null(int index, Kind kind) = 0;
  virtual void bind_integer(int index, std::int64_t value) = 0;
  virtual void bind_text(int index, std::string_view value) = 0;
  virtual void bind_blob(int index, std::string_view bytes) = 0;

  /// Runs to the end and ignores rows. An engine may postpone a statement without rows; a later
  /// call, at the latest the commit, reports its failure.
  virtual void run() = 0;
  /// @returns whether there is a next row.
  virtual bool step() = 0;
  virtual void reset() noexcept = 0;

  virtual int columns() const = 0;
  virtual bool is_null(int column) const = 0;
  virtual std::int64_t integer(int column) const = 0;  ///< a truth value is 0 or 1
  virtual std::string_view text(int column) const = 0;
  virtual std::string_view blob(int column) const = 0;

  /// Lets the connection drop unchanged pages of the file from memory.
  virtual void release_pages() noexcept {}
};

/// Appends measurements, if an engine has a special way.
class MeasurementTable {
 public:
  MeasurementTable& operator=(MeasurementTable&&) = delete;  // neither copied nor moved
  virtual ~MeasurementTable() = default;

  /// @param rows numbered on from the last.
  virtual void append(std::span<const MeasurementRow> rows) = 0;
  /// 0 when there is none.
  virtual std::int64_t last_id() = 0;
  /// Returns the number of rows of this folder, if the engine counts them and numbers them in their
  /// log.
  virtual std::optional<std::int64_t> own_rows() { return std::nullopt; }
};

/// The differences between engines.
struct Dialect {
  bool has_seals = false;         ///< rows carry a digest, `row_digest` of the other columns
  bool streams = false;           ///< rows arrive one by one; false: all together
  bool is_shared = false;         ///< other processes append measurements to the same database
  bool keys_may_be_null = false;  ///< and two NULLs are equal
};

/// A connection of an engine. Used by one thread at a time. Every failure of the storage is thrown
/// as StorageFailure, a statement that is wrong as std::logic_error.
class Connection {
 public:
  Connection& operator=(Connection&&) = delete;  // neither copied nor moved
  virtual ~Connection() = default;

  /// @param sql in SQLite's dialect; parameters are `?`, or `?1` if one is used twice.
  virtual std::unique_ptr<Prepared> prepare(const std::string& sql) = 0;

  virtual MeasurementTable& measurements() = 0;

  const Dialect& dialect() const { return dialect_; }

 protected:
  explicit Connection(const Dialect& dialect) : dialect_(dialect) {}

 private:
  const Dialect dialect_;
};

}  // namespace fitgauge::store::sql
