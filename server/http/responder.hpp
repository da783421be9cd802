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

}  // namespace fitgauge::http
