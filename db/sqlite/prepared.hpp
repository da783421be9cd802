#pragma once

#include <sqlite3.h>

#include <memory>
#include <string>

#include "db/sql/prepared.hpp"

namespace fitgauge::store::sqlite {

class Connection;

/// A statement of a connection. SQLiteCpp's own lacks the persistent flag and copies a shared
/// pointer for each column read.
class Prepared final : public sql::Prepared {
 public:
  Prepared(Connection& connection, std::string sql);

  void bind_null(int index, sql::Kind kind) override;
  void bind_integer(int index, std::int64_t value) override;
  void bind_text(int index, std::string_view value) override;
  void bind_blob(int index, std::string_view bytes) override;

  void run() override;
  bool step() override;
  void reset() noexcept override { sqlite3_reset(statement_.get()); }

  int columns() const override { return sqlite3_column_count(statement_.get()); }
  bool is_null(int column) const override {
    return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL;
  }
  std::int64_t integer(int column) const override {
    return sqlite3_column_int64(statement_.get(), column);
  }
  std::string_view text(int column) const override;
  std::string_view blob(int column) const override;

  void release_pages() noexcept override;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };

  Connection& connection_;
  const std::string sql_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

}  // namespace fitgauge::store::sqlite
