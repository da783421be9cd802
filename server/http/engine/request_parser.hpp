#pragma once

#include <boost/beast/http/basic_parser.hpp>
#include <boost/system/error_code.hpp>

#include "http/engine/request_head.hpp"

namespace fitgauge::http {

inline constexpr std::size_t kMaxTarget = std::size_t{8} << 10;
inline constexpr std::size_t kMaxHeaderSection = std::size_t{32} << 10;
inline constexpr std::size_t kMaxFields = 100;
/// A chunk line, a trailer section, or any run of framing that yields no byte of the body.
inline constexpr std::size_t kMaxFraming = std::size_t{16} << 10;

/// Beast's parser for one request, with additional checks (RFC 9112 sections 5 to 7). It collects
/// views in a RequestHead and no copies. One object per request; unusable after Refused.
class RequestParser final : private boost::beast::http::basic_parser<true> {
 public:
  enum class Step {
    NeedMore,   ///< feed the rest of the input again together with more bytes
    Head,       ///< the head is complete; more follows when it has a body
    BodyPiece,  ///< piece() is a part of the body, perhaps empty
    Complete,   ///< the chunked body has ended
    Refused,    ///< see refusal(); the connection must end
  };

  explicit RequestParser(RequestHead& head);

  /// Parses on from `input` and adds the number of bytes used to `used`.
  Step put(std::string_view input, std::size_t& used);

  /// Limits the body: a chunk that exceeds this number together with the earlier chunks is refused
  /// as soon as its size is read. Without a call the body is unlimited.
  void limit_body(std::uint64_t bytes) { body_left_ = bytes; }

  std::string_view piece() const { return piece_; }
  const Refusal& refusal() const { return refusal_; }

 private:
  using ErrorCodeOut = boost::beast::error_code;

  Step parse(std::string_view input, std::size_t& used);
  Step refuse(int status, ErrorCode code, const char* message) {
    if (!refused_) refusal_ = {status, code, message};
    refused_ = true;
    return Step::Refused;
  }
  Step refuse_long_header() {
    return refuse(431, ErrorCode::HeaderTooLarge,
                  "header section must have at most 32 KiB; send fewer or shorter fields");
  }
  Step refuse_body() {
    return refuse(413, ErrorCode::BodyTooLarge,
                  "the request announces a larger body than this route accepts");
  }
  Step take_error(const boost::beast::error_code& error, std::string_view pending);
  Step need_more(std::string_view pending);
  bool check_head();

  void on_request_impl(boost::beast::http::verb, boost::beast::string_view method,
                       boost::beast::string_view target, int version, ErrorCodeOut&) override;
  void on_response_impl(int, boost::beast::string_view, int, ErrorCodeOut&) override {}
  void on_field_impl(boost::beast::http::field field, boost::beast::string_view name,
                     boost::beast::string_view value, ErrorCodeOut& error) override;
  void on_header_impl(ErrorCodeOut&) override { head_done_ = true; }
  void on_body_init_impl(const boost::optional<std::uint64_t>&, ErrorCodeOut&) override {}
  std::size_t on_body_impl(boost::beast::string_view body, ErrorCodeOut&) override {
    return body.size();
  }
  void on_chunk_header_impl(std::uint64_t size, boost::beast::string_view,
                            ErrorCodeOut& error) override;
  std::size_t on_chunk_body_impl(std::uint64_t, boost::beast::string_view body,
                                 ErrorCodeOut&) override {
    piece_ = {body.data(), body.size()};
    return body.size();
  }
  void on_finish_impl(ErrorCodeOut&) override {}

  RequestHead& head_;
  Refusal refusal_{};
  std::string_view piece_;
  std::uint64_t body_left_ = std::numeric_limits<std::uint64_t>::max();
  std::size_t head_bytes_ = 0;   ///< header section consumed so far
  std::size_t framing_run_ = 0;  ///< bytes since the last byte of the body
  bool head_done_ = false;
  bool refused_ = false;
  bool has_host_ = false;
  bool has_content_type_ = false;
  bool has_transfer_encoding_ = false;
  bool has_content_length_ = false;
};

}  // namespace fitgauge::http
