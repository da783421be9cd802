#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "base/clock.hpp"
#include "http/response.hpp"

namespace fitgauge::http {

/// A serialised answer and its 304, each with the Date at a known place. Immutable.
class PreparedResponse {
 public:
  explicit PreparedResponse(const Response& response);

  int status() const { return status_; }
  std::string_view etag() const { return etag_; }

  /// The whole answer as a connection that stays open gets it.
  std::string_view bytes() const { return bytes_; }
  std::size_t date_offset() const { return date_offset_; }
  /// Status line and fields, without Connection and the empty line.
  std::string_view head() const { return bytes().substr(0, head_size_); }
  std::string_view body() const { return bytes().substr(head_size_ + 2); }

  /// The head of the 304, in the same form.
  std::string_view not_modified_head() const { return not_modified_head_; }
  std::size_t not_modified_date_offset() const { return not_modified_date_offset_; }

 private:
  int status_;
  std::string etag_;
  std::string bytes_;
  std::size_t date_offset_ = 0;
  std::size_t head_size_ = 0;
  std::string not_modified_head_;
  std::size_t not_modified_date_offset_ = 0;
};

/// `Sun, 06 Nov 1994 08:49:37 GMT` (RFC 9110 section 5.6.7).
using HttpDate = std::array<char, 29>;

HttpDate format_http_date(Timestamp time);

inline std::string_view text(const HttpDate& date) { return {date.data(), date.size()}; }

}  // namespace fitgauge::http
