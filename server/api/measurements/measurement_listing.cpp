#include "api/measurements/measurements.hpp"

#include "api/limits/limits_codec.hpp"
#include "record/note.hpp"
#include "record/record.hpp"
#include "service/log/log_service.hpp"
#include "service/runs/run_service.hpp"

namespace fitgauge::api {
namespace {

constexpr std::int64_t kDefaultLimit = 100;
constexpr std::size_t kRowsAPiece = 200;

enum class Form { Json, Ndjson, Csv, Dfq, Qif, Xlsx };

/// Their words in `format` and their media types, by Form.
constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kForms = {{
    {"json", "application/json"},
    {"ndjson", "application/x-ndjson"},
    {"csv", "text/csv"},
    {"dfq", kDfqType},
    {"qif", kQifType},
    {"xlsx", kXlsxType},
}};

bool is_file(Form form) { return form == Form::Dfq || form == Form::Qif || form == Form::Xlsx; }

Form form_of(const Request& request) {
  const auto format = request.text("format");
  const auto found = std::ranges::find_if(kForms, [&](const auto& form) {
    return format ? form.first == *format : form.second == request.response_type();
  });
  return found == kForms.end() ? Form::Json : static_cast<Form>(found - kForms.begin());
}

std::string media_type(Form form) {
  if (form == Form::Csv) return "text/csv; charset=utf-8; header=present";
  return std::string(kForms.at(static_cast<std::size_t>(form)).second);
}

/// Writes the notes after the members of a record.
void append_notes(std::string& out, std::span<const app::Note> notes) {
  out.pop_back();
  out += app::sets_aside(notes) ? ",\"set_aside\":true,\"notes\":" : ",\"notes\":";
  JsonWriter json(out);
  List<app::Note>{}.write(json, notes);
  out += '}';
}

void append_row(std::string& out, Form form, const app::Measurement& measurement) {
  if (form == Form::Csv) return append_measurement_csv(out, measurement);
  app::append_record(out, measurement);
  if (!measurement.notes.empty()) append_notes(out, measurement.notes);
  if (form == Form::Ndjson) out += '\n';
}

/// Start of a page.
struct Cursor {
  std::int64_t after = 0;                 ///< the row before its first
  std::optional<std::int64_t> as_of;      ///< state of the list; none: the newest
  std::optional<app::RecordName> record;  ///< or it begins after this one
};

/// `m100.m250-5f0c9a3e77d21b40`: the rows after m100, in the state when m250 was the newest of that
/// history. Older cursors, `m100.m250`, do not name the history.
std::string cursor_text(const app::ListPage& page, std::string_view origin) {
  return fmt::format("m{}.{}", *page.next, app::measurement_id_text(page.as_of, origin));
}

/// The id of a measurement is also a cursor, for later measurements.
Result<Cursor> cursor_of(const Services& services, const Request& request) {
  const auto text = request.text("after");
  if (!text) return Cursor();
  const std::size_t point = text->find('.');
  if (point == std::string_view::npos) {
    const auto after = services.measurements.parse_id(*text);
    if (after) return Cursor{.after = 0, .as_of = {}, .record = *after};
  } else {
    const auto as_of = services.measurements.parse_id(text->substr(point + 1));
    const std::size_t dash = std::min(text->find('-', point), text->size());
    const auto after = services.measurements.parse_id(
        std::string(text->substr(0, point)).append(text->substr(dash)));
    if (as_of && as_of->origin == 0 && after)
      return Cursor{.after = after->number, .as_of = as_of->number, .record = {}};
  }
  return Error{ErrorCode::CursorInvalid, "after must be the `next` of an earlier page"};
}

/// All measurements that match, read page by page while they are sent.
class MeasurementStream final : public http::BodyStream,
                                public std::enable_shared_from_this<MeasurementStream> {
 public:
  MeasurementStream(app::MeasurementService& measurements, app::MeasurementQuery query,
                    std::int64_t after, Form form)
      : measurements_(measurements), query_(std::move(query)), after_(after), form_(form) {}

  /// Reads the first piece: a storage that cannot be read is an error before the first byte.
  void answer(Responder responder) {
    if (form_ == Form::Csv) piece_ = measurement_csv_header();
    read([self = shared_from_this(),
          responder = share(std::move(responder))](const Result<void>& read) {
      if (!read) return responder->fail(read.error());
      Response response(200, media_type(self->form_), http::StreamedBody{.source = self});
      responder->answer(std::move(response).with("Vary", "Accept"));
    });
  }

  void next(http::ChunkSink sink) override {
    if (is_read_) return hand_over(sink);
    read([self = shared_from_this(), sink = std::make_shared<http::ChunkSink>(std::move(sink))](
             const Result<void>& read) { read ? self->hand_over(*sink) : sink->fail(); });
  }

 private:
  void read(std::function<void(const Result<void>&)> done) {
    measurements_.list(
        query_, after_, kRowsAPiece,
        [self = shared_from_this()](const app::Measurement& measurement) {
          append_row(self->piece_, self->form_, measurement);
        },
        [self = shared_from_this(), done = std::move(done)](const Result<app::ListPage>& page) {
          if (!page) return done(page.error());
          self->is_read_ = true;
          self->is_last_ = !page->next;
          self->after_ = page->next.value_or(0);
          self->query_.as_of_id = page->as_of;
          self->query_.after.reset();
          done({});
        });
  }

  void hand_over(http::ChunkSink& sink) {
    is_read_ = false;
    is_last_ ? sink.finish(std::exchange(piece_, {})) : sink.put(std::exchange(piece_, {}));
  }

  app::MeasurementService& measurements_;
  app::MeasurementQuery query_;
  std::int64_t after_;
  Form form_;
  std::string piece_;
  bool is_read_ = false;  ///< `piece_` must still be sent
  bool is_last_ = false;
};

void answer_page(const Services& services, const Request& request, Responder& responder, Form form,
                 const std::string& rows, const app::ListPage& page) {
  std::string body;
  const std::string cursor = page.next ? cursor_text(page, services.log.origin()) : "";
  if (form == Form::Json) {
    body = json_object([&](JsonWriter& json) {
      json.key("measurements").raw("[" + rows + "]").key("next");
      page.next ? json.value(cursor) : json.null();
    });
  } else {
    body = (form == Form::Csv ? measurement_csv_header() : std::string()) + rows;
  }
  Response response(200, media_type(form), std::move(body));
  response.with("Vary", "Accept");
  if (page.next) response.with("Link", next_link(request, cursor));
  responder.answer(std::move(response));
}

}  // namespace

std::vector<Parameter> measurement_filter_parameters(std::string_view prefix) {
  std::vector<Parameter> parameters;
  for (const std::string_view name : app::kTextFilters)
    parameters.push_back(query(std::string(name), fmt::format("Exactly this {}", name)));
  parameters =
      std::move(parameters) +
      std::vector<Parameter>{
          query("designation", "`25 H7`, `M10-6H`, `25 ISO 2768-m`"),
          query("run_id", "Values of this run, of every source if `source` is absent"),
          query("verdict", http::Words{{"good", "rework", "reject", "indeterminate", "unjudged"}},
                "Only this verdict"),
          query("source", http::Words{{"gauge", "simulation", "all"}},
                "Source of the measurements (default: gauge)"),
          query("from", http::Time{}, "measured_at from this time on"),
          query("to", http::Time{}, "measured_at before this time"),
          query("received_from", http::Time{}, "received_at from this time on"),
          query("received_to", http::Time{}, "received_at before this time"),
          query("cause", "Values with a note of exactly this cause"),
          query("notes_from", http::Time{}, "Values with a note received from this time on"),
          query("notes_to", http::Time{}, "Values with a note received before this time"),
          query("confirmed", http::Words{{"true", "false"}},
                "false leaves out values that a person confirmed although they are far "
                "outside; true shows only these values"),
          query("set_aside", http::Words{{"true", "false"}},
                "false leaves out values that a note sets aside; true shows only these values"),
          query("history", http::Words{{"current", "all"}}, "all shows corrected rows too"),
      };
  for (Parameter& parameter : parameters) parameter.name.insert(0, prefix);
  return parameters;
}

Result<app::MeasurementQuery> measurement_query(const Services& services, const Request& request,
                                                std::string_view prefix) {
  const auto named = [prefix](std::string_view name) { return std::string(prefix).append(name); };
  const auto text_of = [&](std::string_view name) { return request.text(named(name)); };
  app::MeasurementQuery query;
  for (std::size_t i = 0; i < app::kTextFilters.size(); ++i) {
    if (const auto text = text_of(app::kTextFilters[i])) query.texts[i].emplace(*text);
  }
  if (const auto text = text_of("designation")) {
    auto designation = parse_designation(*text);
    if (!designation) {
      // A path with it would be 404 or 422; a filter is an argument.
      Error error = std::move(designation).error();
      if (error.code != ErrorCode::DesignationMalformed) error.code = ErrorCode::QueryInvalid;
      return error;
    }
    query.designation = *std::move(designation);
  }
  if (const auto text = text_of("run_id")) {
    const auto run = services.measurements.parse_run(*text);
    if (!run)
      return Error{ErrorCode::QueryInvalid, "run_id must be the id of a run", named("run_id")};
    query.run_id = run->number;
    query.run_origin = run->origin;
    query.source.reset();  // a run's measurements have no gauge
  }
  if (const auto verdict = text_of("verdict")) query.verdict = gauging::verdict_from_word(*verdict);
  // `all` is no source, so that the filter is off.
  if (const auto text = text_of("source")) query.source = app::source_from_word(*text);
  const auto time_of = [&](std::string_view name) {
    const auto time = request.time(named(name));
    return time ? std::optional(time->nanoseconds) : std::nullopt;
  };
  query.from_ns = time_of("from");
  query.to_ns = time_of("to");
  query.received_from_ns = time_of("received_from");
  query.received_to_ns = time_of("received_to");
  if (const auto cause = text_of("cause")) query.cause.emplace(*cause);
  query.noted_from_ns = time_of("notes_from");
  query.noted_to_ns = time_of("notes_to");
  if (const auto confirmed = text_of("confirmed")) query.confirmed = *confirmed == "true";
  if (const auto aside = text_of("set_aside")) query.set_aside = *aside == "true";
  query.history = text_of("history") == "all";
  return query;
}

void list_measurements(const Services& services, const Request& request, Responder responder) {
  const auto cursor = TRY_OR_FAIL(responder, cursor_of(services, request));
  const Form form = form_of(request);
  const auto limit = request.integer("limit");
  auto query = TRY_OR_FAIL(responder, measurement_query(services, request));
  query.as_of_id = cursor.as_of;
  query.after = cursor.record;
  const auto notes = request.text("notes");
  query.shows_notes = notes.has_value();
  query.has_notes = notes == "only";
  query.newest_first = request.text("sort") == "newest";
  if (const auto last = request.integer("last")) {
    if (limit || request.text("after")) {
      return responder.fail(
          {ErrorCode::QueryInvalid, "last is a list of one page: remove limit and after", "last"});
    }
    query.last = static_cast<std::size_t>(*last);
  }
  if (is_file(form)) {
    return send_file(services, request, std::move(responder),
                     kForms.at(static_cast<std::size_t>(form)).second, std::move(query),
                     cursor.after, limit);
  }
  if (!limit && !query.last && form != Form::Json) {
    return std::make_shared<MeasurementStream>(services.measurements, std::move(query),
                                               cursor.after, form)
        ->answer(std::move(responder));
  }
  auto rows = std::make_shared<std::string>();
  services.measurements.list(
      query, cursor.after, static_cast<std::size_t>(limit.value_or(kDefaultLimit)),
      [rows, form](const app::Measurement& measurement) {
        if (form == Form::Json && !rows->empty()) *rows += ',';
        append_row(*rows, form, measurement);
      },
      [&services, &request, rows, form,
       responder = share(std::move(responder))](Result<app::ListPage> page) {
        if (!page) return responder->fail(page.error());
        answer_page(services, request, *responder, form, *rows, *page);
      });
}

}  // namespace fitgauge::api
