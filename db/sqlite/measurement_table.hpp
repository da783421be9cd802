#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "db/sql/connection.hpp"
#include "db/sql/statement.hpp"
#include "db/sqlite/connection.hpp"
#include "db/store/measurement_row.hpp"

namespace fitgauge::store::sqlite {

/// Inserts many rows a statement, and only the columns that
/// one of them fills. A statement stepped for every row with every column takes half as long again.
class MeasurementTable final : public sql::MeasurementTable {
 public:
  explicit MeasurementTable(Connection& connection);

  void append(std::span<const MeasurementRow> rows) override;
  std::int64_t last_id() override;

 private:
  /// A set of fields, one bit each in the order of for_each_field.
  __extension__ using Fields = unsigned __int128;
  /// What a statement is made for.
  struct Shape {
    Fields fields = 0;
    std::size_t rows = 0;

    // NOLINTNEXTLINE(modernize-use-nullptr): the zero is the compiler's
    friend auto operator<=>(const Shape&, const Shape&) = default;
  };

  static constexpr Fields kAllFields = ~Fields{0};
  static bool contains(Fields fields, unsigned bit) { return ((fields >> bit) & 1U) != 0; }
  static Fields fields_of(std::span<const MeasurementRow> rows);
  static std::string insert_sql(const Shape& shape);
  std::pair<const Shape, Prepared>& statement_for(const Shape& shape);
  void insert(std::span<const MeasurementRow> rows);

  Connection& connection_;
  sql::Statement newest_;
  std::map<Shape, Prepared> statements_;
};

}  // namespace fitgauge::store::sqlite
