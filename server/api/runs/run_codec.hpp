#pragma once

#include "base/json/json_writer.hpp"
#include "base/json/schema.hpp"
#include "service/documents/document_service.hpp"
#include "service/runs/run_service.hpp"

namespace fitgauge::api {

/// Returns the forms of a run: the run object of the contract, its trace, its event.
app::RunFormat run_format();

/// `{"Q1":25,"QS3":"GOOD"}`
void write_parameters(JsonWriter& json, std::span<const interpreter::ParameterValue> parameters);

/// The run object of a run that is not over yet.
std::string unfinished_run_json(const app::ActiveRun& run);
/// Writes a run that only the store knows.
std::string unfinished_run_json(const app::StoredRun& run);

/// `{"runs":[{"id","status","program","created_at","finished_at"},...],"next"}`
/// @param next the cursor; empty on the last page
std::string run_page_json(const app::RunService::Page& page, std::string_view next);

/// `{"diagnostics":[...]}`
std::string diagnostics_json(const std::vector<klartext::Diagnostic>& diagnostics);
void write_diagnostics(JsonWriter& json, const std::vector<klartext::Diagnostic>& diagnostics);

inline constexpr std::int64_t kMostBlocks = 100'000'000;
inline constexpr double kMostSeconds = 60;
/// Bytes of a part and of an order, as in a record.
inline constexpr std::size_t kLongestSubject = 200;

/// Finds a named setup; may wait.
using FindSetup = std::function<Result<app::NamedDocument>(const std::string& name)>;

/// Reads the body of POST /v1/runs. The order's request is the body with a named setup in full, so
/// that it can be sent again.
/// @param tables of the control: their rows are added to those of the setup
/// @errors RequestInvalid with every bad field; those of `find_setup` but SetupUnknown.
Result<app::RunOrder> decode_run_order(JsonValue body, const FindSetup& find_setup,
                                       const app::ControlTables& tables);

/// The schema of such a body.
NamedSchema run_order_schema();

/// `{"moves":[...],"dropped":0}`, one move a line; lengths in mm to the tenth of a nanometre.
app::TraceFormat trace_json();

/// Converts the JSON of a trace to CSV, from pieces of any size.
class TraceCsv {
 public:
  /// The rows that end in this piece. @errors StorageCorrupt when a line is no move.
  Result<std::string> rows(std::string_view piece);
  /// The header line if there was no row: with the linear axes, which every machine has.
  std::string end();

 private:
  /// A column: a member of a move, or one axis of a position.
  struct Column {
    std::string member;
    std::string axis{};

    std::string title() const;
  };

  static std::vector<Column> columns_of(const JsonValue& move);
  void append_header(std::string& out) const;
  Result<void> append_line(std::string& out, std::string_view line);

  std::string rest_;  ///< of a line that has not ended
  std::vector<Column> columns_;
};

void add_trace_schema(Schemas& schemas);

}  // namespace fitgauge::api
