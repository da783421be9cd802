#include "api/resources.hpp"

#include "api/runs/setup_builder.hpp"
#include "api/runs/setup_codec.hpp"
#include "api/service/document_routes.hpp"
#include "service/runs/run_service.hpp"

namespace fitgauge::api {
namespace {

Result<CheckedDocument> check_setup(const Services& services, const std::string&,
                                    std::string_view text) {
  const auto body = parse_json(text);
  if (!body) return body.error();
  const auto tables = services.runs.control_tables();
  if (!tables) return tables.error();
  FieldErrors errors;
  machine::Setup setup = decode_setup(*body, "", **tables, errors);
  interpreter::RunOptions options;
  decode_builder(*body, "", options, errors);
  if (auto error = errors.take()) return *std::move(error);
  const auto loaded = services.runs.load_meshes(setup, "", app::MissingFiles::Allowed);
  if (!loaded) return loaded.error();
  return CheckedDocument{.text = std::string(text)};
}

constexpr KindOfDocument kSetups{.kind = app::DocumentKind::Setup,
                                 .path = "/v1/setups",
                                 .parameter = "name",
                                 .one = "a setup",
                                 .contents = "a machine, its tools and the workpiece on its table",
                                 .many = "named setups",
                                 .member = "setups",
                                 .tag = "setups",
                                 .operation = "Setup",
                                 .operations = "Setups",
                                 .schema = "Setup",
                                 .body_schema = "Setup",
                                 .list_schema = "Setups",
                                 .longest_name = 100,
                                 .names_with_slashes = false,
                                 .check = check_setup};

}  // namespace

void add_setups_routes(std::vector<http::Route>& routes, const Services& services) {
  add_document_routes(routes, services, kSetups);
}

}  // namespace fitgauge::api
