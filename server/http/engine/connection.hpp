#pragma once

#include <cassert>

#include "http/engine/exchange.hpp"
#include "http/engine/io_thread.hpp"
#include "http/engine/request_parser.hpp"

namespace fitgauge::http {

/// The bytes read from a connection: the head of the current request, then unparsed bytes. Small
/// while idle, grows with a long head. A complete head does not move: pin_head() moves it aside
/// before its body is read.
class InputBuffer {
 public:
  static constexpr std::size_t kSmall = 4096;

  std::string_view unread() const { return {data_.get() + parsed_, end_ - parsed_}; }
  void advance(std::size_t count) { parsed_ += count; }
  void added(std::size_t count) { end_ += count; }

  /// Ends the request in work: the next bytes begin another one.
  void next_request() {
    begin_ = parsed_;
    pinned_.reset();
  }

  /// Returns room to read into for an incomplete head. Earlier bytes may move; `head` follows.
  std::span<char> room_for_head(RequestHead& head) {
    assert(!pinned_);
    if (begin_ == end_) {
      begin_ = parsed_ = end_ = 0;
      if (capacity_ != kSmall) resize(kSmall);
    } else if (end_ == capacity_) {
      const char* const old = data_.get() + begin_;
      const std::unique_ptr<char[]> before = begin_ > 0 ? nullptr : grow(begin_, 1);
      if (!before) move_to_front();
      head.rebase(old, data_.get());
    }
    return {data_.get() + end_, capacity_ - end_};
  }

  /// Prepares to read the body of a complete head: the head stays in place until next_request(),
  /// unread bytes move to other memory.
  /// @pre nothing is being read into the buffer.
  void pin_head() {
    assert(!pinned_);
    pinned_ = grow(parsed_, kSmall);
  }

  /// Returns room for `size` bytes of a body after the unread bytes. @pre pin_head()
  std::span<char> room_for_body(std::size_t size) {
    assert(pinned_);
    if (capacity_ - end_ < size) grow(parsed_, size);
    return {data_.get() + end_, capacity_ - end_};
  }

  /// Clears the buffer; later bytes are discarded.
  std::span<char> room_to_discard() {
    begin_ = parsed_ = end_ = 0;
    if (capacity_ == 0) resize(kSmall);
    return {data_.get(), capacity_};
  }

 private:
  void move_to_front() {
    std::memmove(data_.get(), data_.get() + begin_, end_ - begin_);
    parsed_ -= begin_;
    end_ -= begin_;
    begin_ = 0;
  }

  /// Copies the bytes after `from` to new memory with room for `size` more bytes.
  /// @returns the old memory.
  std::unique_ptr<char[]> grow(std::size_t from, std::size_t size) {
    const std::size_t kept = end_ - from;
    std::size_t capacity = kSmall;
    while (capacity < kept + size) capacity *= 2;
    std::unique_ptr<char[]> before = std::move(data_);
    resize(capacity);
    std::memcpy(data_.get(), before.get() + from, kept);
    parsed_ -= from;
    end_ = kept;
    begin_ = 0;
    return before;
  }

  void resize(std::size_t capacity) {
    data_.reset(new char[capacity + Request::kBodyPadding]);
    capacity_ = capacity;
  }

  std::unique_ptr<char[]> data_;
  std::unique_ptr<char[]> pinned_;  ///< the head, while its body is read
  std::size_t capacity_ = 0;
  std::size_t begin_ = 0;   ///< of the request in work
  std::size_t parsed_ = 0;  ///< up to here the parser has been
  std::size_t end_ = 0;
};

/// One client's connection: reads requests in turn, answers every complete one in the buffer and
/// sends the responses in one write. Owns its buffers; the socket belongs to the derived transport.
/// Runs only on its I/O thread; post_*() may be called from any. The thread keeps it until close();
/// then it waits only for its last owner (a Responder, an operation of the socket).
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(IoThread& thread, Peer peer);
  Connection& operator=(Connection&&) = delete;  // neither copied nor moved
  virtual ~Connection() = default;

  /// Begins to serve.
  virtual void start() = 0;

  void post_answer(Response response);
  void post_error(Error error);
  void post_unanswered();
  /// Called by one thread at a time, which packs the piece if the body is in gzip.
  void post_piece(std::string bytes, bool is_last);
  void post_stream_failure();

  // For the sweep of the I/O thread.

  /// Acts on a deadline that has passed.
  void check_deadline(Tick now);
  /// Unsent bytes of responses, and the time since when the client reads them.
  std::size_t bytes_unsent() const { return output_.held() + (stream_ ? stream_->held : 0); }
  std::optional<Tick> unsent_since() const { return unsent_since_; }

  /// The bytes a body waits for before it can be read on, or 0.
  std::size_t bytes_waited_for() const {
    if (phase_ != Phase::Budget) return 0;
    return std::max(static_cast<std::size_t>(head_.content_length.value_or(0)),
                    body_.bytes().text.size() + 1);
  }
  std::uint64_t request_id() const { return exchange_.request().id(); }
  void retry_budget();
  /// Called by NextReads: reads the bytes after the last response, or waits for them.
  /// @returns false if there were none.
  bool read_in_turn() noexcept;
  /// The server stops: ends now or after the request in flight.
  void drain() {
    close_after_ = true;
    const bool streams = phase_ == Phase::Stream || phase_ == Phase::Piece;
    if (phase_ == Phase::Opening || (phase_ == Phase::Idle && !writing_) || streams) close();
  }
  void close() noexcept;

  std::size_t index = 0;         ///< in the thread's list
  std::optional<Place> place{};  ///< among all that are open, while it is in that list

 protected:
  void begin();  ///< the transport is ready for requests
  void on_read(const error_code& error, std::size_t count) noexcept;
  void on_write(const error_code& error, std::size_t count) noexcept;
  void read_more();

  IoThread& thread() { return thread_; }
  Peer& peer() { return peer_; }

  virtual void read_some(std::span<char> room) = 0;  ///< then on_read
  /// Reads the bytes that have arrived; would_block if none, or unknown.
  virtual std::size_t read_now(std::span<char> room, error_code& error);
  /// Whether unread bytes have arrived; false if the transport does not know.
  virtual bool has_unread() const noexcept { return false; }
  /// Writes the bytes that the socket accepts at once; `broken` if it accepts none again.
  virtual std::size_t write_now(std::string_view bytes, bool& broken) = 0;
  virtual void write_some(std::string_view bytes) = 0;  ///< then on_write
  /// Shuts down the sending side when all is sent and the client may still be sending; closes when
  /// the client does, at the latest at the deadline.
  virtual void end_gracefully() = 0;
  virtual void close_socket() noexcept = 0;

 private:
  enum class Phase : std::uint8_t {
    Opening,      ///< the transport shakes hands
    Idle,         ///< between requests: no byte of the next request has arrived
    Head,         ///< the first byte of a request has arrived
    ReadingBody,  ///< through the parser or a decoder
    FillingBody,  ///< the socket writes into the body's memory
    Budget,       ///< a body waits for its share of memory
    InHandler,
    Stream,     ///< a streamed body: its last piece is on its way
    Piece,      ///< a streamed body: its next piece is awaited
    Lingering,  ///< answered and shut down; further bytes are discarded, to prevent a reset
                ///< overtakes the answer
    Closed,
  };

  /// An exception, also of memory or a hook, ends only this connection.
  template <class Function>
  void guarded(Function&& function) noexcept {
    if (!fitgauge::guarded("a connection", std::forward<Function>(function))) close();
  }
  template <class Function>
  void post(Function function);

  /// Advances as far as possible: steps, sends, reads.
  void advance();
  /// One step of the request in work. @returns false when it needs bytes, room or an answer.
  bool step();
  bool step_head();
  bool step_body();
  bool step_stream();

  bool begin_request();
  bool open_exchange();
  void skip_buffered_body();
  Phase body_phase() const;
  bool begin_body();
  bool admit_body();
  bool take_body_outcome(BodyReader::Outcome outcome);
  bool finish_body();
  void run_handler();
  void refuse(const Refusal& refusal) {
    close_after_ = lingers_ = true;
    is_open_ = true;
    answer(exchange_.refuse(head_, thread_.next_request_id(), refusal));
  }
  void answer(Response&& response);
  void finish_request();
  void report(bool broken_off);
  bool send();
  void read_next_request();
  void end();
  void linger();

  void append_piece(std::string_view bytes);
  void take_piece(std::string_view bytes, bool is_last);
  void beat(Tick now);
  void break_off();

  static const Refusal kCrowded;

  IoThread& thread_;
  Peer peer_;
  Phase phase_ = Phase::Opening;
  bool reading_ = false;  ///< also while it waits for its turn to
  bool writing_ = false;
  bool close_after_ = false;  ///< no further request on this connection
  bool lingers_ = false;      ///< the client may still send bytes that are ignored
  Tick deadline_{};           ///< of the phase
  Tick request_deadline_{};
  Tick write_deadline_{};
  std::optional<Tick> unsent_since_{};  ///< none: everything has left
  Tick last_body_byte_{};
  Tick wait_begun_{};
  Tick started_{};

  InputBuffer input_;
  OutputQueue output_;
  RequestHead head_;
  std::optional<RequestParser> parser_;
  Exchange exchange_;
  BodyReader body_;
  std::size_t body_left_ = 0;       ///< remaining bytes of a body with a length
  std::string_view pending_piece_;  ///< read, and not yet consumed by body_
  std::optional<StreamedBody> stream_;
  /// Used by the thread that has the sink of the stream, even while the connection closes.
  std::unique_ptr<GzipWriter> packer_;
  bool is_open_ = false;  ///< a request has a head, and no report yet
  SentAnswer sent_{};
  std::uint64_t received_ = 0;
  std::uint64_t sent_bytes_ = 0;
};

}  // namespace fitgauge::http
