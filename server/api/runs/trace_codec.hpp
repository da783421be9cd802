#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/json/json_value.hpp"
#include "base/json/schema.hpp"
#include "service/runs/stored_run.hpp"

namespace fitgauge::api {

/// `{"moves":[...],"dropped":0}`, one move a line; lengths in mm to the tenth of a nanometre.
app::TraceFormat trace_json();

/// Turns the JSON of a trace into CSV, whatever the pieces it comes in.
class TraceCsv {
 public:
  /// The rows that end in this piece. @errors StorageCorrupt when a line is no move.
  Result<std::string> rows(std::string_view piece);

 private:
  /// A column: a member of a move, or one axis of a position.
  struct Column {
    std::string member;
    std::string axis{};

    std::string title() const;
  };

  static std::vector<Column> columns_of(const JsonValue& move);
  Result<void> append_line(std::string& out, std::string_view line);

  std::string rest_;  ///< of a line that has not ended
  std::vector<Column> columns_;
};

/// The schema of a trace.
void add_trace_schema(Schemas& schemas);

}  // namespace fitgauge::api
