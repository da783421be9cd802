#pragma once

#include <postgresql/libpq-fe.h>

#include "db/sql/connection.hpp"
#include "db/sql/statement.hpp"

namespace fitgauge::store::postgres {

struct ClearResult {
  void operator()(PGresult* result) const { PQclear(result); }
};
using ResultPtr = std::unique_ptr<PGresult, ClearResult>;

// Types by their numbers in pg_type, which never change.
inline constexpr Oid kInt2 = 21;
inline constexpr Oid kInt8 = 20;
inline constexpr Oid kText = 25;
inline constexpr Oid kBytes = 17;
inline constexpr Oid kAsTheStatementSays = 0;

/// A parameter in the binary format.
struct Parameter {
  Oid type = kInt8;
  bool is_null = true;
  std::int64_t integer = 0;
  std::string_view bytes{};
};

/// The lock of a transaction on the row `head`.
struct Head {
  std::int64_t last_id = 0;
  std::int64_t own_rows = 0;
  std::int64_t names = 0;
};

inline constexpr const char* kNoAnswer = "PostgreSQL does not answer";

/// Decides whether to give up a server that has been silent for so many seconds. Asked after each.
using GivesUp = std::function<bool(int seconds)>;

/// The server ends a statement that takes longer.
inline constexpr int kStatementSeconds = 60;

/// The server has not ended the statement in time.
inline bool gives_up_statement(int seconds) { return seconds > kStatementSeconds + 5; }

/// A connection to the server that accepts writes. Statements without rows are sent without
/// waiting; their failure is thrown by the next call that waits. Used by one thread at a time.
/// After a StorageFailure it is closed and another one is opened.
class Connection final : public sql::Connection {
 public:
  /// @param address `postgresql://…`, as libpq reads it; of several hosts, it uses the writable
  ///   one.
  /// @throws StorageFailure
  explicit Connection(const std::string& address, GivesUp gives_up = gives_up_statement);
  ~Connection() override;

  std::unique_ptr<sql::Prepared> prepare(const std::string& sql) override;
  sql::MeasurementTable& measurements() override;

  /// Sends a statement without parameters and does not wait.
  void send(const std::string& sql);
  /// Sends a prepared statement; the first time under this name it is prepared with these types.
  void send(const std::string& name, const std::string& sql, std::span<const Parameter> values);
  /// Waits for everything that was sent. @returns the result of the last statement; null if there
  /// was none.
  /// @throws StorageFailure, std::logic_error of the first statement that failed.
  ResultPtr wait();
  /// Waits for all that was sent, a COMMIT among it.
  /// @throws as wait(); StorageFailure for all that fails when it has committed.
  void wait_for_commit();
  /// Whether something was sent and not waited for.
  bool is_waiting() const { return !sent_.empty(); }
  /// Runs statements without parameters in the open transaction.
  void run_script(const std::string& sql);

  std::string new_name() { return "s" + std::to_string(++names_); }
  /// A statement without users.
  void forget(const std::string& name) noexcept;

  PGconn* handle() const { return connection_.get(); }

  /// Warnings of the server since the last call; empty if there are none.
  std::string take_warning() { return std::exchange(warning_, {}); }

  Head head;                         ///< in a transaction
  bool parts_may_be_undone = false;  ///< set by an undo: parts made since may not be there

 private:
  struct Finish {
    void operator()(PGconn* connection) const { PQfinish(connection); }
  };

  static void on_notice(void* connection, const PGresult* notice);

  void require_sent(int sent);
  void execute(const std::string& sql);
  void await_result();
  ResultPtr next_result();
  [[noreturn]] void lost();

  std::unique_ptr<PGconn, Finish> connection_;
  const GivesUp gives_up_;
  bool is_given_up_ = false;
  std::vector<std::string> sent_;    ///< of each the name it prepares, or nothing
  std::set<std::string> prepared_;   ///< names the server knows
  std::vector<std::string> unused_;  ///< names that the server may forget
  bool has_committed_ = false;       ///< wait() has waited for a COMMIT
  std::uint64_t names_ = 0;
  std::string warning_;
  std::unique_ptr<sql::MeasurementTable> measurements_;
};

/// Adds a number as PostgreSQL's binary formats write it: the highest byte first.
template <class Integer>
void append_number(std::string& bytes, Integer value) {
  std::array<char, sizeof(Integer)> written{};
  auto rest = static_cast<std::uint64_t>(value);
  for (auto byte = written.rbegin(); byte != written.rend(); ++byte, rest >>= 8U) {
    *byte = static_cast<char>(rest);
  }
  bytes.append(written.data(), written.size());
}

/// Adds the bytes that `make` adds, with their number before them.
template <class Make>
void append_counted(std::string& bytes, const Make& make) {
  const std::size_t place = bytes.size();
  bytes.append(sizeof(std::int32_t), '\0');
  make();
  std::string count;
  append_number(count, static_cast<std::int32_t>(bytes.size() - place - sizeof(std::int32_t)));
  bytes.replace(place, count.size(), count);
}

/// A signed number of one to eight bytes.
inline std::int64_t read_number(std::string_view bytes) {
  if (bytes.empty()) return 0;
  auto value =
      static_cast<std::uint64_t>(static_cast<std::int64_t>(static_cast<signed char>(bytes[0])));
  for (const char byte : bytes.substr(1)) value = value << 8U | static_cast<unsigned char>(byte);
  return static_cast<std::int64_t>(value);
}

/// A statement of a connection, prepared on the server at its first run with the types of its
/// parameters. A query fetches all rows at once.
class Prepared final : public sql::Prepared {
 public:
  Prepared(Connection& connection, std::string_view sql);
  ~Prepared() override { connection_.forget(name_); }

  void bind_null(int index, sql::Kind kind) override;
  void bind_integer(int index, std::int64_t value) override;
  void bind_text(int index, std::string_view value) override;
  void bind_blob(int index, std::string_view bytes) override;

  void run() override { send(); }
  bool step() override;
  void reset() noexcept override { result_.reset(); }

  int columns() const override { return PQnfields(result_.get()); }
  bool is_null(int column) const override { return PQgetisnull(result_.get(), row_, column) != 0; }
  std::int64_t integer(int column) const override { return read_number(text(column)); }
  std::string_view text(int column) const override;
  std::string_view blob(int column) const override { return text(column); }

 private:
  void bind(int index, const Parameter& value);
  void send();

  Connection& connection_;
  std::string sql_;
  std::string name_;
  std::vector<Parameter> values_;
  bool types_have_changed_ = false;
  ResultPtr result_;
  int row_ = -1;
};

/// Appends rows, and makes the partition of the table for its first row. Every row has its origin
/// and its place in that log.
class MeasurementTable final : public sql::MeasurementTable {
 public:
  explicit MeasurementTable(Connection& connection) : connection_(connection) {}

  void append(std::span<const MeasurementRow> rows) override;
  /// Returns the head's last id in a transaction that writes, and the committed one in others.
  std::int64_t last_id() override { return connection_.head.last_id; }
  std::optional<std::int64_t> own_rows() override { return connection_.head.own_rows; }

 private:
  void make_parts(std::span<const MeasurementRow> rows);
  std::string begin_array(std::size_t rows);
  void read_type();
  void append_row(std::string& bytes, const MeasurementRow& row);

  Connection& connection_;
  sql::Statement make_part_{connection_, "SELECT make_measurement_part(?, ?)"};
  Oid row_type_ = 0;                ///< of the table; 0 until it was asked for
  std::vector<std::size_t> order_;  ///< of the table's columns: their indices in a row
  std::string values_;              ///< of one row, and the end of each
  std::vector<std::size_t> ends_;
  std::set<std::pair<std::int64_t, std::int64_t>> parts_;  ///< origin and month that are there
};

}  // namespace fitgauge::store::postgres
