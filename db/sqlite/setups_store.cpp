#include "store/setups_store.hpp"

#include <fmt/format.h>

#include "sqlite/row_digest.hpp"
#include "sqlite/statement.hpp"

namespace fitgauge::store {
namespace {

using sqlite::Rows;

Setup read_setup(const Rows& rows) {
  require_sound(rows, 4, kSetups);
  return {.name = rows.get<std::string>(0),
          .text = rows.get<std::string>(1),
          .modified_at_ns = rows.get<std::int64_t>(2),
          .caller = rows.get<std::optional<std::string>>(3)};
}

}  // namespace

struct SetupsStore::Statements {
  explicit Statements(sqlite::Connection& c)
      : find(c, fmt::format("SELECT {}, {} FROM setups WHERE name = ?", kSetups.columns,
                            kSetups.is_sound())),
        list(c, fmt::format("SELECT {}, {} FROM setups ORDER BY name", kSetups.columns,
                            kSetups.is_sound())),
        put(c, kSetups.insert("INSERT OR REPLACE")),
        remove(c, "DELETE FROM setups WHERE name = ? RETURNING 1") {}

  sqlite::Statement find;
  sqlite::Statement list;
  sqlite::Statement put;
  sqlite::Statement remove;
};

SetupsStore::SetupsStore(sqlite::Connection& connection)
    : statements_(std::make_unique<Statements>(connection)) {}
SetupsStore::~SetupsStore() = default;

bool SetupsStore::put(const Setup& setup) {
  const bool is_new = !find(setup.name);
  statements_->put.run(setup.name, setup.text, setup.modified_at_ns, setup.caller);
  return is_new;
}

bool SetupsStore::remove(std::string_view name) {
  return statements_->remove.run_counting(name) > 0;
}

std::optional<Setup> SetupsStore::find(std::string_view name) const {
  Rows rows = statements_->find.query(name);
  return rows.next() ? std::optional(read_setup(rows)) : std::nullopt;
}

std::vector<Setup> SetupsStore::list() const {
  std::vector<Setup> setups;
  for (Rows rows = statements_->list.query(); rows.next();) setups.push_back(read_setup(rows));
  return setups;
}

}  // namespace fitgauge::store
