#include <fmt/format.h>

#include <exception>

#include "db/store/database.hpp"
#include "record/note.hpp"
#include "record/origins.hpp"
#include "service/measurements/mapping.hpp"
#include "service/measurements/measurement_queue.hpp"
#include "service/measurements/measurement_service.hpp"
#include "service/measurements/measurement_storage.hpp"

// How measurements get into the store; how they are read stands in measurement_service.cpp.

namespace fitgauge::app {
namespace {

/// Stores the pieces of a long request, from the thread that reads it.
Result<Answer> append_pieces(store::Stores& stores, MeasurementFeed& feed) {
  feed.begin(stores.measurements.last_id());
  while (true) {
    const auto piece = feed.take();
    if (!piece) return piece.error();
    if (piece->empty()) return feed.take_answer();
    const auto appended = stores.measurements.append(*piece);
    if (!appended) return appended.error();
  }
}

Error internal_error(const std::exception& bug) {
  return {ErrorCode::Internal, fmt::format("reading a request failed: {}", bug.what())};
}

}  // namespace

MeasurementService::MeasurementService(store::Database& database, const TableCatalog& tables,
                                       const Origins& origins,
                                       const MeasurementServiceOptions& options)
    : database_(database),
      tables_(tables),
      origins_(origins),
      queue_(std::make_shared<MeasurementQueue>(database, origins.own(), options.most_waiting,
                                                options.commit_each)) {}

void MeasurementService::find_answer(const IdempotencyScope& scope,
                                     Done<std::optional<Answer>> done) {
  database_.readers().submit(
      // The digest of a long body is nothing for the thread that asks.
      [scope](const store::Stores& stores) { return stores.idempotency.find(to_store(scope)); },
      std::move(done));
}

template <class Work>
void MeasurementService::submit(const std::optional<IdempotencyScope>& scope, Work work,
                                Done<Answer> done) {
  if (scope) {
    database_.writer().submit_once(to_store(*scope), std::move(work), std::move(done));
  } else {
    database_.writer().submit(std::move(work), std::move(done));
  }
}

void MeasurementService::record(std::vector<Measurement> measurements,
                                const std::optional<IdempotencyScope>& scope, Render render,
                                Done<Answer> done) {
  number_revisions(measurements, tables_);
  const bool is_small = measurements.size() <= kRowsAtATime;
  if (is_small && !scope && !measurements.front().correction_of) {
    return queue_->record(measurements, std::move(render), std::move(done));
  }
  auto work = [measurements = std::move(measurements), origin = origins_.own(),
               render = std::move(render)](store::Stores& stores) mutable -> Result<Answer> {
    const auto rendering = render();
    const auto first = append(stores, measurements, origin, rendering.get());
    if (!first) return first.error();
    return rendering->finish();
  };
  submit(scope, std::move(work), std::move(done));
}

void MeasurementService::add_note(const RecordName& name, Note note,
                                  const std::optional<IdempotencyScope>& scope,
                                  Done<Answer> done) {
  auto work = [this, name,
               note = std::move(note)](store::Stores& stores) mutable -> Result<Answer> {
    const auto row = existing_row_of(stores, name, origins_);
    if (!row) return row.error();
    note.measurement = measurement_id_text(name.number, origins_.digits(name.origin, name.number));
    append_note(stores, *row, origins_, note, note.received_at.nanoseconds);
    return Answer{.status = 201,
                  .content_type = "application/json",
                  .location = {},
                  .body = api::body_json(note)};
  };
  submit(scope, std::move(work), std::move(done));
}

Result<Answer> MeasurementService::record_while_reading(
    const Read& read, const std::optional<IdempotencyScope>& scope, Rendering& rendering) {
  const auto feed = std::make_shared<MeasurementFeed>();
  std::optional<std::int64_t> next_id;
  LeafMaker leaves;
  const auto begin = [&] {
    submit(
        scope, [feed](store::Stores& stores) { return append_pieces(stores, *feed); },
        [feed](Result<Answer> outcome) { feed->end(std::move(outcome)); });
    if (const auto last_id = feed->last_id()) next_id = *last_id + 1;
  };
  bool begun = false;
  const auto take = [&](std::vector<Measurement> measurements) {
    if (!std::exchange(begun, true)) begin();
    if (!next_id) return;  // refused before a row was stored
    number_revisions(measurements, tables_);
    next_id = number_from(*next_id, origins_.own(), measurements);
    MeasurementFeed::Piece piece;
    piece.reserve(measurements.size());
    append_rows(piece, measurements, leaves);
    feed->put(std::move(piece));
    rendering.add(measurements, leaves.records());
  };
  Result<void> complete;
  try {
    complete = read(take);
    if (complete && next_id) feed->finish(rendering.finish());
  } catch (const std::exception& bug) {
    complete = internal_error(bug);
  }
  if (!begun) return complete.error();
  if (!complete) feed->fail(complete.error());
  return feed->outcome();
}

}  // namespace fitgauge::app
