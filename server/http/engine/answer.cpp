#include "http/engine/answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <utility>
#include <variant>

#include "base/text.hpp"
#include "http/body_stream.hpp"
#include "http/engine/prepared_response.hpp"
#include "http/field_list.hpp"

namespace fitgauge::http {

namespace {

std::string_view reason(int status) {
  constexpr std::array<std::pair<int, std::string_view>, 23> kReasons{{
      {200, "OK"},
      {201, "Created"},
      {202, "Accepted"},
      {204, "No Content"},
      {304, "Not Modified"},
      {400, "Bad Request"},
      {401, "Unauthorized"},
      {403, "Forbidden"},
      {404, "Not Found"},
      {405, "Method Not Allowed"},
      {406, "Not Acceptable"},
      {408, "Request Timeout"},
      {409, "Conflict"},
      {411, "Length Required"},
      {412, "Precondition Failed"},
      {413, "Content Too Large"},
      {414, "URI Too Long"},
      {415, "Unsupported Media Type"},
      {417, "Expectation Failed"},
      {422, "Unprocessable Content"},
      {431, "Request Header Fields Too Large"},
      {500, "Internal Server Error"},
      {503, "Service Unavailable"},
  }};
  const auto found = std::find_if(kReasons.begin(), kReasons.end(),
                                  [&](const auto& entry) { return entry.first == status; });
  return found == kReasons.end() ? std::string_view{} : found->second;
}

/// Written for every answer, where a format string to read costs more than the number.
void append_number(std::string& out, std::size_t number) {
  const fmt::format_int digits(number);
  out.append(digits.data(), digits.size());
}

/// A line break inside a value would begin a field of its own: it becomes a blank.
void append_field(std::string& out, std::string_view name, std::string_view value) {
  out.append(name).append(": ");
  const std::size_t start = out.size();
  out.append(value);
  std::replace_if(
      out.begin() + static_cast<std::ptrdiff_t>(start), out.end(),
      [](char c) { return c == '\r' || c == '\n' || c == '\0'; }, ' ');
  out.append("\r\n");
}

void append_connection(std::string& out, const AnswerForm& form) {
  if (!form.keep_alive) {
    out.append("Connection: close\r\n");
  } else if (form.http_1_0) {
    out.append("Connection: keep-alive\r\n");
  }
}

SentAnswer append_prepared(OutputQueue& out, const std::shared_ptr<const PreparedResponse>& answer,
                           const AnswerForm& form, const HttpDate& date) {
  std::string& text = out.text();
  const std::size_t start = text.size();
  const auto put_date = [&](std::size_t offset) {
    std::copy(date.begin(), date.end(), text.begin() + static_cast<std::ptrdiff_t>(start + offset));
  };
  if (form.conditional && !answer->etag().empty() &&
      names_etag_weakly(form.if_none_match, answer->etag())) {
    text.append(answer->not_modified_head());
    put_date(answer->not_modified_date_offset());
    append_connection(text, form);
    text.append("\r\n");
    return {.status = 304, .keep_alive = form.keep_alive};
  }
  const bool is_long = answer->body().size() > OutputQueue::kLongBody;
  if (form.keep_alive && !form.http_1_0 && !form.head_only && !is_long) {
    text.append(answer->bytes());
  } else {
    text.append(answer->head());
    append_connection(text, form);
    text.append("\r\n");
    if (!form.head_only && is_long) out.append_long(answer, answer->body());
    if (!form.head_only && !is_long) text.append(answer->body());
  }
  put_date(answer->date_offset());
  return {.status = answer->status(), .keep_alive = form.keep_alive};
}

/// The body's bytes, with an owner for those that are sent from where they lie.
std::pair<std::shared_ptr<const std::string>, std::string_view> bytes_of(Body& body) {
  if (auto* shared = std::get_if<std::shared_ptr<const std::string>>(&body)) {
    return {*shared, *shared ? std::string_view(**shared) : std::string_view{}};
  }
  auto& own = std::get<std::string>(body);
  if (own.size() <= OutputQueue::kLongBody) return {nullptr, own};
  auto kept = std::make_shared<const std::string>(std::move(own));
  return {kept, *kept};
}

}  // namespace

std::size_t append_status(std::string& out, int status, const HttpDate& date) {
  out.append("HTTP/1.1 ");
  append_number(out, static_cast<std::size_t>(status));
  out.append(" ").append(reason(status)).append("\r\nDate: ");
  const std::size_t offset = out.size();
  out.append(text(date)).append("\r\n");
  return offset;
}

void append_fields(std::string& out, const Response& response) {
  if (!response.content_type.empty()) append_field(out, "Content-Type", response.content_type);
  if (!response.etag.empty()) append_field(out, "ETag", response.etag);
  for (const Header& header : response.headers) append_field(out, header.name, header.value);
}

void append_not_modified_fields(std::string& out, const Response& response) {
  append_field(out, "ETag", response.etag);
  for (const Header& header : response.headers) {
    for (const std::string_view kept : {"Cache-Control", "Content-Location", "Expires", "Vary"}) {
      if (ascii_iequals(header.name, kept)) append_field(out, header.name, header.value);
    }
  }
}

void append_content_length(std::string& out, std::size_t length) {
  out.append("Content-Length: ");
  append_number(out, length);
  out.append("\r\n");
}

void append_chunk(std::string& out, std::string_view bytes) {
  if (bytes.empty()) return;
  fmt::format_to(std::back_inserter(out), "{:x}\r\n", bytes.size());
  out.append(bytes).append("\r\n");
}

SentAnswer append_answer(OutputQueue& out, Response& response, const AnswerForm& form,
                         const HttpDate& date) {
  if (response.prepared) return append_prepared(out, response.prepared, form, date);

  SentAnswer sent{.status = response.status, .keep_alive = form.keep_alive};
  AnswerForm used = form;
  std::string& text = out.text();
  if (form.conditional && response.status == 200 && !response.etag.empty() &&
      names_etag_weakly(form.if_none_match, response.etag)) {
    sent.status = 304;
    append_status(text, 304, date);
    append_not_modified_fields(text, response);
    append_connection(text, used);
    text.append("\r\n");
    return sent;
  }
  append_status(text, response.status, date);
  append_fields(text, response);
  if (std::holds_alternative<StreamedBody>(response.body)) {
    // HTTP/1.0 knows no chunks: the body ends with the connection.
    sent.chunked = !form.http_1_0;
    sent.streams = !form.head_only;
    if (sent.chunked) {
      text.append("Transfer-Encoding: chunked\r\n");
    } else {
      sent.keep_alive = used.keep_alive = false;
    }
    append_connection(text, used);
    text.append("\r\n");
    return sent;
  }
  const auto [owner, body] = bytes_of(response.body);
  if (may_have_body(response.status)) append_content_length(text, body.size());
  append_connection(text, used);
  text.append("\r\n");
  if (form.head_only || !may_have_body(response.status)) return sent;
  if (owner && body.size() > OutputQueue::kLongBody) {
    out.append_long(owner, body);
  } else {
    text.append(body);
  }
  return sent;
}

}  // namespace fitgauge::http
