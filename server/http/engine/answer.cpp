#include "http/engine/answer.hpp"

#include <fmt/chrono.h>
#include <boost/beast/http/status.hpp>

#include "base/gzip.hpp"

namespace fitgauge::http {
namespace {

constexpr std::string_view kRequestId = "X-Request-Id: ";
constexpr std::string_view kGzipCoded = "Content-Encoding: gzip\r\n";

/// As RFC 9110 has it: Beast has two phrases from before.
std::string_view reason(int status) {
  if (status == 413) return "Content Too Large";
  if (status == 422) return "Unprocessable Content";
  const auto known = boost::beast::http::int_to_status(static_cast<unsigned>(status));
  if (known == boost::beast::http::status::unknown) return {};
  const auto phrase = boost::beast::http::obsolete_reason(known);
  return {phrase.data(), phrase.size()};
}

/// Written for every response: parsing a format string would cost more than the number.
void append_number(std::string& out, std::size_t number) {
  const fmt::format_int digits(number);
  out.append(digits.data(), digits.size());
}

/// A line break in a value would begin another field: it becomes a blank.
void append_field(std::string& out, std::string_view name, std::string_view value) {
  out.append(name).append(": ");
  const std::size_t start = out.size();
  out.append(value);
  std::replace_if(
      out.begin() + static_cast<std::ptrdiff_t>(start), out.end(),
      [](char c) { return c == '\r' || c == '\n' || c == '\0'; }, ' ');
  out.append("\r\n");
}

/// Appends the fields that every answer has and its request decides, and ends the head.
void end_head(std::string& out, std::string_view vary, const AnswerForm& form) {
  out.append(kRequestId).append(form.request_id);
  out.append("\r\nX-Content-Type-Options: nosniff\r\nCross-Origin-Resource-Policy: ");
  if (form.allowed_origin.empty()) {
    out.append("same-origin\r\n");
  } else {
    out.append("cross-origin\r\nAccess-Control-Allow-Origin: ").append(form.allowed_origin);
    out.append(
        "\r\nAccess-Control-Expose-Headers: Location, Link, ETag, Retry-After, X-Request-Id, "
        "Idempotency-Replayed\r\n");
  }
  if (!vary.empty() || form.varies_by_origin) {
    const bool both = !vary.empty() && form.varies_by_origin;
    out.append("Vary: ").append(vary).append(both ? ", " : "");
    out.append(form.varies_by_origin ? "Origin\r\n" : "\r\n");
  }
  if (!form.keep_alive) {
    out.append("Connection: close\r\n");
  } else if (form.http_1_0) {
    out.append("Connection: keep-alive\r\n");
  }
  out.append("\r\n");
}

/// Whether to send gzip: a long body if preferred, a short one if the plain form is refused.
bool takes_packed(const Codings& codings, bool is_long) {
  return codings.gzip > 0 && (codings.identity == 0 || (is_long && codings.prefers_gzip()));
}

void append_body(OutputQueue& out, std::shared_ptr<const void> owner, std::string_view body) {
  if (body.size() > OutputQueue::kLongBody) {
    out.append_long(std::move(owner), body);
  } else {
    out.text().append(body);
  }
}

SentAnswer append_prepared(OutputQueue& out, const std::shared_ptr<const PreparedResponse>& answer,
                           const AnswerForm& form, const HttpDate& date) {
  std::string& text = out.text();
  const std::size_t start = text.size();
  const bool packed = answer->is_packable && takes_packed(form.codings, answer->is_long);
  const auto put = [&](std::string_view characters, std::size_t offset) {
    characters.copy(text.data() + start + offset, characters.size());
  };
  const auto append_head = [&](const PreparedHead& head) {
    text.append(head.text, 0, packed ? head.shared_size : head.text.size());
    put(http::text(date), head.date_offset);
    if (packed) append_etag(text, packed_etag(answer->etag));
  };
  if (form.conditional && answer->status == 200 && !answer->etag.empty() &&
      names_etag_weakly(form.if_none_match, answer->etag)) {
    append_head(answer->not_modified);
    end_head(text, answer->vary, form);
    return {.status = 304, .keep_alive = form.keep_alive};
  }
  if (!packed && form.is_plain() && answer->body.size() <= OutputQueue::kLongBody) {
    text.append(answer->plain);
    put(http::text(date), answer->head.date_offset);
    put(form.request_id, answer->id_offset);
    return {.status = answer->status};
  }
  append_head(answer->head);
  const std::string_view body = packed ? answer->packed_body() : answer->body;
  if (packed) {
    text.append(kGzipCoded);
    append_content_length(text, body.size());
  }
  end_head(text, answer->vary, form);
  if (!form.head_only) append_body(out, answer, body);
  return {.status = answer->status, .keep_alive = form.keep_alive};
}

/// A text in pieces, each of which is packed in a separate turn.
class TextStream final : public BodyStream {
 public:
  TextStream(std::shared_ptr<const std::string> owner, std::string_view text)
      : owner_(std::move(owner)), rest_(text) {}

  void next(ChunkSink sink) override {
    std::string piece(rest_.substr(0, OutputQueue::kLongBody));
    rest_.remove_prefix(piece.size());
    rest_.empty() ? sink.finish(std::move(piece)) : sink.put(std::move(piece));
  }

 private:
  std::shared_ptr<const std::string> owner_;
  std::string_view rest_;
};

/// Returns the body's bytes, with an owner if the body is large enough to be sent without a copy.
std::pair<std::shared_ptr<const std::string>, std::string_view> bytes_of(Body& body) {
  if (auto* shared = std::get_if<std::shared_ptr<const std::string>>(&body))
    return {*shared, *shared ? std::string_view(**shared) : std::string_view{}};
  auto& own = std::get<std::string>(body);
  if (own.size() <= OutputQueue::kLongBody) return {nullptr, own};
  auto kept = std::make_shared<const std::string>(std::move(own));
  body = kept;
  return {kept, *kept};
}

std::string_view body_of(const Response& response) {
  if (const auto* own = std::get_if<std::string>(&response.body)) return *own;
  if (const auto* shared = std::get_if<std::shared_ptr<const std::string>>(&response.body))
    return *shared ? std::string_view(**shared) : std::string_view{};
  throw std::logic_error("a streamed body cannot be prepared");
}

/// The body as gzip: long or streamed bodies are packed piece by piece.
void pack(Response& response, SentAnswer& sent) {
  response.with("Content-Encoding", "gzip");
  response.etag = packed_etag(response.etag);
  if (std::holds_alternative<StreamedBody>(response.body)) {
    sent.packed = true;
    return;
  }
  const auto [owner, body] = bytes_of(response.body);
  if (body.size() <= OutputQueue::kLongBody) {
    response.body = gzip(body);
    return;
  }
  sent.packed = true;
  constexpr long kOwn = 2;  // here and in the response
  const std::size_t held = owner.use_count() > kOwn ? 0 : body.size();
  response.body = StreamedBody{.source = std::make_shared<TextStream>(owner, body), .held = held};
}

/// Whether there is a gzip form. A short response has one only if nothing else is accepted.
struct PackedForm {
  bool exists = false;
  bool is_sent = false;
};

PackedForm packed_form(Response& response, const AnswerForm& form) {
  const auto is_coded = [](const Header& header) {
    return ascii_iequals(header.name, "Content-Encoding");
  };
  if (!may_have_body(response.status) || !is_packable(response.content_type)) return {};
  if (std::ranges::any_of(response.headers, is_coded)) return {.exists = true};
  const bool is_long = std::holds_alternative<StreamedBody>(response.body) ||
                       bytes_of(response.body).second.size() > kPackedFrom;
  const bool is_sent = takes_packed(form.codings, is_long);
  return {.exists = is_long || is_sent, .is_sent = is_sent};
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
  for (const Header& header : response.headers) {
    if (!ascii_iequals(header.name, "Vary")) append_field(out, header.name, header.value);
  }
}

void append_not_modified_fields(std::string& out, const Response& response) {
  for (const Header& header : response.headers) {
    for (const std::string_view kept : {"Cache-Control", "Content-Location", "Expires"}) {
      if (ascii_iequals(header.name, kept)) append_field(out, header.name, header.value);
    }
  }
}

std::string vary_of(const Response& response, bool has_packed_form) {
  std::string vary;
  for (const Header& header : response.headers) {
    if (!ascii_iequals(header.name, "Vary")) continue;
    vary.append(vary.empty() ? "" : ", ").append(header.value);
  }
  if (has_packed_form) vary.append(vary.empty() ? "" : ", ").append("Accept-Encoding");
  return vary;
}

void append_etag(std::string& out, std::string_view etag) {
  if (!etag.empty()) append_field(out, "ETag", etag);
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
  const PackedForm packed = packed_form(response, form);
  const std::string vary = vary_of(response, packed.exists);
  if (form.conditional && response.status == 200 && !response.etag.empty() &&
      names_etag_weakly(form.if_none_match, response.etag)) {
    sent.status = 304;
    append_status(text, 304, date);
    append_not_modified_fields(text, response);
    append_etag(text, packed.is_sent ? packed_etag(response.etag) : response.etag);
    end_head(text, vary, used);
    return sent;
  }
  if (packed.is_sent) pack(response, sent);
  append_status(text, response.status, date);
  append_fields(text, response);
  append_etag(text, response.etag);
  if (std::holds_alternative<StreamedBody>(response.body)) {
    // HTTP/1.0 knows no chunks: the body ends with the connection.
    sent.chunked = !form.http_1_0;
    sent.streams = !form.head_only;
    if (sent.chunked) {
      text.append("Transfer-Encoding: chunked\r\n");
    } else {
      sent.keep_alive = used.keep_alive = false;
    }
    end_head(text, vary, used);
    return sent;
  }
  const auto [owner, body] = bytes_of(response.body);
  if (may_have_body(response.status)) append_content_length(text, body.size());
  end_head(text, vary, used);
  if (!form.head_only && may_have_body(response.status)) append_body(out, owner, body);
  return sent;
}

PreparedResponse::PreparedResponse(const Response& response, std::string packed)
    : status(response.status),
      is_packable(!packed.empty() || http::is_packable(response.content_type)),
      is_long(is_packable && body_of(response).size() > kPackedFrom),
      etag(response.etag),
      vary(vary_of(response, is_long)),
      packed_(std::move(packed)) {
  const HttpDate placeholder = format_http_date({});
  if (may_have_body(status)) body = body_of(response);
  head.date_offset = append_status(head.text, status, placeholder);
  append_fields(head.text, response);
  head.shared_size = head.text.size();
  append_etag(head.text, etag);
  if (may_have_body(status)) append_content_length(head.text, body.size());
  plain = head.text;
  id_offset = plain.size() + kRequestId.size();
  end_head(plain, vary, {.request_id = std::string_view(placeholder.data(), AnswerForm::kOwnId)});
  plain += body;
  body = std::string_view(plain).substr(plain.size() - body.size());
  if (status != 200 || etag.empty()) return;
  not_modified.date_offset = append_status(not_modified.text, 304, placeholder);
  append_not_modified_fields(not_modified.text, response);
  not_modified.shared_size = not_modified.text.size();
  append_etag(not_modified.text, etag);
}

std::string_view PreparedResponse::packed_body() const {
  std::call_once(packing_, [this] {
    if (packed_.empty()) packed_ = gzip(body);
  });
  return packed_;
}

std::size_t size_in_memory(const PreparedResponse& answer) {
  const std::size_t packed = answer.is_long ? answer.body.size() : 0;  // at most
  return sizeof answer + answer.head.text.size() + answer.plain.size() + packed +
         answer.not_modified.text.size();
}

std::shared_ptr<const PreparedResponse> prepare(const Response& response, std::string packed) {
  if (response.prepared) return response.prepared;
  return std::make_shared<const PreparedResponse>(response, std::move(packed));
}

HttpDate format_http_date(Timestamp time) {
  const std::time_t second =
      std::chrono::floor<std::chrono::seconds>(std::chrono::nanoseconds(time.nanoseconds)).count();
  HttpDate date{};
  fmt::format_to_n(date.data(), date.size(), "{:%a, %d %b %Y %H:%M:%S} GMT", fmt::gmtime(second));
  return date;
}

}  // namespace fitgauge::http
