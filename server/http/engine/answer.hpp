#pragma once

#include "base/clock.hpp"
#include "http/field_list.hpp"
#include "http/response.hpp"

namespace fitgauge::http {

/// Bytes to send on a socket: text, then at most one long body that is sent in place. The text is
/// appended to a string that all connections of a thread share, since most of it is sent at once;
/// keep() copies the rest. Between two callbacks of the thread the shared string is empty.
class OutputQueue {
 public:
  static constexpr std::size_t kLongBody = std::size_t{64} << 10;

  explicit OutputQueue(std::string& shared) : shared_(shared) {}

  /// String for the next responses. @pre !has_long_body()
  std::string& text() { return shared_; }

  /// Adds a body after the text, kept alive by `owner`. @pre !has_long_body()
  void append_long(std::shared_ptr<const void> owner, std::string_view bytes) {
    owner_ = std::move(owner);
    long_body_ = bytes;
    owned_ = bytes.size();
  }

  bool has_long_body() const { return !long_body_.empty(); }
  std::size_t long_body_size() const { return long_body_.size(); }
  std::size_t text_size() const { return shared_.size(); }
  /// Bytes of memory that only this output holds: freed when everything is sent, or at discard().
  std::size_t held() const {
    return kept_.size() + later_.size() + (owner_.use_count() == 1 ? owned_ : 0);
  }
  bool empty() const { return kept_.empty() && shared_.empty() && !has_long_body(); }

  /// The next bytes to send.
  std::string_view front() const {
    if (!kept_.empty()) return std::string_view(kept_).substr(sent_);
    return shared_.empty() ? long_body_ : std::string_view(shared_).substr(sent_);
  }

  void consume(std::size_t count) {
    if (kept_.empty() && shared_.empty()) {
      long_body_.remove_prefix(count);
      if (long_body_.empty()) owner_.reset();
      return;
    }
    sent_ += count;
    if (sent_ < (kept_.empty() ? shared_ : kept_).size()) return;
    sent_ = 0;
    if (kept_.empty()) {
      clear_shared();
    } else {
      kept_ = std::exchange(later_, {});
    }
  }

  /// Copies the rest out of the shared string; front() then stays in place until consume().
  void keep() {
    if (shared_.empty()) return;
    if (kept_.empty()) {
      kept_ = shared_.substr(std::exchange(sent_, 0));
    } else {
      later_.append(shared_);
    }
    clear_shared();
  }

  /// Forgets everything.
  void discard() {
    clear_shared();
    kept_ = {};
    later_ = {};
    long_body_ = {};
    owner_.reset();
    sent_ = 0;
  }

 private:
  void clear_shared() {
    shared_.clear();
    if (shared_.capacity() > 4 * kLongBody) shared_.shrink_to_fit();
  }

  std::string& shared_;
  std::string kept_;      ///< before the shared text
  std::string later_;     ///< after kept_, which is being sent and must not move
  std::size_t sent_ = 0;  ///< of kept_, or of the shared text without it
  std::shared_ptr<const void> owner_;
  std::string_view long_body_;
  std::size_t owned_ = 0;  ///< bytes after owner_
};

/// A serialised head with the Date at a known place. It ends with the fields that differ between
/// the plain and the gzip form: ETag and Content-Length.
struct PreparedHead {
  std::string text;
  std::size_t date_offset = 0;
  std::size_t shared_size = 0;  ///< both forms are equal up to here
};

/// A serialised answer: whole for a plain request, and its head and 304 without the fields that
/// depend on the request: those of every answer, and Vary. Immutable and thread-safe.
class PreparedResponse {
 public:
  PreparedResponse(const Response& response, std::string packed);
  PreparedResponse& operator=(PreparedResponse&&) = delete;  // neither copied nor moved

  const int status;
  const bool is_packable;
  const bool is_long;  ///< the gzip form is worth its making
  const std::string etag;
  const std::string vary;
  PreparedHead head;
  PreparedHead not_modified;
  /// The whole answer to a plain request: see AnswerForm::is_plain().
  std::string plain;
  std::size_t id_offset = 0;  ///< of its X-Request-Id
  std::string_view body;      ///< the end of `plain`

  /// The body in gzip, made at the first call. @pre is_packable
  std::string_view packed_body() const;

 private:
  mutable std::once_flag packing_;
  mutable std::string packed_;
};

/// `Sun, 06 Nov 1994 08:49:37 GMT` (RFC 9110 section 5.6.7).
using HttpDate = std::array<char, 29>;

HttpDate format_http_date(Timestamp time);

inline std::string_view text(const HttpDate& date) { return {date.data(), date.size()}; }

/// The form of an answer, from its request.
struct AnswerForm {
  bool head_only = false;  ///< HEAD: no body
  bool http_1_0 = false;
  bool keep_alive = true;
  bool conditional = false;  ///< GET or HEAD with If-None-Match
  std::string if_none_match{};
  Codings codings{};
  std::string_view request_id{};
  std::string_view allowed_origin{};  ///< the request's origin, if its page may read the answer
  bool varies_by_origin = false;

  static constexpr std::size_t kOwnId = 16;  ///< characters of an id that the service gives
  /// Whether the answer's head depends on nothing of the request but an id of this length.
  bool is_plain() const {
    return keep_alive && !http_1_0 && !head_only && !varies_by_origin &&
           request_id.size() == kOwnId;
  }
};

struct SentAnswer {
  int status = 0;
  bool keep_alive = true;
  bool streams = false;  ///< the response's stream has to follow
  bool chunked = false;
  bool packed = false;  ///< the stream's pieces have to go through gzip
};

/// Appends the answer to `out`; a stream's body follows by itself.
SentAnswer append_answer(OutputQueue& out, Response& response, const AnswerForm& form,
                         const HttpDate& date);

/// Appends one chunk of a chunked body; an empty one is skipped, since it would end the body.
void append_chunk(std::string& out, std::string_view bytes);
inline constexpr std::string_view kLastChunk = "0\r\n\r\n";

/// Appends the status line and the Date.
/// @returns the offset of the Date's text in `out`.
std::size_t append_status(std::string& out, int status, const HttpDate& date);

/// Appends Content-Type and the other fields of the response except Vary.
void append_fields(std::string& out, const Response& response);
/// Appends only the fields that a 304 repeats (RFC 9110 section 15.4.5).
void append_not_modified_fields(std::string& out, const Response& response);

/// Value of Vary: the fields of the response, and Accept-Encoding if there is a gzip form.
std::string vary_of(const Response& response, bool has_packed_form);

/// Appends the ETag, unless it is empty.
void append_etag(std::string& out, std::string_view etag);
void append_content_length(std::string& out, std::size_t length);

/// A shorter body is sent as it is, since packing would gain nothing.
inline constexpr std::size_t kPackedFrom = 1024;

/// 1xx, 204 and 304 have neither a body nor a length.
constexpr bool may_have_body(int status) { return status >= 200 && status != 204 && status != 304; }

}  // namespace fitgauge::http
