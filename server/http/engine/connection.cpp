#include "http/engine/connection.hpp"

namespace fitgauge::http {

namespace {

/// Answers wait for each other up to this size, then they are sent.
constexpr std::size_t kBatch = std::size_t{64} << 10;
/// After a refusal, the connection waits until the sender is silent for this time.
constexpr auto kLinger = std::chrono::seconds(2);

const Refusal kTimedOut{408, ErrorCode::RequestTimeout,
                        "the request took too long to arrive: send it faster"};

}  // namespace

const Refusal Connection::kCrowded{503, ErrorCode::Overloaded,
                                   "too many large bodies arrive at once: try again soon"};

Connection::Connection(IoThread& thread, Peer peer)
    : thread_(thread),
      peer_(std::move(peer)),
      output_(thread.output()),
      exchange_(thread.shared().routes, thread.shared().hooks,
                thread.shared().options.allowed_origins, peer_),
      body_(thread.shared().budgets) {
  deadline_ = thread_.now() + thread_.shared().options.header_timeout;
}

void Connection::begin() {
  if (phase_ != Phase::Opening) return;
  phase_ = Phase::Idle;
  deadline_ = thread_.now() + thread_.shared().options.idle_timeout;
  guarded([&] { advance(); });
}

void Connection::on_read(const error_code& error, std::size_t count) noexcept {
  reading_ = false;
  if (phase_ == Phase::Closed) return;
  if (error) return close();
  guarded([&] {
    if (phase_ == Phase::Lingering) {
      if (!thread_.shared().stopping) linger();
      return read_more();
    }
    if (phase_ == Phase::Idle && close_after_) return;  // refused while it was being read
    last_body_byte_ = thread_.now();
    if (phase_ == Phase::FillingBody) {
      body_.added(count);
      body_left_ -= count;
      received_ += count;
    } else {
      input_.added(count);
    }
    advance();
  });
}

void Connection::on_write(const error_code& error, std::size_t count) noexcept {
  writing_ = false;
  if (phase_ == Phase::Closed) return;
  if (error) return close();
  guarded([&] {
    output_.consume(count);
    advance();
  });
}

void Connection::advance() {
  while (phase_ != Phase::Closed && !writing_) {
    while (step()) {
    }
    if (output_.empty()) break;
    if (!send()) return;
  }
  if (phase_ == Phase::Closed) return;
  if (writing_) return output_.keep();
  switch (phase_) {
    case Phase::Idle: return close_after_ ? end() : read_next_request();
    case Phase::Head:
    case Phase::ReadingBody:
    case Phase::FillingBody: return read_more();
    default: return;
  }
}

bool Connection::step() {
  if (output_.has_long_body() || output_.text_size() > kBatch) return false;
  switch (phase_) {
    case Phase::Idle: return !close_after_ && begin_request();
    case Phase::Head: return step_head();
    case Phase::ReadingBody: return step_body();
    case Phase::FillingBody: return body_left_ == 0 && finish_body();
    case Phase::Stream: return step_stream();
    default: return false;
  }
}

bool Connection::step_head() {
  std::size_t used = 0;
  const RequestParser::Step parsed = parser_->put(input_.unread(), used);
  input_.advance(used);
  received_ += used;
  switch (parsed) {
    case RequestParser::Step::NeedMore: return false;
    case RequestParser::Step::Head: return open_exchange();
    default: refuse(parser_->refusal()); return true;
  }
}

bool Connection::begin_request() {
  // Empty lines before a request are skipped (RFC 9112 section 2.2).
  while (input_.unread().starts_with("\r\n")) {
    input_.advance(2);
    input_.next_request();
  }
  if (input_.unread().empty() || input_.unread() == "\r") return false;
  const ServerShared& shared = thread_.shared();
  phase_ = Phase::Head;
  received_ = 0;
  parser_.emplace(head_);
  deadline_ = thread_.now() + shared.options.header_timeout;
  request_deadline_ = thread_.now() + shared.options.request_timeout;
  if (shared.hooks.finished) started_ = std::chrono::steady_clock::now();
  return true;
}

bool Connection::open_exchange() {
  if (!head_.keep_alive || thread_.shared().stopping.load(std::memory_order_relaxed))
    close_after_ = true;
  sent_ = {};
  sent_bytes_ = 0;
  is_open_ = true;
  if (auto early = exchange_.open(head_, thread_.next_request_id())) {
    skip_buffered_body();
    answer(std::move(*early));
    return true;
  }
  if (head_.has_body()) return begin_body();
  exchange_.set_body({});
  run_handler();
  return true;
}

void Connection::run_handler() {
  phase_ = Phase::InHandler;
  if (exchange_.has_to_wait()) return exchange_.run_later(Responder(shared_from_this()));
  auto result = exchange_.run_now();
  if (!result) return answer(exchange_.error_response(result.error()));
  answer(std::move(*result));
}

void Connection::answer(Response&& response) {
  const std::size_t before = output_.text_size();
  sent_ = append_answer(output_, response, exchange_.form(!close_after_), thread_.date());
  sent_bytes_ = output_.text_size() - before + output_.long_body_size();
  if (!sent_.keep_alive) close_after_ = true;
  if (!sent_.streams) return finish_request();
  stream_ = std::move(std::get<StreamedBody>(response.body));
  if (sent_.packed) packer_ = std::make_unique<GzipWriter>();
  phase_ = Phase::Stream;
}

void Connection::report(bool broken_off) {
  if (!std::exchange(is_open_, false)) return;
  if (const auto& finished = thread_.shared().hooks.finished) {
    using std::chrono::microseconds;
    const Request& request = exchange_.request();
    const auto spent = std::chrono::steady_clock::now() - started_;
    finished({.request = request,
              .route = request.route() == nullptr ? std::string_view{} : request.route()->pattern,
              .method = head_.method,
              .status = sent_.status,
              .broken_off = broken_off,
              .microseconds = std::chrono::duration_cast<microseconds>(spent).count(),
              .bytes_received = received_,
              .bytes_sent = sent_bytes_});
  }
}

void Connection::finish_request() {
  thread_.count_request();
  report(false);
  exchange_.clear();
  head_.clear();
  parser_.reset();
  pending_piece_ = {};
  if (!reading_) body_.clear();  // otherwise close() does it when nothing reads into it
  input_.next_request();
  phase_ = Phase::Idle;
}

bool Connection::send() {
  while (!output_.empty()) {
    const std::string_view bytes = output_.front();
    bool broken = false;
    const std::size_t count = write_now(bytes, broken);
    if (broken) {
      close();
      return false;
    }
    output_.consume(count);
    if (count == bytes.size()) continue;
    output_.keep();
    if (!unsent_since_) unsent_since_ = thread_.now();
    writing_ = true;
    write_deadline_ = thread_.now() + thread_.shared().options.write_timeout;
    write_some(output_.front());
    return false;
  }
  unsent_since_.reset();
  return true;
}

void Connection::read_more() {
  if (reading_) return;
  std::span<char> room;
  switch (phase_) {
    case Phase::Lingering: room = input_.room_to_discard(); break;
    case Phase::FillingBody: room = body_.room(); break;
    case Phase::ReadingBody: room = input_.room_for_body(kMaxFraming); break;
    default: room = input_.room_for_head(head_);
  }
  reading_ = true;
  read_some(room);
}

void Connection::read_next_request() {
  if (reading_) return;
  deadline_ = thread_.now() + thread_.shared().options.idle_timeout;
  if (thread_.next_reads().put(*this)) {
    reading_ = true;
  } else {
    read_more();
  }
}

bool Connection::read_in_turn() noexcept {
  reading_ = false;
  if (phase_ == Phase::Closed) return true;
  error_code error;
  std::size_t count = 0;
  guarded([&] {
    count = read_now(input_.room_for_head(head_), error);
    if (error == asio::error::would_block) read_more();
  });
  if (error == asio::error::would_block) return false;
  on_read(error, count);
  return true;
}

std::size_t Connection::read_now(std::span<char>, error_code& error) {
  error = asio::error::would_block;
  return 0;
}

void Connection::end() {
  if (reading_ || (!lingers_ && !peer_.tls)) return close();
  phase_ = Phase::Lingering;
  request_deadline_ = thread_.now() + thread_.shared().options.request_timeout;
  linger();
  end_gracefully();
}

void Connection::linger() { deadline_ = std::min(thread_.now() + kLinger, request_deadline_); }

void Connection::close() noexcept {
  if (phase_ == Phase::Closed) return;
  const auto self = shared_from_this();
  if (phase_ == Phase::Budget) body_.lacking().end_wait();
  const bool in_handler = phase_ == Phase::InHandler;
  fitgauge::guarded("a request that ends early", [&] { report(true); });
  phase_ = Phase::Closed;
  close_socket();
  if (!in_handler) body_.clear();  // a handler has the request until its Responder is gone
  output_.discard();
  if (const auto stream = std::exchange(stream_, std::nullopt))
    fitgauge::guarded("a stream that ends early", [&] { stream->source->cancelled(); });
  thread_.remove(*this);
}

/// The caller of a stream may not read on.
void Connection::break_off() {
  close_after_ = true;
  if (!stream_->is_endless || phase_ != Phase::Piece || writing_) return close();
  const auto source = stream_->source;
  take_piece({}, true);
  source->cancelled();
  advance();
}

void Connection::check_deadline(Tick now) {
  const auto& may_continue = thread_.shared().hooks.may_continue;
  if (stream_ && may_continue) {
    guarded([&] {
      if (!may_continue(exchange_.request())) break_off();
    });
  }
  if (writing_) {
    if (now >= write_deadline_) close();
    return;
  }
  guarded([&] {
    switch (phase_) {
      case Phase::Head:
        if (now < std::min(deadline_, request_deadline_)) return;
        refuse(kTimedOut);
        return advance();
      case Phase::ReadingBody:
      case Phase::FillingBody: {
        // After a busy second of this thread, a client may have sent bytes and only seems to stall.
        const bool gives_way = body_.is_wanted() &&
                               now - last_body_byte_ >= thread_.shared().options.stall_time &&
                               !has_unread();
        if (now < request_deadline_ && !gives_way) return;
        refuse(kTimedOut);
        return advance();
      }
      case Phase::Budget: {
        if (now - wait_begun_ < thread_.shared().options.request_timeout) return;
        body_.lacking().end_wait();
        phase_ = body_phase();
        refuse(kCrowded);
        return advance();
      }
      case Phase::Piece: return beat(now);
      case Phase::Opening:
      case Phase::Idle:
      case Phase::Lingering:
        if (now >= deadline_) close();
        return;
      case Phase::Stream:
      case Phase::InHandler:
      case Phase::Closed: return;
    }
  });
}

}  // namespace fitgauge::http
