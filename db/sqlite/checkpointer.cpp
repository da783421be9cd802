#include "sqlite/checkpointer.hpp"

#include <sqlite3.h>

#include <exception>

#include "sqlite/session.hpp"

namespace fitgauge::store {
namespace {

/// The writer copies all by itself when the log has become so many times too long: the thread is
/// not getting anywhere.
constexpr int kPatience = 4;

/// What no reader needs any more; readers and writers go on.
void copy_log(const sqlite::Connection& connection) {
  sqlite3_wal_checkpoint_v2(connection.handle(), nullptr, SQLITE_CHECKPOINT_PASSIVE, nullptr,
                            nullptr);
}

}  // namespace

Checkpointer::Checkpointer(const OpenOptions& options)
    : options_(options), thread_([this] { run(); }) {}

Checkpointer::~Checkpointer() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void Checkpointer::take_over(sqlite::Connection& writer) {
  const auto count = [](void* pages, sqlite3*, const char*, int in_log) {
    *static_cast<int*>(pages) = in_log;
    return SQLITE_OK;
  };
  sqlite3_wal_hook(writer.handle(), count, &pages_);
}

void Checkpointer::go_on(sqlite::Connection& writer) {
  std::unique_lock lock(mutex_);
  const bool is_copied = state_ == State::Copied;
  if (is_copied) state_ = State::Idle;
  if (pages_ < options_.checkpoint_pages) return;
  if (is_copied || pages_ >= kPatience * options_.checkpoint_pages) {
    lock.unlock();
    copy_log(writer);
  } else if (state_ == State::Idle) {
    state_ = State::Copying;
    changed_.notify_all();
  }
}

void Checkpointer::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stopping_ || state_ == State::Copying; });
    if (stopping_) return;
    lock.unlock();
    try {
      copy();
    } catch (const std::exception&) {  // the file cannot be opened: commits will say so
    }
    lock.lock();
    state_ = State::Copied;
  }
}

void Checkpointer::copy() {
  const sqlite::Connection connection(options_.directory / kDatabaseFile, sqlite::Mode::Write,
                                      options_.synchronous);
  copy_log(connection);
}

}  // namespace fitgauge::store
