#pragma once

#include <queue>

#include "test_server.hpp"

namespace fitgauge::http::test {

/// A thread that runs what it is given, in order; what is queued at the end is dropped.
class Worker {
 public:
  Worker() : thread_([this] { loop(); }) {}
  ~Worker() {
    {
      const std::lock_guard lock(mutex_);
      done_ = true;
    }
    wake_.notify_one();
    thread_.join();
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  template <class Job>
  void run(Job job) {
    auto shared = std::make_shared<Job>(std::move(job));
    {
      const std::lock_guard lock(mutex_);
      jobs_.push([shared] { (*shared)(); });
    }
    wake_.notify_one();
  }

 private:
  void loop() {
    std::unique_lock lock(mutex_);
    for (;;) {
      wake_.wait(lock, [this] { return done_ || !jobs_.empty(); });
      if (done_) return;
      auto job = std::move(jobs_.front());
      jobs_.pop();
      lock.unlock();
      job();
      job = nullptr;
      lock.lock();
    }
  }

  std::mutex mutex_;
  std::condition_variable wake_;
  std::queue<std::function<void()>> jobs_;
  bool done_ = false;
  std::thread thread_;
};

/// A GET route that `make` answers, on the worker's thread.
template <class Make>
Route answering_on(Worker& worker, std::string pattern, Make make) {
  return answering(std::move(pattern),
                   [&worker, make](const Request& request, Responder responder) {
                     worker.run([&request, make, responder = std::move(responder)]() mutable {
                       const Result<Response> made = make(request);
                       made ? responder.answer(*made) : responder.fail(made.error());
                     });
                   });
}

}  // namespace fitgauge::http::test
