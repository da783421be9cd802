#include <fmt/format.h>

#include <algorithm>
#include <exception>

#include "app/measurements/mapping.hpp"
#include "app/measurements/measurement_feed.hpp"
#include "app/measurements/measurement_queue.hpp"
#include "app/measurements/measurement_service.hpp"
#include "app/measurements/measurement_storage.hpp"
#include "app/runs/worker_pool.hpp"
#include "store/database.hpp"

// How measurements get into the store; how they are read stands in measurement_service.cpp.

namespace fitgauge::app {
namespace {

/// Long requests that are read at once. Only one of them can be stored at a time: the other is
/// there to have its first measurements ready.
constexpr unsigned kLongRequests = 2;

/// So many that their rows stay in the cache.
constexpr std::size_t kAtATime = 128;

/// The store knows ids as numbers: this error names them as the outside does.
Error corrected_before(const store::Stores& stores, std::int64_t id) {
  const auto newer = stores.measurements.corrected_by(id);
  return {ErrorCode::MeasurementCorrected,
          fmt::format("measurement {} was corrected by {}: correct that one",
                      measurement_id_text(id), measurement_id_text(newer.value_or(0)))};
}

/// Stores the measurements of a request.
/// @returns the id of the first.
Result<std::int64_t> append(store::Stores& stores, std::span<const Measurement> measurements,
                            std::optional<std::int64_t> revision) {
  const std::int64_t first = stores.measurements.last_id() + 1;
  std::vector<store::MeasurementRow> rows;
  while (!measurements.empty()) {
    const std::size_t count = std::min(measurements.size(), kAtATime);
    rows.clear();
    append_rows(rows, measurements.first(count), revision);
    const auto ids = stores.measurements.append(rows);
    if (!ids && ids.error().code == ErrorCode::MeasurementCorrected) {
      return corrected_before(stores, *rows.front().correction_of);
    }
    if (!ids) return ids.error();
    measurements = measurements.subspan(count);
  }
  return first;
}

/// Stores the pieces of a long request, from the thread that reads it.
Result<Answer> append_pieces(store::Stores& stores, MeasurementFeed& feed) {
  feed.begin(stores.measurements.chain_end());
  while (true) {
    const auto piece = feed.take();
    if (!piece) return piece.error();
    if (piece->empty()) return feed.take_answer();
    const auto appended = stores.measurements.append_linked(*piece);
    if (!appended) return appended.error();
  }
}

Error internal_error(const std::exception& bug) {
  return {ErrorCode::Internal, fmt::format("reading a request failed: {}", bug.what())};
}

}  // namespace

MeasurementService::MeasurementService(store::Database& database, const TableCatalog& tables,
                                       const MeasurementServiceOptions& options)
    : database_(database),
      tables_(tables),
      queue_(
          std::make_shared<MeasurementQueue>(database, options.most_waiting, options.commit_each)),
      long_requests_(std::make_unique<WorkerPool>(kLongRequests, options.most_waiting)) {}
MeasurementService::~MeasurementService() = default;

void MeasurementService::find_answer(const IdempotencyScope& scope,
                                     Done<std::optional<Answer>> done) {
  database_.readers().submit(
      [request = to_store(scope)](const store::Stores& stores) -> Result<std::optional<Answer>> {
        auto found = stores.idempotency.find(request);
        if (!found) return found.error();
        if (!*found) return std::optional<Answer>();
        return std::optional(from_store(**std::move(found)));
      },
      std::move(done));
}

template <class Work>
void MeasurementService::submit(const std::optional<IdempotencyScope>& scope, Work work,
                                Done<Answer> done) {
  auto store = [work =
                    std::move(work)](store::Stores& stores) mutable -> Result<store::StoredAnswer> {
    Result<Answer> answer = work(stores);
    if (!answer) return answer.error();
    return to_store(*std::move(answer));
  };
  auto deliver = [done = std::move(done)](Result<store::StoredAnswer> answer) {
    if (!answer) return done(answer.error());
    done(from_store(*std::move(answer)));
  };
  if (scope) {
    database_.writer().submit_once(to_store(*scope), std::move(store), std::move(deliver));
  } else {
    database_.writer().submit(std::move(store), std::move(deliver));
  }
}

void MeasurementService::record(std::vector<Measurement> measurements,
                                const std::optional<IdempotencyScope>& scope, Render render,
                                Done<Answer> done) {
  const auto revision = revision_of(measurements, tables_);
  const bool is_small = measurements.size() <= kAtATime;
  if (is_small && !scope && !measurements.front().correction_of) {
    return queue_->record({.measurements = std::move(measurements),
                           .revision = revision,
                           .render = std::move(render),
                           .done = std::move(done)});
  }
  auto work = [measurements = std::move(measurements), revision,
               render = std::move(render)](store::Stores& stores) mutable -> Result<Answer> {
    const auto first = append(stores, measurements, revision);
    if (!first) return first.error();
    number_from(*first, measurements);
    return render(measurements);
  };
  submit(scope, std::move(work), std::move(done));
}

Result<Answer> MeasurementService::record_while_reading(
    const Read& read, const std::optional<IdempotencyScope>& scope, Rendering& rendering) {
  const auto feed = std::make_shared<MeasurementFeed>();
  std::optional<store::MeasurementChain> chain;
  const auto begin = [&] {
    submit(
        scope, [feed](store::Stores& stores) { return append_pieces(stores, *feed); },
        [feed](Result<Answer> outcome) { feed->end(std::move(outcome)); });
    if (const auto end = feed->chain_end()) chain.emplace(*end);
  };
  bool begun = false;
  const auto take = [&](std::vector<Measurement> measurements) {
    if (!std::exchange(begun, true)) begin();
    if (!chain) return;  // refused before a row was stored
    number_from(chain->end().id + 1, measurements);
    MeasurementFeed::Piece piece;
    piece.reserve(measurements.size());
    append_rows(piece, measurements, revision_of(measurements, tables_));
    chain->link(piece);
    feed->put(std::move(piece));
    rendering.add(measurements);
  };
  Result<void> complete;
  try {
    complete = read(take);
    if (complete && chain) feed->finish(rendering.finish());
  } catch (const std::exception& bug) {
    complete = internal_error(bug);
  }
  if (!begun) return complete.error();
  if (!complete) feed->fail(complete.error());
  return feed->outcome();
}

void MeasurementService::run(std::function<void()> work, const std::function<void(Error)>& failed) {
  auto job = [work = std::move(work), failed] {
    try {
      work();
    } catch (const std::exception& bug) {
      failed(internal_error(bug));
    }
  };
  if (!long_requests_->submit(std::move(job))) failed(too_much_work());
}

}  // namespace fitgauge::app
