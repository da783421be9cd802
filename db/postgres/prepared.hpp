#pragma once

#include <string>
#include <vector>

#include "db/postgres/connection.hpp"
#include "db/sql/prepared.hpp"

namespace fitgauge::store::postgres {

/// A statement of a connection: prepared on the server when it first runs, then with the types of
/// what is bound. A query brings all its rows at once.
class Prepared final : public sql::Prepared {
 public:
  Prepared(Connection& connection, std::string_view sql);
  ~Prepared() override;

  void bind_null(int index, sql::Kind kind) override;
  void bind_integer(int index, std::int64_t value) override;
  void bind_text(int index, std::string_view value) override;
  void bind_blob(int index, std::string_view bytes) override;

  void run() override;
  bool step() override;
  void reset() noexcept override;

  int columns() const override;
  bool is_null(int column) const override;
  std::int64_t integer(int column) const override;
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

}  // namespace fitgauge::store::postgres
