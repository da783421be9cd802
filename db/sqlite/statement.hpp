#pragma once

#include <sqlite3.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "base/digest.hpp"

namespace fitgauge::store::sqlite {

class Connection;
class Rows;

/// Bytes that are bound and read as a BLOB.
struct Blob {
  std::string_view bytes;
};

/// A statement of one connection: prepared at its first use and kept. SQLiteCpp's own statement
/// lacks the persistent flag and copies a shared pointer for each column read.
/// Bound texts are not copied: they live until the statement has run, and every run binds all anew.
class Statement {
 public:
  Statement(Connection& connection, std::string sql);

  /// Runs to the end, for what gives no rows.
  template <class... Values>
  void run(const Values&... values);

  /// Runs to the end and gives the first column of its first row; for INSERT … RETURNING.
  template <class T, class... Values>
  T returning(const Values&... values);

  /// Runs to the end and counts the rows it gives; for DELETE … RETURNING.
  template <class... Values>
  std::int64_t run_counting(const Values&... values);

  /// Starts a query; one at a time.
  template <class... Values>
  Rows query(const Values&... values);

  /// Lets the connection forget pages of the file that nothing has changed.
  void release_pages() noexcept;

  /// For long lists of values: bind from 1 on, then run() or query().
  template <class T>
  void bind(int index, const T& value) {
    if constexpr (std::is_enum_v<T> || std::is_integral_v<T>) {
      bind_integer(index, static_cast<std::int64_t>(value));
    } else if constexpr (std::is_same_v<T, Digest>) {
      bind_blob(index, value.data(), value.size());
    } else if constexpr (std::is_same_v<T, Blob>) {
      bind_blob(index, value.bytes.data(), value.bytes.size());
    } else {
      bind_text(index, value);
    }
  }
  template <class T>
  void bind(int index, const std::optional<T>& value) {
    value ? bind(index, *value) : bind_null(index);
  }

 private:
  friend class Rows;

  struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };

  template <class... Values>
  void bind_all(const Values&... values) {
    int index = 0;
    (bind(++index, values), ...);
  }
  sqlite3_stmt* prepared() {
    if (!statement_) prepare();
    return statement_.get();
  }
  void prepare();
  bool step();
  void reset() noexcept;
  void run_bound();
  void bind_null(int index);
  void bind_integer(int index, std::int64_t value);
  void bind_text(int index, std::string_view value);
  void bind_blob(int index, const void* data, std::size_t size);

  Connection* connection_;
  std::string sql_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

template <class T>
inline constexpr bool kIsOptional = false;
template <class T>
inline constexpr bool kIsOptional<std::optional<T>> = true;

/// The rows of a query; ends it when destroyed, so that no read transaction stays open.
class Rows {
 public:
  explicit Rows(Statement& statement) : statement_(&statement) {}
  Rows(Rows&& other) noexcept : statement_(std::exchange(other.statement_, nullptr)) {}
  Rows& operator=(Rows&&) = delete;
  ~Rows() {
    if (statement_ != nullptr) statement_->reset();
  }

  bool next() { return statement_->step(); }

  /// A column from 0 on: integer, enumeration, text, Digest, Blob, or an optional of these. Views
  /// are valid until the next step.
  template <class T>
  T get(int column) const {
    if constexpr (kIsOptional<T>) {
      if (sqlite3_column_type(raw(), column) == SQLITE_NULL) return std::nullopt;
      return get<typename T::value_type>(column);
    } else if constexpr (std::is_enum_v<T> || std::is_integral_v<T>) {
      return static_cast<T>(sqlite3_column_int64(raw(), column));
    } else if constexpr (std::is_same_v<T, Digest>) {
      Digest digest{};
      const std::string_view bytes = blob(column);
      std::copy_n(bytes.begin(), std::min(bytes.size(), digest.size()), digest.begin());
      return digest;
    } else if constexpr (std::is_same_v<T, Blob>) {
      return Blob{blob(column)};
    } else {
      return T(text(column));
    }
  }

 private:
  sqlite3_stmt* raw() const { return statement_->statement_.get(); }
  std::string_view text(int column) const;
  std::string_view blob(int column) const;

  Statement* statement_;
};

template <class... Values>
void Statement::run(const Values&... values) {
  bind_all(values...);
  run_bound();
}

template <class T, class... Values>
T Statement::returning(const Values&... values) {
  Rows rows = query(values...);
  rows.next();
  T first = rows.get<T>(0);
  while (rows.next()) {
  }
  return first;
}

template <class... Values>
std::int64_t Statement::run_counting(const Values&... values) {
  Rows rows = query(values...);
  std::int64_t count = 0;
  while (rows.next()) ++count;
  return count;
}

template <class... Values>
Rows Statement::query(const Values&... values) {
  prepared();
  bind_all(values...);
  return Rows(*this);
}

}  // namespace fitgauge::store::sqlite
