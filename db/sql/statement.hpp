#pragma once

#include <boost/pfr.hpp>

#include "base/allowance.hpp"
#include "base/clock.hpp"
#include "base/digest.hpp"
#include "db/sql/connection.hpp"
#include "db/store/on_connection.hpp"

namespace fitgauge::store::sql {

/// Bytes that are bound and read as a BLOB.
struct Blob {
  std::string_view bytes;
};

template <class T>
inline constexpr bool kIsOptional = false;
template <class T>
inline constexpr bool kIsOptional<std::optional<T>> = true;
template <class T>
inline constexpr bool kIsBytes = false;
template <std::size_t size>
inline constexpr bool kIsBytes<std::array<std::uint8_t, size>> = true;

template <class T>
constexpr Kind kind_of_value() {
  if constexpr (std::is_enum_v<T> || std::is_integral_v<T> || std::is_same_v<T, Timestamp>) {
    return Kind::Integer;
  } else if constexpr (kIsBytes<T> || std::is_same_v<T, Blob>) {
    return Kind::Bytes;
  } else {
    return Kind::Text;
  }
}

/// Refuses a number without an enumerator. @throws StorageFailure (StorageCorrupt)
[[noreturn]] void refuse_code(std::int64_t stored);

/// An enumeration is stored by its codes, from 1 to the code of `last_of(Value)`, which is declared
/// with it.
template <class Value>
Value value_of(std::int64_t code) {
  if (code < 1 || code > code_of(last_of(Value{}))) refuse_code(code);
  return static_cast<Value>(code + static_cast<std::int64_t>(Value{}) - code_of(Value{}));
}

/// Binds an integer, enumeration, time, text, array of bytes, Blob, or an optional of these.
template <class Statement, class T>
void bind_value(Statement& statement, int index, const T& value) {
  if constexpr (kIsOptional<T>) {
    using Value = typename T::value_type;
    value ? bind_value(statement, index, *value)
          : statement.bind_null(index, kind_of_value<Value>());
  } else if constexpr (std::is_enum_v<T>) {
    statement.bind_integer(index, code_of(value));
  } else if constexpr (std::is_same_v<T, Timestamp>) {
    statement.bind_integer(index, value.nanoseconds);
  } else if constexpr (std::is_integral_v<T>) {
    statement.bind_integer(index, static_cast<std::int64_t>(value));
  } else if constexpr (kIsBytes<T>) {
    statement.bind_blob(index, {reinterpret_cast<const char*>(value.data()), value.size()});
  } else if constexpr (std::is_same_v<T, Blob>) {
    statement.bind_blob(index, value.bytes);
  } else {
    statement.bind_text(index, value);
  }
}

/// The rows of a query; ends it when destroyed, so that no read transaction stays open.
class Rows {
 public:
  explicit Rows(Prepared& prepared) : prepared_(&prepared) {}
  Rows(Rows&& other) noexcept : prepared_(std::exchange(other.prepared_, nullptr)) {}
  Rows& operator=(Rows&&) = delete;
  ~Rows() {
    if (prepared_ != nullptr) prepared_->reset();
  }

  bool next() { return prepared_->step(); }
  int columns() const { return prepared_->columns(); }

  /// A column from 0 on: integer, enumeration, time, text, array of bytes, Blob, or an optional of
  /// these. Views are valid until the next step.
  template <class T>
  T get(int column) const {
    if constexpr (kIsOptional<T>) {
      if (prepared_->is_null(column)) return std::nullopt;
      return get<typename T::value_type>(column);
    } else if constexpr (std::is_enum_v<T>) {
      return value_of<T>(prepared_->integer(column));
    } else if constexpr (std::is_same_v<T, Timestamp>) {
      return Timestamp{prepared_->integer(column)};
    } else if constexpr (std::is_integral_v<T>) {
      return static_cast<T>(prepared_->integer(column));
    } else if constexpr (kIsBytes<T>) {
      T value{};
      const std::string_view bytes = prepared_->blob(column);
      std::copy_n(bytes.begin(), std::min(bytes.size(), value.size()), value.begin());
      return value;
    } else if constexpr (std::is_same_v<T, Blob>) {
      return Blob{prepared_->blob(column)};
    } else {
      return T(prepared_->text(column));
    }
  }

 private:
  Prepared* prepared_;
};

/// Whether a member is one column that outlives its row: structs and arrays of numbers are several,
/// and a Blob is a view.
template <class T>
inline constexpr bool kIsColumn =
    kIsBytes<T> || std::is_same_v<T, Timestamp> || !std::is_aggregate_v<T>;
template <class T>
inline constexpr bool kIsColumn<std::optional<T>> = kIsColumn<T>;

/// The first column, or an aggregate whose members are the columns in their order.
template <class T>
T row_of(const Rows& rows) {
  if constexpr (std::is_aggregate_v<T> && !kIsBytes<T>) {
    T row{};
    int column = 0;
    boost::pfr::for_each_field(row, [&]<class Member>(Member& member) {
      static_assert(kIsColumn<Member>, "read this member apart, with Rows::get");
      member = rows.get<Member>(column++);
    });
    return row;
  } else {
    static_assert(kIsColumn<T>);
    return rows.get<T>(0);
  }
}

/// All rows by row_of(). @param table of sealed rows
template <class T>
std::vector<T> read_all(Rows rows, const auto&... table) {
  std::vector<T> all;
  while (rows.next()) all.push_back(row_of<T>(rows, table...));
  return all;
}

/// The first row by row_of(), if there is one.
template <class T>
std::optional<T> read_first(Rows rows, const auto&... table) {
  return rows.next() ? std::optional(row_of<T>(rows, table...)) : std::nullopt;
}

/// A statement of one connection, prepared at its first use and kept. Bound texts are not copied:
/// they must live until the statement has run, and every run binds all parameters again.
class Statement {
 public:
  Statement(Connection& connection, std::string sql)
      : connection_(&connection), sql_(std::move(sql)) {}

  /// Runs a statement without result rows to its end.
  template <class... Values>
  void run(const Values&... values) {
    bind_all(values...);
    prepared().run();
  }

  /// Runs to the end and returns the first column of its first row; for INSERT … RETURNING.
  template <class T, class... Values>
  T returning(const Values&... values) {
    Rows rows = query(values...);
    rows.next();
    T first = rows.get<T>(0);
    while (rows.next()) {
    }
    return first;
  }

  /// Runs to the end and returns the number of rows; for DELETE … RETURNING.
  template <class... Values>
  std::int64_t run_counting(const Values&... values) {
    Rows rows = query(values...);
    std::int64_t count = 0;
    while (rows.next()) ++count;
    return count;
  }

  /// Starts a query; one at a time.
  template <class... Values>
  Rows query(const Values&... values) {
    bind_all(values...);
    return Rows(prepared());
  }

  void release_pages() noexcept {
    if (prepared_) prepared_->release_pages();
  }

  /// For long lists of values: bind from 1 on, then query() without values.
  template <class T>
  void bind(int index, const T& value) {
    bind_value(prepared(), index, value);
  }

 private:
  template <class... Values>
  void bind_all(const Values&... values) {
    int index = 0;
    (bind(++index, values), ...);
  }
  Prepared& prepared() {
    if (!prepared_) prepared_ = connection_->prepare(sql_);
    return *prepared_;
  }

  Connection* connection_;
  std::string sql_;
  std::unique_ptr<Prepared> prepared_;
};

/// Inserts many rows: in few statements if each is a message to a server; a file is equally fast
/// row by row.
class RowsInsert {
 public:
  /// @param into text before the rows: `INSERT INTO t VALUES `. @param row `(?, ?)`.
  RowsInsert(Connection& connection, std::string into, std::string row)
      : connection_(connection),
        into_(std::move(into)),
        row_(std::move(row)),
        most_rows_(connection.dialect().is_shared ? kMostRows : 1) {}

  /// @param bind called with each row and a function for its values, as Statement::run; texts must
  /// live until all rows are inserted.
  template <class Many, class Bind>
  void run(const Many& rows, const Bind& bind) {
    auto row = rows.begin();
    for (std::size_t left = rows.size(); left > 0;) {
      // Powers of two: few statements fit every number of rows.
      const std::size_t count = std::min(std::bit_floor(left), most_rows_);
      Statement& statement = statement_for(count);
      int index = 0;
      for (std::size_t i = 0; i < count; ++i, ++row) {
        bind(*row, [&](const auto&... values) { (statement.bind(++index, values), ...); });
      }
      statement.run();
      left -= count;
    }
  }

 private:
  static constexpr std::size_t kMostRows = 32;

  Statement& statement_for(std::size_t rows) {
    const auto found = statements_.find(rows);
    if (found != statements_.end()) return found->second;
    std::string sql = into_ + row_;
    for (std::size_t i = 1; i < rows; ++i) sql += ", " + row_;
    return statements_.try_emplace(rows, connection_, std::move(sql)).first->second;
  }

  Connection& connection_;
  const std::string into_;
  const std::string row_;
  const std::size_t most_rows_;
  std::map<std::size_t, Statement> statements_;
};

}  // namespace fitgauge::store::sql

namespace fitgauge::store {

template <class Store>
StatementsOf<Store>& OnConnection<Store>::statements() const {
  if (!statements_) {
    const std::int64_t before = thread_memory();
    statements_ = std::make_shared<StatementsOf<Store>>(connection_);
    hand_over_memory(before - thread_memory());  // not the memory of the job that comes first
  }
  return *statements_;
}

}  // namespace fitgauge::store
