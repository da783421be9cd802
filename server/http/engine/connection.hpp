#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "base/guarded.hpp"
#include "http/body_stream.hpp"
#include "http/engine/body_reader.hpp"
#include "http/engine/exchange.hpp"
#include "http/engine/input_buffer.hpp"
#include "http/engine/io_thread.hpp"
#include "http/engine/output_queue.hpp"
#include "http/engine/request_head.hpp"
#include "http/engine/request_parser.hpp"

namespace fitgauge::http {

/// One client's connection: reads requests one after the other, answers every complete one that the
/// buffer holds and sends the answers in one write. Owns its buffers; the socket belongs to the
/// transport that derives from it. Runs on its I/O thread alone; post_*() may be called from any.
/// The thread keeps it until close(); then it only waits for its last owner (a Responder, an
/// operation of the socket) to go.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(IoThread& thread, Peer peer);
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  virtual ~Connection() = default;

  /// Begins to serve.
  virtual void start() = 0;

  void post_answer(Response response);
  void post_error(Error error);
  void post_unanswered();
  void post_piece(std::string bytes, bool is_last);
  void post_stream_failure();

  // For the sweep of the I/O thread.

  /// Acts on a deadline that has passed.
  void check_deadline(Tick now);
  /// The bytes of answers that the client has not taken yet, and since when it takes them.
  std::size_t bytes_unsent() const { return output_.held(); }
  std::optional<Tick> unsent_since() const { return unsent_since_; }

  /// The bytes a body waits for before it can be read on, or 0.
  std::size_t bytes_waited_for() const;
  std::uint64_t request_id() const { return exchange_.request().id(); }
  void retry_budget();
  /// For NextReads: reads what has come since the last answer, or waits for it.
  /// @returns false when nothing had come.
  bool read_in_turn() noexcept;
  /// The server stops: ends now or after the request in flight.
  void drain();
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
  /// What has come by now; `error` is would_block when nothing has, or the transport cannot tell.
  virtual std::size_t read_now(std::span<char> room, error_code& error);
  /// Whether bytes have come that no read has taken; false when the transport cannot tell.
  virtual bool has_unread() const noexcept { return false; }
  /// What the socket takes at once; `broken` when it takes nothing any more.
  virtual std::size_t write_now(std::string_view bytes, bool& broken) = 0;
  virtual void write_some(std::string_view bytes) = 0;  ///< then on_write
  /// Shuts down the sending side when all is sent and the client may still be sending; closes when
  /// the client does, at the latest at the deadline.
  virtual void end_gracefully() = 0;
  virtual void close_socket() noexcept = 0;

 private:
  enum class Phase : std::uint8_t {
    Opening,      ///< the transport shakes hands
    Idle,         ///< between requests: no byte of the next has come
    Head,         ///< the first byte of a request has come
    ReadingBody,  ///< through the parser or a decoder
    FillingBody,  ///< as it comes: the socket fills its memory
    Budget,       ///< a body waits for its share of memory
    InHandler,
    Stream,     ///< a streamed body: its last piece is on its way
    Piece,      ///< a streamed body: its next piece is awaited
    Lingering,  ///< answered and shut down; what still comes is thrown away, so that no reset
                ///< overtakes the answer
    Closed,
  };

  /// Running out of memory, or a hook that throws, ends this connection alone.
  template <class Function>
  void guarded(Function&& function) noexcept {
    if (!fitgauge::guarded("a connection", std::forward<Function>(function))) close();
  }
  template <class Function>
  void post(Function function);

  /// Goes on as far as possible: steps, sends, reads.
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
  void refuse(const Refusal& refusal);
  void answer(Response&& response);
  void finish_request();
  bool send();
  void read_next_request();
  void end();
  void linger();

  void append_piece(std::string_view bytes);
  void take_piece(std::string_view bytes, bool is_last);
  void beat(Tick now);

  IoThread& thread_;
  Peer peer_;
  Phase phase_ = Phase::Opening;
  bool reading_ = false;  ///< also while it waits for its turn to
  bool writing_ = false;
  bool close_after_ = false;  ///< no further request on this connection
  bool lingers_ = false;      ///< the client may still be sending what is not read any more
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
  std::size_t body_left_ = 0;       ///< still to come of a body with a length
  std::string_view pending_piece_;  ///< read, and not yet taken by body_
  std::optional<StreamedBody> stream_;
  SentAnswer sent_{};
  std::uint64_t received_ = 0;
  std::uint64_t sent_bytes_ = 0;
};

}  // namespace fitgauge::http
