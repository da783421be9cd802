#include "service/log/log_outbox.hpp"

#include <algorithm>
#include <limits>

#include "db/store/database.hpp"
#include "record/record.hpp"
#include "service/log/log_reader.hpp"
#include "service/measurements/mapping.hpp"
#include "service/tables/table_catalog.hpp"

namespace fitgauge::app {
namespace {

constexpr std::int64_t kRowsAPage = 500;

}  // namespace

Result<LogOutbox::Batch> LogOutbox::next(std::int64_t after, std::int64_t most) const {
  return database_.readers().wait([&](const store::Stores& stores) -> Result<Batch> {
    Batch batch{.from = after + 1};
    const RowNames names = row_names(tables_, log_.origins());
    std::int64_t end = std::min(after + most, stores.log.state().size);
    const LogService::History& history = log_.history_of(after + 1);
    if (history.end) end = std::min(end, *history.end);
    if (!history.signer && end > after) {
      batch.unsigned_to = history.end;
      return batch;
    }
    batch.origin = history.digits;
    if (history.begin > 0) {
      batch.base = log_.history_of(history.begin).digits;
      batch.base_size = history.begin;
    }
    std::optional<std::int64_t> first_row;
    std::int64_t last_row = 0;
    std::size_t bytes = 0;
    for (std::int64_t at = after; at < end && bytes < kMostBytes;) {
      stores.measurements.list_log(
          0, at, std::min(kRowsAPage, end - at), [&](const store::MeasurementRow& row) {
            ++at;
            if (bytes >= kMostBytes) return;
            append_record(batch.records.emplace_back(), from_store(row, names));
            bytes += batch.records.back().size();
            first_row = first_row.value_or(row.id);
            last_row = row.id;
          });
    }
    if (!first_row) return batch;
    batch.checkpoint =
        log_.sign_at(stores, history, static_cast<std::uint64_t>(after) + batch.records.size());
    batch.key = history.signer->verifier().text();
    batch.hand_overs = log_.hand_overs();
    stores.idempotency.visit_forwarded(*first_row, last_row,
                                       [&](const auto& kept) { batch.answers.push_back(kept); });
    return batch;
  });
}

Result<std::optional<bool>> LogOutbox::begins_with(std::int64_t size,
                                                   const tlog::Hash& root) const {
  return database_.readers().wait([&](const store::Stores& stores) -> Result<std::optional<bool>> {
    if (size > stores.log.state().size) return std::optional<bool>();
    const RowNames names = row_names(tables_, log_.origins());
    LogReader reader(stores, names);
    return std::optional(reader.frontier(static_cast<std::uint64_t>(size)).root() == root);
  });
}

Result<std::int64_t> LogOutbox::confirmed(std::string_view centre) const {
  return database_.readers().wait([&](const store::Stores& stores) -> Result<std::int64_t> {
    const auto forwarded = stores.origins.forwarded();
    return forwarded && forwarded->centre == centre ? forwarded->size : 0;
  });
}

Result<void> LogOutbox::confirm(std::string_view centre, std::int64_t size) const {
  const auto stored = database_.writer().wait([&](store::Stores& stores) -> Result<bool> {
    stores.origins.set_forwarded({.centre = std::string(centre), .size = size});
    return true;
  });
  if (!stored) return stored.error();
  return {};
}

std::string_view LogOutbox::newest_history() const {
  const auto rows =
      database_.readers().wait([](const store::Stores& stores) -> Result<std::int64_t> {
        return stores.measurements.log_size();
      });
  return log_.history_of(rows ? *rows : std::numeric_limits<std::int64_t>::max()).digits;
}

void LogOutbox::set_forked(const std::optional<std::string>& why) const {
  static_cast<void>(log_.set_forked(why));  // what cannot be stored now is tried with the next
}

std::int64_t LogOutbox::committed() const { return database_.writer_counters().own_rows; }

Result<LogOutbox::Waiting> LogOutbox::waiting(std::int64_t confirmed) const {
  return database_.readers().wait([&](const store::Stores& stores) -> Result<Waiting> {
    Waiting waiting{.rows = std::max<std::int64_t>(0, stores.measurements.log_size() - confirmed)};
    stores.measurements.list_log(0, confirmed, 1, [&](const store::MeasurementRow& row) {
      waiting.oldest = Timestamp{row.received_at_ns};
    });
    return waiting;
  });
}

}  // namespace fitgauge::app
