#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "http/engine/media_type.hpp"
#include "http/engine/output_queue.hpp"
#include "http/engine/prepared_response.hpp"
#include "http/response.hpp"

namespace fitgauge::http {

/// What the request decides about the form of its answer.
struct AnswerForm {
  bool head_only = false;  ///< HEAD: no body
  bool http_1_0 = false;
  bool keep_alive = true;
  bool conditional = false;  ///< GET or HEAD with If-None-Match
  std::string if_none_match{};
  Codings codings{};
  std::string_view request_id{};
  std::string_view allowed_origin{};  ///< the request's own, if its page may read the answer
  bool varies_by_origin = false;
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

/// Appends Content-Type and the response's own fields but Vary.
void append_fields(std::string& out, const Response& response);
/// The same, of those that a 304 repeats (RFC 9110 section 15.4.5).
void append_not_modified_fields(std::string& out, const Response& response);

/// The value of Vary: what the response names, and Accept-Encoding if there is a gzip form.
std::string vary_of(const Response& response, bool has_packed_form);

/// Appends the ETag, unless it is empty.
void append_etag(std::string& out, std::string_view etag);
void append_content_length(std::string& out, std::size_t length);

/// A shorter body is sent as it is, since packing would gain nothing.
inline constexpr std::size_t kPackedFrom = 1024;

/// 1xx, 204 and 304 have neither a body nor a length.
constexpr bool may_have_body(int status) { return status >= 200 && status != 204 && status != 304; }

}  // namespace fitgauge::http
