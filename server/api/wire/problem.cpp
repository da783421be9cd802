#include "api/services.hpp"

#include "base/json/json_writer.hpp"

namespace fitgauge::api {
namespace {

/// A field's place is its JSON pointer; formats with lines add the line.
void write_detail(JsonWriter& json, const Error& detail) {
  json.begin_object().member("pointer", std::string_view(detail.where));
  if (!detail.details.empty()) json.key("line").raw(detail.details.front().where);
  json.member("code", id(detail.code)).member("detail", std::string_view(detail.message));
  json.end_object();
}

void add_headers(const Error& error, int status, Response& response) {
  if (status == 401) response.with("WWW-Authenticate", "Bearer realm=\"fitgauge\"");
  if (status == 503 && error.code != ErrorCode::TablesInconsistent)
    response.with("Retry-After", "1");
}

}  // namespace

int status_of(ErrorCode code) {
  static constexpr int kStatus[] = {
#define FITGAUGE_ERROR(name, id, title, status) status,
#include "base/error_codes.inc"
#undef FITGAUGE_ERROR
  };
  return kStatus[static_cast<std::size_t>(code)];
}

Response problem(const Error& error, std::optional<int> given, const Request& request) {
  const int status = given.value_or(status_of(error.code));
  std::string body = json_object([&](JsonWriter& json) {
    json.member("type", "urn:fitgauge:problem:" + std::string(id(error.code)));
    json.member("title", title(error.code)).member("status", status);
    json.member("detail", error.message);
    json.member("instance", "urn:fitgauge:request:" + std::string(request.id_text()));
    json.member("code", id(error.code));
    if (!error.where.empty()) json.member("where", error.where);
    if (error.details.empty()) return;
    json.list("errors", error.details, [&](const Error& detail) { write_detail(json, detail); });
  });
  Response response(status, "application/problem+json", std::move(body));
  add_headers(error, status, response);
  return response;
}

}  // namespace fitgauge::api
