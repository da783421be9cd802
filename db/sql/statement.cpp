#include "sql/statement.hpp"

#include "sql/connection.hpp"

namespace fitgauge::store::sql {

Statement::Statement(Connection& connection, std::string sql)
    : connection_(&connection), sql_(std::move(sql)) {}

void Statement::prepare() { prepared_ = connection_->prepare(sql_); }

}  // namespace fitgauge::store::sql
