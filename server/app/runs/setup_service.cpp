#include "app/runs/setup_service.hpp"

#include "store/database.hpp"

namespace fitgauge::app {
namespace {

Error unknown(const std::string& name) {
  return {ErrorCode::SetupUnknown, "there is no setup '" + name + "'"};
}

Error changed(const std::string& name) {
  return {ErrorCode::PreconditionFailed,
          "setup '" + name +
              "' is not in the state that the request's precondition names: read it again"};
}

bool holds(const SetupService::Precondition& precondition, const store::Stores& stores,
           const std::string& name) {
  if (!precondition) return true;
  const auto setup = stores.setups.find(name);
  return precondition(setup ? std::optional<std::string_view>(setup->text) : std::nullopt);
}

NamedSetup named_setup(store::Setup setup) {
  return {.name = std::move(setup.name),
          .text = std::move(setup.text),
          .modified_at = {setup.modified_at_ns}};
}

Result<NamedSetup> find(const store::Stores& stores, const std::string& name) {
  auto found = stores.setups.find(name);
  if (!found) return unknown(name);
  return named_setup(*std::move(found));
}

}  // namespace

void SetupService::write(std::string name, std::string text, std::optional<std::string> caller,
                         Precondition precondition, Done<bool> done) {
  store::Setup setup{.name = std::move(name),
                     .text = std::move(text),
                     .modified_at_ns = clock_.now().nanoseconds,
                     .caller = std::move(caller)};
  database_.writer().submit(
      [setup = std::move(setup),
       precondition = std::move(precondition)](store::Stores& stores) -> Result<bool> {
        if (!holds(precondition, stores, setup.name)) return changed(setup.name);
        return stores.setups.put(setup);
      },
      std::move(done));
}

void SetupService::read(std::string name, Done<NamedSetup> done) {
  database_.readers().submit(
      [name = std::move(name)](const store::Stores& stores) { return find(stores, name); },
      std::move(done));
}

void SetupService::remove(std::string name, Precondition precondition, Done<bool> done) {
  database_.writer().submit(
      [name = std::move(name),
       precondition = std::move(precondition)](store::Stores& stores) -> Result<bool> {
        if (!stores.setups.find(name)) return unknown(name);
        if (!holds(precondition, stores, name)) return changed(name);
        stores.setups.remove(name);
        return true;
      },
      std::move(done));
}

void SetupService::list(Done<std::vector<NamedSetup>> done) {
  database_.readers().submit(
      [](const store::Stores& stores) -> Result<std::vector<NamedSetup>> {
        std::vector<NamedSetup> setups;
        for (store::Setup& setup : stores.setups.list()) {
          setups.push_back(named_setup(std::move(setup)));
        }
        return setups;
      },
      std::move(done));
}

Result<NamedSetup> SetupService::wait_for(const std::string& name) {
  return database_.readers().wait(
      [&name](const store::Stores& stores) { return find(stores, name); });
}

}  // namespace fitgauge::app
