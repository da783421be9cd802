// The parts of a connection that other threads reach: answers of asynchronous handlers and the
// pieces of streamed bodies.

#include "http/engine/connection.hpp"
#include "http/engine/io_thread.hpp"
#include "http/response.hpp"

namespace fitgauge::http {

/// The answers of one thread for the I/O threads, collected for an AnswerBatch.
class Posts {
 public:
  /// Outputs of the calling thread; null if it has no AnswerBatch.
  static Posts* kept();

  Posts();
  Posts& operator=(Posts&&) = delete;  // neither copied nor moved
  /// Posts the collected outputs.
  ~Posts();

  void add(IoThread& thread, std::function<void()> function);

 private:
  using Functions = std::vector<std::function<void()>>;

  std::vector<std::pair<IoThread*, Functions>> threads_;  ///< as few as there are I/O threads
};

namespace {

thread_local Posts* posts_of_this_thread = nullptr;

}  // namespace

Posts* Posts::kept() { return posts_of_this_thread; }

Posts::Posts() { posts_of_this_thread = this; }

Posts::~Posts() {
  posts_of_this_thread = nullptr;
  for (auto& [thread, functions] : threads_) {
    thread->post([functions = std::move(functions)] {
      for (const std::function<void()>& function : functions) function();
    });
  }
}

void Posts::add(IoThread& thread, std::function<void()> function) {
  const auto is_same = [&](const auto& entry) { return entry.first == &thread; };
  auto entry = std::find_if(threads_.begin(), threads_.end(), is_same);
  if (entry == threads_.end()) entry = threads_.insert(entry, {&thread, {}});
  entry->second.push_back(std::move(function));
}

AnswerBatch::AnswerBatch() : posts_(std::make_unique<Posts>()) {}
AnswerBatch::~AnswerBatch() = default;

template <class Function>
void Connection::post(Function function) {
  auto run = [self = shared_from_this(), function = std::move(function)]() mutable {
    if (self->phase_ == Phase::Closed) return;
    self->guarded([&] {
      function(*self);
      self->advance();
    });
  };
  if (Posts* const posts = Posts::kept()) {
    posts->add(thread_, std::move(run));
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

Responder::Responder(std::shared_ptr<Connection> connection) : connection_(std::move(connection)) {}
Responder::Responder(Responder&&) noexcept = default;
Responder& Responder::operator=(Responder&& other) noexcept {
  std::swap(connection_, other.connection_);
  return *this;
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

ChunkSink::ChunkSink(std::shared_ptr<Connection> connection) : connection_(std::move(connection)) {}
ChunkSink::ChunkSink(ChunkSink&&) noexcept = default;
ChunkSink& ChunkSink::operator=(ChunkSink&& other) noexcept {
  std::swap(connection_, other.connection_);
  return *this;
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
