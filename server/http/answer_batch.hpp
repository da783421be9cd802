#pragma once

#include <memory>

namespace fitgauge::http {

class Posts;

/// While one lives, what its thread hands to I/O threads is kept; when it ends, each of them gets
/// its share at once. For a thread that answers many requests together: an answer by itself wakes
/// the I/O thread, which sends it and sleeps again before there is the next.
/// At most one on a thread. The Responders used under it count as gone when it has ended.
class AnswerBatch {
 public:
  AnswerBatch();
  AnswerBatch(const AnswerBatch&) = delete;
  AnswerBatch& operator=(const AnswerBatch&) = delete;
  ~AnswerBatch();

 private:
  std::unique_ptr<Posts> posts_;
};

}  // namespace fitgauge::http
