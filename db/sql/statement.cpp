#include "db/sql/statement.hpp"

#include <fmt/format.h>

#include "db/store/stores.hpp"

namespace fitgauge::store::sql {

void refuse_code(std::int64_t stored) {
  throw StorageFailure({ErrorCode::StorageCorrupt,
                        fmt::format("the database holds the code {}, which means nothing: "
                                    "`fitgauged verify` finds the row; restore a backup",
                                    stored)});
}

Statement::Statement(Connection& connection, std::string sql)
    : connection_(&connection), sql_(std::move(sql)) {}

void Statement::prepare() { prepared_ = connection_->prepare(sql_); }

}  // namespace fitgauge::store::sql
