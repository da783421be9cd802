#pragma once

#include <functional>
#include <utility>
#include <vector>

namespace fitgauge::http {

class IoThread;

/// What one thread has for the I/O threads, kept for an AnswerBatch.
class Posts {
 public:
  /// Those of the calling thread; null when it has no AnswerBatch.
  static Posts* kept();

  Posts();
  Posts(const Posts&) = delete;
  Posts& operator=(const Posts&) = delete;
  /// Hands over what was kept.
  ~Posts();

  void add(IoThread& thread, std::function<void()> function);

 private:
  using Functions = std::vector<std::function<void()>>;

  std::vector<std::pair<IoThread*, Functions>> threads_;  ///< as few as there are I/O threads
};

}  // namespace fitgauge::http
