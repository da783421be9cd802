#include "api/measurements/notes_resource.hpp"

#include <fmt/format.h>

#include <array>
#include <memory>
#include <set>

#include "api/handlers.hpp"
#include "api/measurements/measurement_posting.hpp"
#include "api/measurements/note_limits.hpp"
#include "api/resources.hpp"
#include "api/service/document_routes.hpp"
#include "api/wire/request_facts.hpp"
#include "base/json/field_reader.hpp"
#include "base/json/json_writer.hpp"
#include "service/measurements/measurement_service.hpp"

namespace fitgauge::api {
namespace {

constexpr std::size_t kMostEntries = 500;

struct NoteField {
  std::string_view name;
  std::size_t longest;
  std::optional<std::string> app::Note::*text;
};

constexpr std::array<NoteField, 4> kNoteFields = {{
    {"cause", kLongestEntry, &app::Note::cause},
    {"measure", kLongestEntry, &app::Note::measure},
    {"text", kLongestNoteText, &app::Note::text},
    {"operator", kLongestEntry, &app::Note::operator_id},
}};

bool is_blank(std::string_view text) {
  return text.find_first_not_of(" \t\r\n") == std::string_view::npos;
}

/// @param at where it stands in the body
void check_text(FieldErrors& errors, const std::string& at, std::string_view text,
                std::size_t longest) {
  if (text.size() > longest) {
    errors.add(ErrorCode::FieldTooLong, at, fmt::format("at most {} bytes", longest));
  } else if (is_blank(text) || text.find('\0') != std::string_view::npos) {
    errors.add(ErrorCode::FieldInvalid, at, "a text that is given is not blank");
  }
}

Result<app::Note> read_note(std::string_view text) {
  const auto body = parse_json(text);
  if (!body) return body.error();
  FieldErrors errors;
  FieldReader reader(*body, "", errors);
  app::Note note;
  for (const NoteField& field : kNoteFields) {
    note.*field.text = reader.optional_text(field.name);
    if (note.*field.text)
      check_text(errors, reader.at(field.name), *(note.*field.text), field.longest);
  }
  reader.refuse_unknown();
  if (errors.empty() && !note.cause && !note.measure && !note.text) {
    errors.add(ErrorCode::FieldMissing, "/cause", "a note has a cause, a measure or a text");
  }
  if (auto error = errors.take()) return *std::move(error);
  return note;
}

std::string note_json(const app::Note& note) {
  std::string json;
  append_note_json(json, note);
  return json;
}

void add_note(const SharedPosting& posting, const app::RecordName& measurement) {
  auto note = read_note(posting->request.body());
  if (!note) return posting->responder.fail(note.error());
  note->received_at = posting->services.clock.now();
  if (const auto caller = caller_name(posting->request)) note->caller = std::string(*caller);
  posting->services.measurements.add_note(
      measurement, *std::move(note), posting->scope,
      {.answer =
           [](const app::Note& stored) {
             return app::Answer{.status = 201,
                                .content_type = "application/json",
                                .location = {},
                                .body = note_json(stored)};
           },
       .event = note_json},
      [posting](Result<app::Answer> answer) {
        if (!answer) return posting->responder.fail(answer.error());
        posting->responder.answer(api::response_of(*std::move(answer)));
      });
}

void post_note(const Services& services, const http::Request& request, http::Responder responder) {
  const auto id = services.measurements.parse_id(*request.text("id"));
  if (!id) return responder.fail(id.error());
  post_once(services, request, std::move(responder),
            [id = *id](const SharedPosting& posting) { add_note(posting, id); });
}

void list_notes(const Services& services, const http::Request& request, http::Responder responder) {
  const auto id = services.measurements.parse_id(*request.text("id"));
  if (!id) return responder.fail(id.error());
  services.measurements.list_notes(
      *id, [shared = share(std::move(responder))](const Result<std::vector<app::Note>>& notes) {
        if (!notes) return shared->fail(notes.error());
        std::string body;
        JsonWriter json(body);
        json.begin_object().key("notes").begin_array();
        for (const app::Note& note : *notes) json.raw(note_json(note));
        json.end_array().end_object();
        shared->answer({200, "application/json", std::move(body)});
      });
}

/// Each text once, so that a choice is one.
void check_entries(FieldReader& reader, FieldErrors& errors, std::string_view name) {
  const JsonValue* list = reader.array(name);
  if (list == nullptr) return;
  if (list->items.size() > kMostEntries) {
    return reader.report(ErrorCode::FieldTooLong, name,
                         fmt::format("at most {} entries", kMostEntries));
  }
  std::set<std::string_view> texts;
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    const JsonValue& item = list->items[i];
    const std::string at = pointer_to(reader.at(name), i);
    if (!item.is(JsonValue::Kind::String)) {
      errors.add(ErrorCode::FieldType, at,
                 fmt::format("an entry is a string, not {}", name_of(item.kind)));
      continue;
    }
    check_text(errors, at, item.text, kLongestEntry);
    if (!texts.insert(item.text).second) {
      errors.add(ErrorCode::FieldConflict, at, "this entry stands here before");
    }
  }
}

Result<CheckedDocument> check_catalogue(const Services&, const std::string&,
                                        std::string_view text) {
  const auto body = parse_json(text);
  if (!body) return body.error();
  FieldErrors errors;
  FieldReader reader(*body, "", errors);
  check_entries(reader, errors, "causes");
  check_entries(reader, errors, "measures");
  reader.refuse_unknown();
  if (auto error = errors.take()) return *std::move(error);
  return CheckedDocument{.text = std::string(text)};
}

constexpr KindOfDocument kCatalogues{.kind = app::DocumentKind::Catalogue,
                                     .path = "/v1/catalogues",
                                     .parameter = "name",
                                     .one = "a catalogue",
                                     .contents = "causes and measures to choose from",
                                     .many = "catalogues of causes and measures",
                                     .member = "catalogues",
                                     .tag = "plans",
                                     .operation = "Catalogue",
                                     .operations = "Catalogues",
                                     .schema = "Catalogue",
                                     .body_schema = "Catalogue",
                                     .list_schema = "Catalogues",
                                     .check = check_catalogue};

http::Parameter measurement_parameter() {
  return {.name = "id",
          .place = http::ParameterPlace::Path,
          .description = "The measurement it is about"};
}

}  // namespace

void append_note_json(std::string& out, const app::Note& note) {
  JsonWriter json(out);
  json.begin_object().member("id", note.id).member("measurement_id", note.measurement);
  for (const NoteField& field : kNoteFields) {
    if (const auto& text = note.*field.text) json.member(field.name, *text);
  }
  if (note.caller) json.member("caller", *note.caller);
  json.member("received_at", format_rfc3339(note.received_at)).end_object();
}

void add_notes_routes(std::vector<http::Route>& routes, const Services& services) {
  routes.push_back({
      .method = http::Method::Post,
      .pattern = "/v1/measurements/{id}/notes",
      .handler = with(services, post_note),
      .summary = "Add a note beside a measurement: its cause, what was done, a text",
      .description = "Notes are never changed, and are no part of the record. An Idempotency-Key "
                     "makes repeats safe.",
      .parameters = {measurement_parameter(), idempotency_parameter()},
      .body = {.use = http::BodyUse::Required,
               .media_types = {"application/json"},
               .schema = "NewNote"},
      .access = "operator",
      .operation = "addNote",
      .tag = "measurements",
      .outcomes = {{.status = 201, .meaning = "Stored for good", .schema = "Note"}},
      .refusals = {404, 409},
  });
  routes.push_back({
      .pattern = "/v1/measurements/{id}/notes",
      .handler = with(services, list_notes),
      .summary = "The notes beside a measurement",
      .parameters = {measurement_parameter()},
      .access = "viewer",
      .operation = "listNotes",
      .tag = "measurements",
      .outcomes = {{.meaning = "Oldest first", .schema = "Notes"}},
      .refusals = {404},
  });
  add_document_routes(routes, services, kCatalogues);
}

}  // namespace fitgauge::api
