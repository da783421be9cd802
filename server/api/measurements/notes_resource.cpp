#include "api/measurements/measurements.hpp"

#include "api/service/document_routes.hpp"
#include "record/note.hpp"

namespace fitgauge::api {
namespace {

constexpr std::size_t kMostEntries = 500;

struct NoteOrder {
  app::Note note{};
};
void members(auto& v, NoteOrder& order) { given_members(v, order.note); }

struct NotesAnswer {
  std::vector<app::Note> notes{};
};
void members(auto& v, const NotesAnswer& answer) {
  v.member("notes", answer.notes, List<app::Note>{{"Note"}}, "Oldest first");
  v.member("set_aside", app::sets_aside(answer.notes), "true if the notes set the value aside");
}

Result<app::Note> read_note(std::string_view text) {
  const auto body = TRY(parse_json(text));
  FieldErrors errors;
  NoteOrder order;
  read_body(body, "", errors, order);
  if (errors.empty() && !order.note.says_something())
    errors.add(ErrorCode::FieldMissing, "/cause", "a note must have a cause, an action or a text");
  if (auto error = errors.take()) return *std::move(error);
  return std::move(order.note);
}

void add_note(const SharedPosting& posting, const app::RecordName& measurement) {
  auto note = TRY_OR_FAIL(posting->responder, read_note(posting->request.body()));
  note.received_at = posting->services.clock.now();
  note.caller = caller_text(posting->request);
  posting->services.measurements.add_note(
      measurement, std::move(note), posting->scope, [posting](Result<app::Answer> answer) {
        if (!answer) return posting->responder.fail(answer.error());
        posting->responder.answer(api::response_of(*std::move(answer)));
      });
}

void post_note(const Services& services, const Request& request, Responder responder) {
  const auto id = TRY_OR_FAIL(responder, services.measurements.parse_id(*request.text("id")));
  post_once(services, request, std::move(responder),
            [id](const SharedPosting& posting) { add_note(posting, id); });
}

void list_notes(const Services& services, const Request& request, Responder responder) {
  const auto id = TRY_OR_FAIL(responder, services.measurements.parse_id(*request.text("id")));
  services.measurements.list_notes(id, answer_with(std::move(responder), [](const auto& notes) {
                                     return json_response(body_json(NotesAnswer{notes}));
                                   }));
}

/// The form of the entries of a catalogue: each once, so that a choice is one.
struct Entries {
  std::string schema(Side side) const {
    return schema::array(NoteText{}.schema(side), 0, kMostEntries);
  }
  bool read(FieldReader& fields, std::string_view name, const auto&) const {
    const JsonValue* list = fields.array(name);
    if (list == nullptr) return false;
    FieldErrors& errors = fields.errors();
    if (list->items.size() > kMostEntries) {
      fields.report(ErrorCode::FieldTooLong, name, "at most {} entries", kMostEntries);
      return false;
    }
    std::set<std::string_view> texts;
    for (std::size_t i = 0; i < list->items.size(); ++i) {
      const JsonValue& item = list->items[i];
      const std::string at = pointer_to(fields.at(name), i);
      if (!item.is(JsonValue::Kind::String)) {
        errors.add(ErrorCode::FieldType, at,
                   fmt::format("an entry must be a string; got {}", name_of(item.kind)));
        continue;
      }
      NoteText{}.check(errors, at, "an entry", item.text);
      if (!texts.insert(item.text).second)
        errors.add(ErrorCode::FieldConflict, at, "this entry is repeated");
    }
    return true;
  }
};

struct Catalogue {
  std::nullptr_t checked{};  ///< stored as sent
};
void members(auto& v, Catalogue& catalogue) {
  v.member("causes", catalogue.checked, Entries{}, "Causes in the order of the list; each once");
  v.member("measures", catalogue.checked, Entries{}, "Actions in the order of the list; each once");
}

Result<CheckedDocument> check_catalogue(const Services&, const std::string&,
                                        std::string_view text) {
  const auto body = TRY(parse_json(text));
  TRY(read_whole<Catalogue>(body));
  return CheckedDocument{.text = std::string(text)};
}

constexpr KindOfDocument kCatalogues{.kind = app::DocumentKind::Catalogue,
                                     .path = "/v1/catalogues",
                                     .one = "a catalogue",
                                     .contents = "causes and actions to choose from",
                                     .many = "catalogues of causes and actions",
                                     .member = "catalogues",
                                     .operation = "Catalogue",
                                     .operations = "Catalogues",
                                     .check = check_catalogue};

Parameter measurement_parameter() { return path_parameter("id", "The measurement it is about"); }

}  // namespace

void add_note_schemas(Schemas& schemas) {
  schemas.push_back(order_schema<NoteOrder>("NewNote"));
  schemas.push_back(answer_schema<app::Note>("Note"));
  schemas.push_back(answer_schema<NotesAnswer>("Notes"));
  schemas.push_back(order_schema<Catalogue>("Catalogue"));
  schemas.push_back(names_schema("Catalogues", "catalogues"));
}

void add_notes_routes(Routes& add) {
  add("POST /v1/measurements/{id}/notes addNote operator 404 409", post_note,
      {.summary = "Add a note to a measurement: its cause, the action, a text",
       .description = "Notes are never changed and are not part of the record. An Idempotency-Key "
                      "makes repeats safe.",
       .parameters = {measurement_parameter(), idempotency_parameter()},
       .body = json_body("NewNote"),
       .outcomes = {{.status = 201, .meaning = "Stored for good", .schema = "Note"}}});
  add("GET /v1/measurements/{id}/notes listNotes viewer 404", list_notes,
      {.summary = "The notes on a measurement",
       .parameters = {measurement_parameter()},
       .outcomes = {{.meaning = "Oldest first", .schema = "Notes"}}});
}

void add_catalogues_routes(Routes& add) { add_document_routes(add, kCatalogues); }

}  // namespace fitgauge::api
