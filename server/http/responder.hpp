#pragma once

#include <memory>

#include "base/error.hpp"
#include "http/response.hpp"

namespace fitgauge::http {

class Connection;

/// The obligation to answer one request: exactly one call, from any thread; the answer is posted to
/// the request's I/O thread. Destroyed without a call, it answers 500. The Request stays valid as
/// long as its Responder. A client that has gone meanwhile is no error.
/// Every Responder must be gone before its Server is destroyed.
class Responder {
 public:
  explicit Responder(std::shared_ptr<Connection> connection);
  Responder(Responder&&) noexcept;
  Responder& operator=(Responder&&) noexcept;
  ~Responder();

  void answer(Response response);

  /// Answers with the error formatter's document.
  void fail(Error error);

 private:
  std::shared_ptr<Connection> connection_;
};

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
