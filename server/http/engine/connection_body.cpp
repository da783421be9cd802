// The bodies of a connection. A request's body is read directly into its memory, or through the
// chunked coding and gzip; it waits while other bodies hold the memory. Answers of asynchronous
// handlers and the pieces of streamed bodies come from other threads.

#include "http/engine/connection.hpp"

namespace fitgauge::http {
namespace {

/// Bodies of unknown length that wait for memory; another one is refused at once.
constexpr std::size_t kMostWaiting = 2;
constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";

thread_local AnswerBatch* batch_of_this_thread = nullptr;

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

AnswerBatch::AnswerBatch() { batch_of_this_thread = this; }

AnswerBatch::~AnswerBatch() {
  batch_of_this_thread = nullptr;
  for (auto& [thread, functions] : threads_) {
    thread->post([functions = std::move(functions)] {
      for (const std::function<void()>& function : functions) function();
    });
  }
}

void AnswerBatch::add(IoThread& thread, std::function<void()> function) {
  auto entry = std::ranges::find(threads_, &thread, &decltype(threads_)::value_type::first);
  if (entry == threads_.end()) entry = threads_.insert(entry, {&thread, {}});
  entry->second.push_back(std::move(function));
}

template <class Function>
void Connection::post(Function function) {
  auto run = [self = shared_from_this(), function = std::move(function)]() mutable {
    if (self->phase_ == Phase::Closed) return;
    self->guarded([&] {
      function(*self);
      self->advance();
    });
  };
  if (batch_of_this_thread != nullptr) {
    batch_of_this_thread->add(thread_, std::move(run));
  } else {
    thread_.post(std::move(run));
  }
}

void Connection::post_answer(Response response) {
  post([response = std::move(response)](Connection& self) mutable {
    if (self.phase_ == Phase::InHandler) self.answer(std::move(response));
  });
}

void Connection::post_error(Error error) {
  post([error = std::move(error)](Connection& self) {
    if (self.phase_ == Phase::InHandler) self.answer(self.exchange_.error_response(error));
  });
}

void Connection::post_unanswered() {
  post([](Connection& self) {
    if (self.phase_ == Phase::InHandler) self.answer(self.exchange_.unanswered());
  });
}

void Connection::post_piece(std::string bytes, bool is_last) {
  if (packer_) {
    packer_->add(bytes);
    bytes = is_last ? packer_->finish() : packer_->take();
  }
  post([bytes = std::move(bytes), is_last](Connection& self) {
    if (self.phase_ == Phase::Piece) self.take_piece(bytes, is_last);
  });
}

void Connection::post_stream_failure() {
  post([](Connection& self) {
    if (self.phase_ == Phase::Piece) self.close();
  });
}

bool Connection::step_stream() {
  if (!output_.empty()) return false;
  phase_ = Phase::Piece;
  deadline_ = thread_.now() + stream_->heartbeat_interval;
  stream_->source->next(ChunkSink(shared_from_this()));
  return false;
}

void Connection::append_piece(std::string_view bytes) {
  const std::size_t before = output_.text_size();
  if (sent_.chunked) {
    append_chunk(output_.text(), bytes);
  } else {
    output_.text().append(bytes);
  }
  sent_bytes_ += output_.text_size() - before;
}

void Connection::take_piece(std::string_view bytes, bool is_last) {
  phase_ = Phase::Stream;
  append_piece(bytes);
  if (!is_last) return;
  if (sent_.chunked) output_.text().append(kLastChunk);
  stream_.reset();
  packer_.reset();
  finish_request();
}

void Connection::beat(Tick now) {
  if (now < deadline_) return;
  deadline_ = now + stream_->heartbeat_interval;
  stream_->source->idle();
  if (stream_->heartbeat.empty()) return;
  append_piece(stream_->heartbeat);
  advance();
}

Responder::~Responder() {
  if (connection_) std::exchange(connection_, nullptr)->post_unanswered();
}
void Responder::answer(Response response) {
  if (connection_) std::exchange(connection_, nullptr)->post_answer(std::move(response));
}
void Responder::fail(Error error) {
  if (connection_) std::exchange(connection_, nullptr)->post_error(std::move(error));
}

ChunkSink::~ChunkSink() { fail(); }
void ChunkSink::put(std::string bytes) {
  if (connection_) std::exchange(connection_, nullptr)->post_piece(std::move(bytes), false);
}
void ChunkSink::finish(std::string bytes) {
  if (connection_) std::exchange(connection_, nullptr)->post_piece(std::move(bytes), true);
}
void ChunkSink::fail() {
  if (connection_) std::exchange(connection_, nullptr)->post_stream_failure();
}

}  // namespace fitgauge::http
