#include "api/runs/setups_resource.hpp"

#include <algorithm>

#include "api/handlers.hpp"
#include "api/runs/setup_builder.hpp"
#include "api/runs/setup_codec.hpp"
#include "api/wire/json_writer.hpp"
#include "api/wire/request_facts.hpp"
#include "app/runs/run_service.hpp"
#include "app/runs/setup_service.hpp"

namespace fitgauge::api {
namespace {

constexpr std::size_t kLongestName = 100;

/// What a name may be, so that it stands in a path and in a message as it is.
Result<std::string> name_of(const http::Request& request) {
  const std::string_view name = *request.text("name");
  const bool printable = std::none_of(name.begin(), name.end(), [](char c) {
    return static_cast<unsigned char>(c) < ' ' || c == '/' || c == '\\' || c == '\x7f';
  });
  if (!name.empty() && name.size() <= kLongestName && printable) return std::string(name);
  return Error{ErrorCode::PathMalformed,
               "the name of a setup has 1 to 100 bytes without / and \\ and control characters"};
}

/// Decoding may take long (a surface of many points), so it is not done on an I/O thread.
void put_setup(const Services& services, const http::Request& request, http::Responder responder) {
  const auto name = name_of(request);
  if (!name) return responder.fail(name.error());
  const auto shared = share(std::move(responder));
  services.runs.prepare(
      [&services, &request, name = *name, shared] {
        const auto body = parse_json(request.body());
        if (!body) return shared->fail(body.error());
        const auto tables = services.runs.control_tables();
        if (!tables) return shared->fail(tables.error());
        FieldErrors errors;
        machine::Setup setup = decode_setup(*body, "", **tables, errors);
        interpreter::RunOptions options;
        decode_builder(*body, "", options, errors);
        if (auto error = errors.take()) return shared->fail(std::move(*error));
        const auto loaded = services.runs.load_meshes(setup, "", app::MissingFiles::Allowed);
        if (!loaded) return shared->fail(loaded.error());
        const auto caller = caller_name(request);
        services.setups.write(
            name, std::string(request.body()),
            caller ? std::optional<std::string>(*caller) : std::nullopt,
            text_precondition_of(request),
            [shared, tag = etag_of_text(request.body())](Result<bool> created) {
              if (!created) return shared->fail(created.error());
              shared->answer(http::Response(*created ? 201 : 200).with("ETag", tag));
            });
      },
      [shared](Error error) { shared->fail(std::move(error)); });
}

void get_setup(const Services& services, const http::Request& request, http::Responder responder) {
  services.setups.read(std::string(*request.text("name")),
                       [if_match = preconditions_of(request).if_match,
                        shared = share(std::move(responder))](Result<app::NamedSetup> setup) {
                         if (!setup) return shared->fail(setup.error());
                         const std::string tag = etag_of_text(setup->text);
                         if (!Preconditions{.if_match = if_match}.hold(tag))
                           return shared->fail(other_state());
                         http::Response response(200, "application/json", std::move(setup->text));
                         response.etag = tag;
                         shared->answer(std::move(response));
                       });
}

void delete_setup(const Services& services, const http::Request& request,
                  http::Responder responder) {
  services.setups.remove(std::string(*request.text("name")), text_precondition_of(request),
                         [shared = share(std::move(responder))](const Result<bool>& removed) {
                           if (!removed) return shared->fail(removed.error());
                           shared->answer(http::Response(204));
                         });
}

void list_setups(const Services& services, const http::Request&, http::Responder responder) {
  services.setups.list(
      [shared = share(std::move(responder))](Result<std::vector<app::NamedSetup>> setups) {
        if (!setups) return shared->fail(setups.error());
        std::string body;
        JsonWriter json(body);
        json.begin_object().key("setups").begin_array();
        for (const app::NamedSetup& setup : *setups) {
          json.begin_object()
              .member("name", setup.name)
              .member("modified_at", format_rfc3339(setup.modified_at))
              .end_object();
        }
        json.end_array().end_object();
        shared->answer({200, "application/json", std::move(body)});
      });
}

}  // namespace

void add_setups_routes(std::vector<http::Route>& routes, const Services& services) {
  const http::Parameter name{
      .name = "name", .place = http::ParameterPlace::Path, .description = "Of the setup"};
  routes.push_back({
      .pattern = "/v1/setups",
      .handler = with(services, list_setups),
      .summary = "The named setups",
      .access = "viewer",
      .operation = "listSetups",
      .tag = "setups",
      .outcomes = {{.meaning = "The setups", .schema = "Setups"}},
  });
  routes.push_back({
      .pattern = "/v1/setups/{name}",
      .handler = with(services, get_setup),
      .summary = "A setup as it was stored",
      .parameters = {name},
      .access = "viewer",
      .operation = "getSetup",
      .tag = "setups",
      .outcomes = {{.meaning = "The setup", .schema = "Setup"}},
      .refusals = {404, 412},
  });
  add_precondition_parameters(routes.back().parameters);
  routes.push_back({
      .method = http::Method::Put,
      .pattern = "/v1/setups/{name}",
      .handler = with(services, put_setup),
      .summary = "Store a machine, its tools and the workpiece on its table",
      .parameters = {name},
      .body = {.use = http::BodyUse::Required,
               .media_types = {"application/json"},
               .schema = "Setup"},
      .access = "admin",
      .operation = "putSetup",
      .tag = "setups",
      .outcomes = {{.meaning = "It is replaced"}, {.status = 201, .meaning = "It is new"}},
      .refusals = {412},
  });
  add_precondition_parameters(routes.back().parameters);
  routes.push_back({
      .method = http::Method::Delete,
      .pattern = "/v1/setups/{name}",
      .handler = with(services, delete_setup),
      .summary = "Delete a setup",
      .parameters = {name},
      .access = "admin",
      .operation = "deleteSetup",
      .tag = "setups",
      .outcomes = {{.status = 204, .meaning = "It is gone"}},
      .refusals = {404, 412},
  });
  add_precondition_parameters(routes.back().parameters);
}

}  // namespace fitgauge::api
