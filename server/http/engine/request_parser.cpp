#include "http/engine/request_parser.hpp"

#include <boost/asio/buffer.hpp>
#include <boost/beast/http/error.hpp>

namespace fitgauge::http {

namespace beast = boost::beast;

namespace {

constexpr std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

/// Only blanks are between the colon and the value, unless the value was folded over lines (or,
/// joined by the parser, is outside the input).
bool is_folded(std::string_view name, std::string_view value) {
  const char* const after_colon = name.data() + name.size() + 1;
  const auto gap = value.data() - after_colon;
  if (gap < 0 || static_cast<std::size_t>(gap) > kMaxHeaderSection) return true;
  for (const char* p = after_colon; p != value.data(); ++p) {
    if (*p != ' ' && *p != '\t') return true;
  }
  return false;
}

bool is_digits(std::string_view text) {
  for (const char c : text) {
    if (c < '0' || c > '9') return false;
  }
  return !text.empty();
}

/// Returns whether a proxy names its client in this field, which Beast's list of fields lacks.
bool is_of_proxy(std::string_view name) {
  constexpr std::string_view kPrefix = "X-Forwarded-";
  return ascii_iequals(name.substr(0, kPrefix.size()), kPrefix) ||
         ascii_iequals(name, "X-Real-IP") || ascii_iequals(name, "True-Client-IP") ||
         ascii_iequals(name, "CF-Connecting-IP");
}

/// Finds a bare LF in lines that were not yet read; the parser would wait for their CR.
bool has_bare_line_feed(std::string_view lines) {
  for (std::size_t at = lines.find('\n'); at != std::string_view::npos;
       at = lines.find('\n', at + 1)) {
    if (at == 0 || lines[at - 1] != '\r') return true;
  }
  return false;
}

/// Whether the chunk line at the front of `lines`, perhaps after the end of the previous chunk,
/// begins with a size of more than 64 bits.
bool has_endless_size(std::string_view lines) {
  constexpr std::string_view kHexDigits = "0123456789abcdefABCDEF";
  if (lines.starts_with("\r\n")) lines.remove_prefix(2);
  lines.remove_prefix(std::min(lines.find_first_not_of('0'), lines.size()));
  const std::size_t digits = std::min(lines.find_first_not_of(kHexDigits), lines.size());
  const std::string_view rest = lines.substr(digits);
  return digits > 16 && (rest.starts_with("\r\n") || rest.starts_with(';'));
}

/// Whether the field at the front of `lines` is a number. The parser refuses such a Content-Length
/// only if it has more than 64 bits.
bool is_number(std::string_view lines) {
  const std::string_view line = lines.substr(0, lines.find("\r\n"));
  return is_digits(trim(line.substr(line.find(':') + 1)));
}

const char* describe(const beast::error_code& code) {
  using beast::http::error;
  switch (static_cast<error>(code.value())) {
    case error::bad_method: return "the request line must begin with a method";
    case error::bad_target:
      return "the request target is missing, or has a character that must be percent-encoded";
    case error::bad_field: return "a header field name is malformed";
    case error::bad_value: return "a header field value is malformed; lines must end with CR LF";
    case error::bad_line_ending: return "lines of the request must end with CR LF";
    case error::bad_content_length:
    case error::multiple_content_length:
      return "Content-Length is malformed, repeated or together with Transfer-Encoding";
    case error::bad_transfer_encoding:
      return "Transfer-Encoding is repeated or together with Content-Length";
    case error::bad_chunk:
    case error::bad_chunk_extension: return "the chunked body is malformed";
    default: return "the request is malformed";
  }
}

}  // namespace

RequestParser::RequestParser(RequestHead& head) : head_(head) {
  header_limit(2 * (kMaxTarget + kMaxHeaderSection));  // ours are checked before
  body_limit(boost::none);
}

RequestParser::Step RequestParser::put(std::string_view input, std::size_t& used) {
  try {
    return parse(input, used);
  } catch (const std::exception&) {  // Beast's containers throw std::length_error
    return refuse(
        431, ErrorCode::HeaderTooLarge,
        "header section must have at most 32 KiB and 100 fields; send fewer or shorter fields");
  }
}

RequestParser::Step RequestParser::parse(std::string_view input, std::size_t& used) {
  piece_ = {};
  const bool had_line = !head_.method.empty();
  const bool had_head = head_done_;
  beast::error_code error;
  const std::size_t n = basic_parser::put({input.data(), input.size()}, error);
  used += n;
  if (refused_) return Step::Refused;

  if (had_head) {
    framing_run_ = piece_.empty() ? framing_run_ + n : 0;
  } else if (!head_.method.empty()) {
    const auto line_end = static_cast<std::size_t>(head_.target.end() - input.data());
    head_bytes_ += had_line ? n : n - std::min(n, line_end);
  }
  if (error) return take_error(error, input.substr(n));

  if (!had_head) return check_head() ? Step::Head : Step::Refused;
  if (framing_run_ > kMaxFraming) return need_more({});
  return is_done() ? Step::Complete : Step::BodyPiece;
}

RequestParser::Step RequestParser::take_error(const beast::error_code& error,
                                              std::string_view pending) {
  if (error == beast::http::error::need_more) return need_more(pending);
  // Beast takes a line that ends with LF alone for another version.
  const std::string_view line = pending.substr(0, pending.find('\n'));
  if (error == beast::http::error::bad_version &&
      (line.ends_with("HTTP/1.1") || line.ends_with("HTTP/1.0"))) {
    return refuse(400, ErrorCode::RequestMalformed, describe(beast::http::error::bad_line_ending));
  }
  if (error == beast::http::error::bad_version)
    return refuse(400, ErrorCode::VersionUnsupported, "HTTP version must be 1.0 or 1.1");
  if (error == beast::http::error::header_limit) return refuse_long_header();
  if (error == beast::http::error::bad_chunk && has_endless_size(pending)) return refuse_body();
  const bool is_first = !has_content_length_ && !has_transfer_encoding_;
  if (error == beast::http::error::bad_content_length && is_first && is_number(pending))
    return refuse_body();
  return refuse(400, ErrorCode::RequestMalformed, describe(error));
}

RequestParser::Step RequestParser::need_more(std::string_view pending) {
  if (head_done_) {
    if (framing_run_ + pending.size() > kMaxFraming) {
      return refuse(400, ErrorCode::RequestMalformed,
                    "chunk framing or trailer of 16 KiB contains no byte of the body");
    }
    if (has_bare_line_feed(pending))
      return refuse(400, ErrorCode::RequestMalformed, "lines of the request must end with CR LF");
  } else if (head_.method.empty()) {
    if (pending.size() > kMaxTarget + 64)
      return refuse(414, ErrorCode::TargetTooLong, "request target must have at most 8 KiB");
  } else if (head_bytes_ + pending.size() > kMaxHeaderSection) {
    return refuse_long_header();
  }
  return Step::NeedMore;
}

void RequestParser::on_chunk_header_impl(std::uint64_t size, beast::string_view,
                                         ErrorCodeOut& error) {
  if (size > body_left_) {
    refuse_body();
    error = beast::http::error::body_limit;
  } else {
    body_left_ -= size;
  }
}

void RequestParser::on_request_impl(beast::http::verb, beast::string_view method,
                                    beast::string_view target, int version, ErrorCodeOut& error) {
  if (target.size() > kMaxTarget) {
    refuse(414, ErrorCode::TargetTooLong, "request target must have at most 8 KiB");
    error = beast::http::error::bad_target;
    return;
  }
  head_.method = view(method);
  head_.target = view(target);
  head_.http_1_0 = version < 11;
}

void RequestParser::on_field_impl(beast::http::field field, beast::string_view name_in,
                                  beast::string_view value_in, ErrorCodeOut& error) {
  const std::string_view name = view(name_in);
  const std::string_view value = view(value_in);
  const auto once = [&](bool& seen) {
    if (seen)
      refuse(400, ErrorCode::RequestMalformed, "a header field that may come once is repeated");
    seen = true;
  };
  if (is_folded(name, value)) {
    refuse(400, ErrorCode::RequestMalformed, "a header field must be on one line");
  } else if (!head_done_) {  // trailer fields are read and thrown away
    if (head_.fields.size() == kMaxFields)
      refuse(431, ErrorCode::HeaderTooLarge, "header section must have at most 100 fields");
    switch (field) {
      case beast::http::field::host:
        once(has_host_);
        head_.host = value;
        break;
      case beast::http::field::transfer_encoding:
        once(has_transfer_encoding_);
        head_.chunked = ascii_iequals(value, "chunked");
        break;
      case beast::http::field::content_length:
        once(has_content_length_);
        if (!is_digits(value))
          refuse(400, ErrorCode::RequestMalformed, "Content-Length must be a number");
        break;
      case beast::http::field::content_type: once(has_content_type_); break;
      case beast::http::field::accept: head_.has_accept = true; break;
      case beast::http::field::expect: head_.has_expect = true; break;
      case beast::http::field::if_none_match: head_.has_if_none_match = true; break;
      case beast::http::field::accept_encoding: head_.has_accept_encoding = true; break;
      case beast::http::field::origin: head_.has_origin = true; break;
      case beast::http::field::forwarded:
      case beast::http::field::via: head_.is_forwarded = true; break;
      case beast::http::field::unknown:
        head_.is_forwarded |= is_of_proxy(name);
        head_.has_request_id |= ascii_iequals(name, "X-Request-Id");
        break;
      default: break;
    }
    head_.fields.push_back({name, value});
  }
  if (refused_) error = beast::http::error::bad_field;
}

bool RequestParser::check_head() {
  const auto fail = [&](const char* message) {
    refuse(400, ErrorCode::RequestMalformed, message);
    return false;
  };
  if (head_bytes_ >
      kMaxHeaderSection + 16) {  // the count begins at the version of the request line
    refuse_long_header();
    return false;
  }
  if (has_transfer_encoding_) {
    if (head_.http_1_0) return fail("Transfer-Encoding needs HTTP/1.1");
    if (has_content_length_) return fail("Transfer-Encoding and Content-Length exclude each other");
    if (!head_.chunked) return fail("Transfer-Encoding must be chunked");
  }
  if (!has_host_ && !head_.http_1_0) return fail("the Host field is required");
  if (has_host_ && !is_authority(head_.host))
    return fail("the Host field must be a host, with a port if needed");
  if (has_content_length_) head_.content_length = *content_length();
  head_.keep_alive = keep_alive();
  return true;
}

}  // namespace fitgauge::http
