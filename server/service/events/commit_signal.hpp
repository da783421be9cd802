#pragma once

#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>
#include <set>

#include "base/thread.hpp"

namespace fitgauge::app {

/// Wants to know when there may be something new to read.
class CommitListener {
 public:
  CommitListener() = default;
  CommitListener(const CommitListener&) = delete;
  CommitListener& operator=(const CommitListener&) = delete;
  virtual ~CommitListener() = default;

  /// Called on the signal's thread after one or more commits: must not block.
  virtual void committed() = 0;
};

/// Tells its listeners of commits, on a thread of its own: the writer only raises a flag, however
/// many listen. Commits that follow each other closely are told as one. Thread-safe.
class CommitSignal {
 public:
  CommitSignal();
  ~CommitSignal();

  void raise();

  /// Ends the thread: no listener is called any more. Not for the listeners.
  void stop();

  void add(std::shared_ptr<CommitListener> listener);
  /// A call that is under way may still come to its end afterwards.
  void remove(const std::shared_ptr<CommitListener>& listener);
  std::size_t listeners() const;

 private:
  void run(const std::stop_token& stop);

  mutable std::mutex mutex_;
  std::condition_variable_any wake_;
  std::set<std::shared_ptr<CommitListener>> listeners_;
  bool raised_ = false;
  Thread thread_;
};

}  // namespace fitgauge::app
