#include "http/engine/answer.hpp"

#include <fmt/format.h>

#include <memory>
#include <stdexcept>
#include <utility>
#include <variant>

#include "base/gzip.hpp"
#include "http/field_list.hpp"
#include "http/response.hpp"

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

PreparedResponse::PreparedResponse(const Response& response, std::string packed)
    : status_(response.status),
      is_packable_(!packed.empty() || http::is_packable(response.content_type)),
      is_long_(is_packable_ && body_of(response).size() > kPackedFrom),
      etag_(response.etag),
      vary_(vary_of(response, is_long_)),
      body_(may_have_body(status_) ? body_of(response) : std::string_view{}),
      packed_(std::move(packed)) {
  const HttpDate placeholder = format_http_date({});
  head_.date_offset = append_status(head_.text, status_, placeholder);
  append_fields(head_.text, response);
  head_.shared_size = head_.text.size();
  append_etag(head_.text, etag_);
  if (may_have_body(status_)) append_content_length(head_.text, body_.size());
  if (status_ != 200 || etag_.empty()) return;
  not_modified_.date_offset = append_status(not_modified_.text, 304, placeholder);
  append_not_modified_fields(not_modified_.text, response);
  not_modified_.shared_size = not_modified_.text.size();
  append_etag(not_modified_.text, etag_);
}

std::string_view PreparedResponse::packed_body() const {
  std::call_once(packing_, [this] {
    if (packed_.empty()) packed_ = gzip(body_);
  });
  return packed_;
}

std::size_t size_in_memory(const PreparedResponse& answer) {
  const std::size_t packed = answer.is_long() ? answer.body().size() : 0;  // at most
  return sizeof answer + answer.head().text.size() + answer.body().size() + packed +
         answer.not_modified_head().text.size();
}

std::shared_ptr<const PreparedResponse> prepare(const Response& response, std::string packed) {
  if (response.prepared) return response.prepared;
  return std::make_shared<const PreparedResponse>(response, std::move(packed));
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
