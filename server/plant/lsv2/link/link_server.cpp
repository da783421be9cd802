#include "plant/lsv2/link/link_server.hpp"

#include "plant/tcp_listener.hpp"

namespace fitgauge::control_link {
namespace {

/// One client of a LinkServer and its conversation, on the server's thread. One answer at a time:
/// the next telegram is looked at when the last answer has left.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  using Ended = std::function<void(std::string_view why)>;

  /// @param options outlives it. @param ended is called once; an empty reason: the client has left.
  Connection(http::Socket socket, std::unique_ptr<Conversation> conversation,
             const LinkServerOptions& options, Ended ended)
      : socket_(std::move(socket)),
        conversation_(std::move(conversation)),
        options_(options),
        ended_(std::move(ended)),
        deadline_(socket_.get_executor()) {}

  /// Answers the telegrams that have come, then reads on.
  /// @param is_new whether a telegram or a silence begins now
  void go_on(bool is_new) {
    take([&] { answer(is_new); });
  }

 private:
  /// A bug in a session, or missing memory, ends only that session.
  void take(const auto& step) {
    if (!guarded("a control's conversation", step)) end("the service failed");
  }

  void answer(bool is_new) {
    for (;; is_new = true) {
      reader_.set_buffer(conversation_->buffer());
      const auto telegram = reader_.next();
      if (!telegram) return end("the client does not send telegrams");
      if (!*telegram) return read(is_new);
      const auto reply = conversation_->answer(**telegram);
      if (!reply) continue;
      out_ = framed(*reply);
      return write();
    }
  }

  void read(bool is_new) {
    // The time of a telegram begins with its first byte; later bytes do not extend it.
    if (is_new && reader_.is_inside()) {
      end_after(options_.telegram_timeout, "its telegram stays short");
    } else if (is_new) {
      end_after(options_.idle_timeout, "the client was silent for too long");
    }
    socket_.async_read_some(http::asio::buffer(bytes_),
                            [self = shared_from_this()](http::error_code error, std::size_t count) {
                              if (error) return self->end("");
                              self->take([&] {
                                const bool was_inside = self->reader_.is_inside();
                                self->reader_.feed({self->bytes_.data(), count});
                                self->answer(!was_inside);
                              });
                            });
  }

  void write() {
    end_after(options_.write_timeout, "the client does not read its answer");
    socket_.async_write_some(
        http::asio::buffer(out_),
        [self = shared_from_this()](http::error_code error, std::size_t count) {
          if (error) return self->end("");
          self->out_.erase(0, count);
          self->take([&] { self->out_.empty() ? self->answer(true) : self->write(); });
        });
  }

  void end_after(std::chrono::milliseconds time, std::string_view why) {
    deadline_.expires_after(time);
    deadline_.async_wait([weak = weak_from_this(), why](http::error_code cancelled) {
      const auto self = weak.lock();
      if (cancelled || !self) return;
      // Its time may have been extended just before.
      if (self->deadline_.expiry() <= std::chrono::steady_clock::now()) self->end(why);
    });
  }

  void end(std::string_view why) {
    if (std::exchange(has_ended_, true)) return;
    deadline_.cancel();
    ended_(why);
    http::error_code ignored;
    socket_.close(ignored);
  }

  http::Socket socket_;
  const std::unique_ptr<Conversation> conversation_;
  const LinkServerOptions& options_;
  const Ended ended_;
  http::Timer deadline_;  ///< of its current step: reading a telegram, writing an answer, silence
  TelegramReader reader_;
  std::array<char, kLargestBuffer> bytes_;
  std::string out_;
  bool has_ended_ = false;
};

}  // namespace

LinkServer::LinkServer(LinkServerOptions options, LinkServerHooks hooks)
    : options_(std::move(options)), hooks_(std::move(hooks)) {
  const auto take = [this](http::Socket client, const std::string& peer) {
    const auto tell = [this, peer](std::string_view why) {
      if (!why.empty() && hooks_.sent_away) hooks_.sent_away(peer, why);
    };
    if (connections_ >= options_.most_connections) return tell("too many clients are connected");
    http::error_code ignored;
    client.set_option(http::asio::ip::tcp::no_delay(true), ignored);
    const auto ended = [this, tell](std::string_view why) {
      --connections_;
      tell(why);
    };
    const auto connection =
        std::make_shared<Connection>(std::move(client), hooks_.converse(), options_, ended);
    ++connections_;
    connection->go_on(true);
  };
  listener_ =
      std::make_unique<connections::TcpListener>("control links", "a control's conversation", take);
}

LinkServer::~LinkServer() = default;

std::uint16_t LinkServer::port() const { return listener_->port(); }

Result<std::unique_ptr<LinkServer>> LinkServer::start(LinkServerOptions options,
                                                      LinkServerHooks hooks) {
  std::unique_ptr<LinkServer> server(new LinkServer(std::move(options), std::move(hooks)));
  TRY(server->listener_->open(server->options_.host, server->options_.port));
  return server;
}

}  // namespace fitgauge::control_link
