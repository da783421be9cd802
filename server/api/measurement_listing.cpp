#include "api/measurement_listing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "api/measurement_codec.hpp"
#include "http/body_stream.hpp"

namespace fitgauge::api {
namespace {

constexpr std::int64_t kDefaultLimit = 100;
constexpr std::size_t kRowsAPiece = 200;

enum class Form { Json, Ndjson, Csv };

Form form_of(const http::Request& request) {
  if (request.response_type() == "text/csv") return Form::Csv;
  if (request.response_type() == "application/x-ndjson") return Form::Ndjson;
  return Form::Json;
}

std::string media_type(Form form) {
  switch (form) {
    case Form::Csv: return "text/csv; charset=utf-8; header=present";
    case Form::Ndjson: return "application/x-ndjson";
    case Form::Json: break;
  }
  return "application/json";
}

void append_row(std::string& out, Form form, const app::Measurement& measurement) {
  if (form == Form::Csv) return append_measurement_csv(out, measurement);
  JsonWriter json(out);
  write_measurement(json, measurement);
  if (form == Form::Ndjson) out += '\n';
}

/// All measurements that match, read page by page while they are sent.
class MeasurementStream final : public http::BodyStream,
                                public std::enable_shared_from_this<MeasurementStream> {
 public:
  MeasurementStream(app::MeasurementService& measurements, app::MeasurementQuery query,
                    std::int64_t after, Form form)
      : measurements_(measurements), query_(std::move(query)), after_(after), form_(form) {}

  void next(http::ChunkSink sink) override {
    auto piece = std::make_shared<std::string>();
    if (form_ == Form::Csv && !begun_) *piece = measurement_csv_header();
    begun_ = true;
    measurements_.list(
        query_, after_, kRowsAPiece,
        [piece, form = form_](const app::Measurement& measurement) {
          append_row(*piece, form, measurement);
        },
        [self = shared_from_this(), piece,
         sink = std::make_shared<http::ChunkSink>(std::move(sink))](
            Result<std::optional<std::int64_t>> next) {
          if (!next) return sink->fail();
          if (!*next) return sink->finish(std::move(*piece));
          self->after_ = **next;
          sink->put(std::move(*piece));
        });
  }

 private:
  app::MeasurementService& measurements_;
  app::MeasurementQuery query_;
  std::int64_t after_;
  Form form_;
  bool begun_ = false;
};

/// The link to the next page keeps the filters and replaces the cursor.
std::string next_link(const http::Request& request, std::string_view cursor) {
  std::string link(request.path());
  char separator = '?';
  std::string_view rest = request.query();
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('&'), rest.size());
    const std::string_view pair = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (pair.empty() || pair.starts_with("after=")) continue;
    link += separator;
    link += pair;
    separator = '&';
  }
  return fmt::format("<{}{}after={}>; rel=\"next\"", link, separator, cursor);
}

/// Cursors are measurement ids.
Result<std::int64_t> cursor_of(const http::Request& request) {
  const auto after = request.text("after");
  if (!after) return std::int64_t{0};
  const auto id = app::parse_measurement_id(*after);
  if (id) return *id;
  return Error{ErrorCode::CursorInvalid, "after takes the cursor of a page before, its `next`"};
}

void answer_page(const http::Request& request, http::Responder& responder, Form form,
                 std::string rows, std::optional<std::int64_t> next) {
  std::string body;
  const std::string cursor = next ? app::measurement_id_text(*next) : std::string();
  if (form == Form::Json) {
    JsonWriter json(body);
    json.begin_object().key("measurements").raw("[" + rows + "]").key("next");
    if (next) {
      json.value(cursor);
    } else {
      json.null();
    }
    json.end_object();
  } else {
    body = (form == Form::Csv ? measurement_csv_header() : std::string()) + rows;
  }
  http::Response response(200, media_type(form), std::move(body));
  response.with("Vary", "Accept");
  if (next) response.with("Link", next_link(request, cursor));
  responder.answer(std::move(response));
}

}  // namespace

std::vector<http::Parameter> measurement_filter_parameters() {
  return {
      {.name = "part_id", .description = "Exactly this part"},
      {.name = "characteristic", .description = "Exactly this characteristic"},
      {.name = "order", .description = "Exactly this order"},
      {.name = "machine", .description = "Exactly this machine"},
      {.name = "verdict",
       .type = http::Words{{"good", "rework", "reject", "indeterminate"}},
       .description = "Only this verdict"},
      {.name = "source",
       .type = http::Words{{"gauge", "simulation", "all"}},
       .description = "gauge when absent"},
      {.name = "from", .type = http::Time{}, .description = "measured_at from then on"},
      {.name = "to", .type = http::Time{}, .description = "measured_at before then"},
      {.name = "history",
       .type = http::Words{{"current", "all"}},
       .description = "all shows corrected rows too"},
  };
}

app::MeasurementQuery measurement_query(const http::Request& request) {
  const auto text = [&](std::string_view name) -> std::optional<std::string> {
    const auto value = request.text(name);
    return value ? std::optional<std::string>(*value) : std::nullopt;
  };
  app::MeasurementQuery query;
  query.part_id = text("part_id");
  query.characteristic = text("characteristic");
  query.order = text("order");
  query.machine = text("machine");
  if (const auto verdict = request.text("verdict")) {
    query.verdict = gauging::verdict_from_word(*verdict);
  }
  // `all` is no source, so that the filter is off.
  if (const auto source = request.text("source")) query.source = app::source_from_word(*source);
  query.from = request.time("from");
  query.to = request.time("to");
  query.history = request.text("history") == "all";
  return query;
}

void list_measurements(const Services& services, const http::Request& request,
                       http::Responder responder) {
  const auto after = cursor_of(request);
  if (!after) return responder.fail(after.error());
  const Form form = form_of(request);
  const auto limit = request.integer("limit");
  app::MeasurementQuery query = measurement_query(request);
  if (!limit && form != Form::Json) {
    http::Response response(
        200, media_type(form),
        http::StreamedBody{.source = std::make_shared<MeasurementStream>(
                               services.measurements, std::move(query), *after, form)});
    return responder.answer(std::move(response).with("Vary", "Accept"));
  }
  auto rows = std::make_shared<std::string>();
  services.measurements.list(
      std::move(query), *after, static_cast<std::size_t>(limit.value_or(kDefaultLimit)),
      [rows, form](const app::Measurement& measurement) {
        if (form == Form::Json && !rows->empty()) *rows += ',';
        append_row(*rows, form, measurement);
      },
      [&request, rows, form, responder = std::make_shared<http::Responder>(std::move(responder))](
          Result<std::optional<std::int64_t>> next) {
        if (!next) return responder->fail(next.error());
        answer_page(request, *responder, form, std::move(*rows), *next);
      });
}

}  // namespace fitgauge::api
