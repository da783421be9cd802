#include "api/runs/control_program.hpp"

#include <future>

#include "api/runs/run_order_codec.hpp"
#include "base/json/json_value.hpp"
#include "nc/program/check.hpp"
#include "service/jobs.hpp"

namespace fitgauge::api {
namespace {

using Kind = JsonValue::Kind;

JsonValue text(std::string value) { return {.kind = Kind::String, .text = std::move(value)}; }
JsonValue number(std::int64_t value) {
  return {.kind = Kind::Number, .text = std::to_string(value)};
}

/// The body of a POST that orders the same.
JsonValue body_of(const std::string& program, const std::string& setup) {
  JsonValue body{.kind = Kind::Object};
  body.members.emplace_back("program", text(program));
  if (!setup.empty()) body.members.emplace_back("setup", text(setup));
  JsonValue limits{.kind = Kind::Object};
  limits.members.emplace_back("blocks", number(kMostBlocks));
  limits.members.emplace_back("seconds", number(static_cast<std::int64_t>(kMostSeconds)));
  body.members.emplace_back("limits", std::move(limits));
  return body;
}

Result<app::RunOrder> read_order(const Services& services, const std::string& program,
                                 const std::string& setup) {
  const auto tables = services.runs.control_tables();
  if (!tables) return tables.error();
  return decode_run_order(
      body_of(program, setup),
      [&services](const std::string& name) {
        return services.documents.wait_for(app::DocumentKind::Setup, name);
      },
      **tables);
}

Result<std::shared_ptr<app::ActiveRun>> start(const Services& services,
                                              const interpreter::ControlPath& program,
                                              const std::string& setup) {
  auto order = read_order(services, program.text(), setup);
  if (!order) return order.error();
  const auto diagnostics = services.runs.check_program(order->program);
  if (!diagnostics) return diagnostics.error();
  if (interpreter::has_errors(*diagnostics, order->options.keeps_unreadable)) {
    return Error{ErrorCode::ProgramInvalid, program.text() + " or a program it calls has errors"};
  }
  return services.runs.start(*std::move(order), std::nullopt,
                             [](const app::ActiveRun&) { return app::Answer{}; });
}

/// What `work` returns as an order.
template <class Work>
auto ordered(const Services& services, const Work& work) {
  std::promise<decltype(work())> promise;
  services.jobs.orders.run(work,
                           [&](decltype(work()) made) { promise.set_value(std::move(made)); });
  return promise.get_future().get();
}

}  // namespace

Result<machine::Setup> machine_of_setup(const Services& services, const std::string& name) {
  return ordered(services, [&]() -> Result<machine::Setup> {
    if (!name.empty()) {
      if (const auto found = services.documents.wait_for(app::DocumentKind::Setup, name); !found)
        return found.error();
    }
    auto order = read_order(services, "TNC:\\none.h", name);
    if (!order) return order.error();
    return std::move(order->setup);
  });
}

Result<std::shared_ptr<app::ActiveRun>> start_program(const Services& services,
                                                      const interpreter::ControlPath& program,
                                                      const std::string& setup) {
  return ordered(services, [&] { return start(services, program, setup); });
}

}  // namespace fitgauge::api
