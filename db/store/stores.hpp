#pragma once

#include <chrono>

#include "base/clock.hpp"
#include "db/store/changes_store.hpp"
#include "db/store/documents_store.hpp"
#include "db/store/events_store.hpp"
#include "db/store/files_store.hpp"
#include "db/store/idempotency_store.hpp"
#include "db/store/keys_store.hpp"
#include "db/store/log_store.hpp"
#include "db/store/measurements_store.hpp"
#include "db/store/notes_store.hpp"
#include "db/store/origins_store.hpp"
#include "db/store/revisions_store.hpp"
#include "db/store/runs_store.hpp"
#include "db/store/tables_store.hpp"

namespace fitgauge::store {

namespace sql {
class Connection;
}

/// The stores of one connection. Const is reading: a read job sees `const Stores&`, a write job
/// `Stores&`. Used by the connection's thread alone. Every function throws StorageFailure when the
/// storage fails; the writer and the read pool turn that into an Error.
struct Stores {
  Stores(sql::Connection& connection, const Clock& clock, std::chrono::hours idempotency_retention);

  TablesStore tables;
  MeasurementsStore measurements;
  NotesStore notes;
  IdempotencyStore idempotency;
  KeysStore keys;
  FilesStore files;
  DocumentsStore documents;
  ChangesStore changes;
  RunsStore runs;
  EventsStore events;
  LogStore log;
  OriginsStore origins;
  RevisionsStore revisions;
};

}  // namespace fitgauge::store
