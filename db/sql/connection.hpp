#pragma once

#include <memory>
#include <string>

#include "db/sql/measurement_table.hpp"
#include "db/sql/prepared.hpp"

namespace fitgauge::store::sql {

/// In what engines differ.
struct Dialect {
  bool has_seals = false;         ///< rows carry a digest of their own, `row_digest` of the others
  bool streams = false;           ///< rows come while they are asked for; else all of them at once
  bool is_shared = false;         ///< other processes append measurements to the same database
  bool keys_may_be_null = false;  ///< and two NULLs are alike
};

/// A connection of an engine. Used by one thread at a time. Every failure of the storage is thrown
/// as StorageFailure, a statement that is wrong as std::logic_error.
class Connection {
 public:
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  virtual ~Connection() = default;

  /// @param sql in SQLite's words; parameters are `?`, or `?1` where one stands twice.
  virtual std::unique_ptr<Prepared> prepare(const std::string& sql) = 0;

  virtual MeasurementTable& measurements() = 0;

  const Dialect& dialect() const { return dialect_; }

 protected:
  explicit Connection(const Dialect& dialect) : dialect_(dialect) {}

 private:
  const Dialect dialect_;
};

}  // namespace fitgauge::store::sql
