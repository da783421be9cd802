#include "db/sqlite/checkpointer.hpp"

#include <sqlite3.h>

#include <exception>

#include "db/sqlite/session.hpp"

namespace fitgauge::store {
namespace {

constexpr int kForceFactor = 2;

/// Copies what no reader needs any more; readers and writers go on.
void passive_checkpoint(const sqlite::Connection& connection) {
  sqlite3_wal_checkpoint_v2(connection.handle(), nullptr, SQLITE_CHECKPOINT_PASSIVE, nullptr,
                            nullptr);
}

}  // namespace

Checkpointer::Checkpointer(const OpenOptions& options)
    : options_(options), thread_("the checkpointer", [this](const auto&) { run(); }) {}

Checkpointer::~Checkpointer() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  thread_.stop();
}

void Checkpointer::install(sqlite::Connection& writer) {
  const auto count = [](void* pages, sqlite3*, const char*, int in_log) {
    *static_cast<int*>(pages) = in_log;
    return SQLITE_OK;
  };
  sqlite3_wal_hook(writer.handle(), count, &pages_);
}

void Checkpointer::after_commit(sqlite::Connection& writer) {
  std::unique_lock lock(mutex_);
  // A checkpoint beside the thread's would copy nothing: there is one at a time.
  if (pages_ >= kForceFactor * options_.checkpoint_pages) {
    changed_.wait(lock, [this] { return state_ != State::Running; });
  }
  const bool forced = pages_ >= kForceFactor * options_.checkpoint_pages;
  const bool finished = state_ == State::Finished;
  if (finished) state_ = State::Idle;
  if (pages_ < options_.checkpoint_pages) return;
  if (finished || forced) {
    lock.unlock();
    passive_checkpoint(writer);
  } else if (state_ == State::Idle) {
    state_ = State::Running;
    changed_.notify_all();
  }
}

void Checkpointer::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stopping_ || state_ == State::Running; });
    if (stopping_) return;
    lock.unlock();
    try {
      checkpoint();
    } catch (const std::exception&) {  // the file cannot be opened: commits will say so
    }
    lock.lock();
    state_ = State::Finished;
    changed_.notify_all();
  }
}

void Checkpointer::checkpoint() {
  const sqlite::Connection connection(options_.directory / kDatabaseFile, sqlite::Mode::Write,
                                      options_.synchronous);
  passive_checkpoint(connection);
}

}  // namespace fitgauge::store
