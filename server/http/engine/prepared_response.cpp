#include "http/engine/prepared_response.hpp"

#include <fmt/format.h>

#include <memory>
#include <stdexcept>
#include <variant>

#include "http/body_stream.hpp"
#include "http/engine/answer.hpp"

namespace fitgauge::http {
namespace {

std::string_view body_of(const Response& response) {
  if (const auto* own = std::get_if<std::string>(&response.body)) return *own;
  if (const auto* shared = std::get_if<std::shared_ptr<const std::string>>(&response.body)) {
    return *shared ? std::string_view(**shared) : std::string_view{};
  }
  throw std::logic_error("a streamed body cannot be prepared");
}

}  // namespace

PreparedResponse::PreparedResponse(const Response& response)
    : status_(response.status), etag_(response.status == 200 ? response.etag : "") {
  const HttpDate placeholder = format_http_date({});
  const std::string_view body = body_of(response);
  date_offset_ = append_status(bytes_, status_, placeholder);
  append_fields(bytes_, response);
  if (may_have_body(status_)) append_content_length(bytes_, body.size());
  head_size_ = bytes_.size();
  bytes_.append("\r\n");
  if (may_have_body(status_)) bytes_.append(body);
  if (!etag_.empty()) {
    not_modified_date_offset_ = append_status(not_modified_head_, 304, placeholder);
    append_not_modified_fields(not_modified_head_, response);
  }
}

std::size_t size_in_memory(const PreparedResponse& answer) {
  return sizeof answer + answer.bytes().size() + answer.not_modified_head().size();
}

std::shared_ptr<const PreparedResponse> prepare(const Response& response) {
  if (response.prepared) return response.prepared;
  return std::make_shared<const PreparedResponse>(response);
}

HttpDate format_http_date(Timestamp time) {
  constexpr std::array<std::string_view, 7> kDays{"Sun", "Mon", "Tue", "Wed", "Thu", "Fri", "Sat"};
  constexpr std::array<std::string_view, 12> kMonths{"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                                     "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
  const CivilTime at = civil_time(time);
  HttpDate date{};
  fmt::format_to_n(date.data(), date.size(), "{}, {:02} {} {:04} {:02}:{:02}:{:02} GMT",
                   kDays[static_cast<std::size_t>(at.weekday)], at.day,
                   kMonths[static_cast<std::size_t>(at.month - 1)], at.year, at.hour, at.minute,
                   at.second);
  return date;
}

}  // namespace fitgauge::http
