#pragma once

#include <array>
#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>

#include "base/clock.hpp"
#include "http/response.hpp"

namespace fitgauge::http {

/// A serialised head with the Date at a known place. It ends with the fields that differ between
/// the plain and the gzip form: ETag and Content-Length.
struct PreparedHead {
  std::string text;
  std::size_t date_offset = 0;
  std::size_t shared_size = 0;  ///< up to here both forms are alike
};

/// A serialised answer and its 304; without the fields that depend on the request: those that every
/// answer has, and Vary. Immutable and thread-safe.
class PreparedResponse {
 public:
  PreparedResponse(const Response& response, std::string packed);
  PreparedResponse(const PreparedResponse&) = delete;
  PreparedResponse& operator=(const PreparedResponse&) = delete;

  int status() const { return status_; }
  std::string_view etag() const { return etag_; }
  std::string_view vary() const { return vary_; }
  const PreparedHead& head() const { return head_; }
  const PreparedHead& not_modified_head() const { return not_modified_; }
  std::string_view body() const { return body_; }

  bool is_packable() const { return is_packable_; }
  /// Whether the gzip form is worth its making.
  bool is_long() const { return is_long_; }
  /// The body in gzip, made at the first call. @pre is_packable()
  std::string_view packed_body() const;

 private:
  int status_;
  bool is_packable_;
  bool is_long_;
  std::string etag_;
  std::string vary_;
  std::string body_;
  PreparedHead head_;
  PreparedHead not_modified_;
  mutable std::once_flag packing_;
  mutable std::string packed_;
};

/// `Sun, 06 Nov 1994 08:49:37 GMT` (RFC 9110 section 5.6.7).
using HttpDate = std::array<char, 29>;

HttpDate format_http_date(Timestamp time);

inline std::string_view text(const HttpDate& date) { return {date.data(), date.size()}; }

}  // namespace fitgauge::http
