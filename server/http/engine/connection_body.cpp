// The part of a connection that reads a request's body: directly into its memory, or through the
// chunked coding and gzip; it waits while other bodies hold the memory.

#include "http/engine/connection.hpp"

namespace fitgauge::http {
namespace {

/// Bodies of unknown length that wait for memory; another one is refused at once.
constexpr std::size_t kMostWaiting = 2;
constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";

}  // namespace

void Connection::skip_buffered_body() {
  if (!head_.has_body()) return;
  const auto length = head_.content_length.value_or(input_.unread().size() + 1);
  if (length <= input_.unread().size()) {
    input_.advance(static_cast<std::size_t>(length));
  } else {
    close_after_ = lingers_ = true;
  }
}

/// Returns the phase in which the rest of the body is read.
Connection::Phase Connection::body_phase() const {
  return !head_.chunked && body_.plan().is_verbatim() ? Phase::FillingBody : Phase::ReadingBody;
}

bool Connection::begin_body() {
  const BodyReader::Plan plan = exchange_.body_plan();
  body_left_ = static_cast<std::size_t>(head_.content_length.value_or(0));
  if (!head_.chunked && plan.is_verbatim() && input_.unread().size() >= body_left_) {
    exchange_.set_body({input_.unread().substr(0, body_left_)});
    input_.advance(body_left_);
    received_ += body_left_;
    run_handler();
    return true;
  }
  input_.pin_head();
  parser_->limit_body(plan.limit);
  body_.start(plan);
  phase_ = body_phase();
  last_body_byte_ = thread_.now();
  if (phase_ == Phase::FillingBody) return take_body_outcome(body_.reserve(body_left_));
  return admit_body();
}

bool Connection::admit_body() {
  if (exchange_.wants_continue() && input_.unread().empty()) output_.text().append(kContinue);
  if (phase_ == Phase::FillingBody) {
    const std::string_view there = input_.unread();
    std::memcpy(body_.room().data(), there.data(), there.size());
    body_.added(there.size());
    body_left_ -= there.size();
    received_ += there.size();
    input_.advance(there.size());
  }
  return true;
}

bool Connection::step_body() {
  if (!pending_piece_.empty()) return take_body_outcome(body_.add(pending_piece_));
  if (!head_.chunked) {
    if (body_left_ == 0) return finish_body();
    pending_piece_ = input_.unread().substr(0, body_left_);
    input_.advance(pending_piece_.size());
    received_ += pending_piece_.size();
    body_left_ -= pending_piece_.size();
    return !pending_piece_.empty();
  }
  if (input_.unread().empty()) return false;
  std::size_t used = 0;
  const RequestParser::Step parsed = parser_->put(input_.unread(), used);
  input_.advance(used);
  received_ += used;
  switch (parsed) {
    case RequestParser::Step::NeedMore: return false;
    case RequestParser::Step::Complete: return finish_body();
    case RequestParser::Step::Refused:
      refuse(parser_->refusal().code == ErrorCode::BodyTooLarge ? exchange_.body_too_large()
                                                                : parser_->refusal());
      return true;
    default: pending_piece_ = parser_->piece(); return true;
  }
}

bool Connection::take_body_outcome(BodyReader::Outcome outcome) {
  switch (outcome) {
    case BodyReader::Outcome::Ok: return phase_ != Phase::FillingBody || admit_body();
    case BodyReader::Outcome::NoBudget:
      if (body_.lacking().begin_wait() > kMostWaiting && body_phase() == Phase::ReadingBody) {
        body_.lacking().end_wait();
        refuse(kCrowded);
        return true;
      }
      phase_ = Phase::Budget;
      wait_begun_ = thread_.now();
      return false;
    case BodyReader::Outcome::TooLarge: refuse(exchange_.body_too_large()); return true;
    case BodyReader::Outcome::Malformed:
      refuse({400, ErrorCode::RequestMalformed,
              "the body must be a gzip stream; check Content-Encoding"});
      return true;
    case BodyReader::Outcome::DiskFull:
      refuse(
          {503, ErrorCode::StorageUnavailable,
           "the disk of the data folder is too full for the body: free some, then send it again"});
      return true;
  }
  return false;
}

std::size_t Connection::bytes_waited_for() const {
  if (phase_ != Phase::Budget) return 0;
  return std::max(static_cast<std::size_t>(head_.content_length.value_or(0)),
                  body_.bytes().text.size() + 1);
}

void Connection::retry_budget() {
  guarded([&] {
    ByteBudget* const waited_for = &body_.lacking();
    const BodyReader::Outcome outcome =
        body_phase() == Phase::FillingBody ? body_.reserve(body_left_) : body_.add(pending_piece_);
    if (outcome == BodyReader::Outcome::NoBudget) return;
    waited_for->end_wait();
    phase_ = body_phase();
    last_body_byte_ = thread_.now();
    request_deadline_ += thread_.now() - wait_begun_;  // the wait was not the client's doing
    take_body_outcome(outcome);
    advance();
  });
}

bool Connection::finish_body() {
  if (body_.finish() != BodyReader::Outcome::Ok) {
    refuse({400, ErrorCode::RequestMalformed,
            "the gzip stream of the body is incomplete; send it again"});
    return true;
  }
  exchange_.set_body(body_.bytes());
  run_handler();
  return true;
}

}  // namespace fitgauge::http
