#include "api/service/document_routes.hpp"

#include "api/statistics/computation.hpp"
#include "api/wire/request_facts.hpp"
#include "service/jobs.hpp"
#include "service/runs/run_service.hpp"

namespace fitgauge::api {
namespace {

using Handler = void (*)(const Services&, const KindOfDocument&, const Request&, Responder);

http::AsyncHandler of_kind(const Services& services, const KindOfDocument& kind, Handler handler) {
  return [&services, &kind, handler](const Request& request, Responder responder) {
    handler(services, kind, request, std::move(responder));
  };
}

std::string_view parameter_name(const KindOfDocument& kind) {
  return kind.parameter.substr(0, kind.parameter.find('*'));
}

std::string name_in_path(const KindOfDocument& kind, const Request& request) {
  return std::string(*request.text(parameter_name(kind)));
}

std::string names_allowed(const KindOfDocument& kind) {
  return fmt::format("1 to {} bytes without {}control characters", kind.longest_name,
                     kind.names_with_slashes ? "" : "/ and \\ and ");
}

/// Allowed names, which fit in a path and in a message.
Result<std::string> name_to_write(const KindOfDocument& kind, const Request& request) {
  std::string name = name_in_path(kind, request);
  const bool printable = std::ranges::none_of(name, [&](char c) {
    return static_cast<unsigned char>(c) < ' ' || c == '\x7f' ||
           (!kind.names_with_slashes && (c == '/' || c == '\\'));
  });
  if (!name.empty() && name.size() <= kind.longest_name && printable) return name;
  return Error::of(ErrorCode::PathMalformed, "the {} of {} must have {}", parameter_name(kind),
                   kind.one, names_allowed(kind));
}

Response written(bool created, std::string answer, std::string_view tag) {
  const int status = created ? 201 : 200;
  Response response =
      answer.empty() ? Response(status) : Response(status, "application/json", std::move(answer));
  return std::move(response).with("ETag", std::string(tag));
}

/// Puts the refusal of a write at its member, if the document that the member names does not exist.
Error at_named(const Error& error) {
  return error.code == ErrorCode::GaugeUnknown ? at_member("gauge", error) : at_budget(error);
}

/// Answers a change that was stored, once it is heard.
void answer_change(const Services& services, const KindOfDocument& kind,
                   const SharedResponder& shared, Response response) {
  if (kind.changed == nullptr) return shared->answer(std::move(response));
  const auto kept = std::make_shared<Response>(std::move(response));
  kind.changed(services, [shared, kept](const Result<void>& heard) {
    if (!heard) return shared->fail(heard.error());
    shared->answer(std::move(*kept));
  });
}

void write(const Services& services, const KindOfDocument& kind, std::string name,
           CheckedDocument checked, const Request& request, const SharedResponder& shared) {
  std::string tag = etag_of_text(checked.text);
  auto precondition = text_precondition_of(request);
  if (checked.before) {
    precondition = [given = std::move(precondition),
                    before = *std::move(checked.before)](std::optional<std::string_view> text) {
      return text.value_or("") == before && (!given || given(text));
    };
  }
  services.documents.write({.kind = kind.kind,
                            .name = std::move(name),
                            .text = std::move(checked.text),
                            .caller = caller_text(request),
                            .uncertainty = std::move(checked.uncertainty),
                            .gauge = std::move(checked.gauge),
                            .precondition = std::move(precondition)},
                           [&services, &kind, shared, tag = std::move(tag),
                            answer = std::move(checked.answer)](Result<bool> created) {
                             if (!created) return shared->fail(at_named(created.error()));
                             answer_change(services, kind, shared, written(*created, answer, tag));
                           });
}

void put(const Services& services, const KindOfDocument& kind, const Request& request,
         Responder responder) {
  auto name = TRY_OR_FAIL(responder, name_to_write(kind, request));
  const SharedResponder shared = share(std::move(responder));
  const bool is_other = !kind.other_type.empty() && request.media_type() == kind.other_type;
  JobPool& pool = kind.is_figure || is_other ? services.jobs.figures : services.jobs.orders;
  pool.run(
      [&services, &kind, &request, is_other, name] {
        return is_other ? kind.check_other(services, name, request.file_body())
                        : kind.check(services, name, request.body());
      },
      [&services, &kind, &request, name, shared](Result<CheckedDocument> checked) {
        if (!checked) return shared->fail(checked.error());
        write(services, kind, name, *std::move(checked), request, shared);
      });
}

void get(const Services& services, const KindOfDocument& kind, const Request& request,
         Responder responder) {
  services.documents.read(
      kind.kind, name_in_path(kind, request),
      answer_with(std::move(responder),
                  [if_match = preconditions_of(request).if_match](app::NamedDocument document) {
                    return with_tag({200, "application/json", std::move(document.text)}, if_match);
                  }));
}

void remove(const Services& services, const KindOfDocument& kind, const Request& request,
            Responder responder) {
  const std::string name = name_in_path(kind, request);
  services.documents.remove(
      kind.kind, name, text_precondition_of(request), caller_text(request),
      services.runs.queued([&](const app::RunOrder& order) {
        return kind.kind == app::DocumentKind::Setup && order.setup_name == name;
      }),
      [&services, &kind, shared = share(std::move(responder))](const Result<bool>& removed) {
        if (!removed) return shared->fail(removed.error());
        answer_change(services, kind, shared, Response(204));
      });
}

Result<std::string> list_of(const KindOfDocument& kind,
                            const std::vector<app::NamedDocument>& documents) {
  std::string body;
  JsonWriter json(body);
  json.begin_object().key(kind.member).begin_array();
  for (const app::NamedDocument& document : documents) {
    json.begin_object();
    TRY(kind.describe(json, document));
    json.member("modified_at", format_rfc3339({document.modified_at_ns})).end_object();
  }
  json.end_array().end_object();
  return body;
}

void list(const Services& services, const KindOfDocument& kind, const Request&,
          Responder responder) {
  services.documents.list(kind.kind,
                          answer_with(std::move(responder), [&kind](const auto& documents) {
                            return json_response(list_of(kind, documents));
                          }));
}

}  // namespace

Error at_budget(const Error& error) {
  return error.code == ErrorCode::UncertaintyUnknown ? at_member("uncertainty", error) : error;
}

Result<void> describe_by_name(JsonWriter& json, const app::NamedDocument& document) {
  json.member("name", document.name);
  return {};
}

NamedSchema names_schema(std::string name, std::string_view member, const schema::Fields& more) {
  const std::string document =
      schema::object(schema::Fields{{"name", schema::text(), "Name, as in the path"}} + more +
                     schema::Fields{{"modified_at", schema::time(), "Time of storing, in UTC"}});
  return {std::move(name),
          schema::object({{std::string(member), schema::array(document), "Sorted by name"}})};
}

void add_document_routes(Routes& add, const KindOfDocument& kind) {
  const Parameter name =
      path_parameter(std::string(parameter_name(kind)),
                     fmt::format("Name of {}: {}", kind.one, names_allowed(kind)));
  const std::string pattern = fmt::format("{}/{{{}}}", kind.path, kind.parameter);
  const std::string schema(kind.schema);
  const std::string answered(kind.answered);
  add(fmt::format("GET {} list{} viewer", kind.path, kind.operations),
      of_kind(add.services, kind, list),
      {.summary = fmt::format("The {}", kind.many),
       .outcomes = {{.meaning = "Sorted by name", .schema = std::string(kind.list_schema)}}});
  add(fmt::format("GET {} get{} viewer 404 412", pattern, kind.operation),
      of_kind(add.services, kind, get),
      {.summary = fmt::format("Read {} as it was stored", kind.one),
       .parameters = with_preconditions(name),
       .outcomes = {{.meaning = "Document as stored", .schema = schema}}});
  add(fmt::format("PUT {} put{} admin 412", pattern, kind.operation),
      of_kind(add.services, kind, put),
      {.summary = fmt::format("Store {}: {}", kind.one, kind.contents),
       .parameters = with_preconditions(name),
       .body = json_body(std::string(kind.body_schema)),
       .outcomes = {{.meaning = "Replaced", .schema = answered},
                    {.status = 201, .meaning = "Created", .schema = answered}}});
  if (!kind.other_type.empty()) {
    add.all.back().body.media_types.emplace_back(kind.other_type);
    add.all.back().body.other_type = kind.other_type;
    add.all.back().body.other_limit = kind.longest_other;
    add.all.back().body.spools = true;
  }
  add(fmt::format("DELETE {} delete{} admin 404 409 412", pattern, kind.operation),
      of_kind(add.services, kind, remove),
      {.summary = fmt::format("Delete {}", kind.one),
       .parameters = with_preconditions(name),
       .outcomes = {{.status = 204, .meaning = "Deleted"}}});
}

}  // namespace fitgauge::api
