#include <doctest/doctest.h>

#include "fixture.hpp"

using namespace fitgauge;
using namespace fitgauge::store;
using namespace fitgauge::store::test;

namespace {

std::vector<std::int64_t> listed_changes(Fixture& fixture, const ChangeFilter& filter,
                                         std::int64_t after, std::int64_t limit, bool has_more) {
  return fixture.see([&](const Stores& stores) {
    const auto page = stores.changes.list(filter, after, limit);
    CHECK(page.has_more == has_more);
    std::vector<std::int64_t> ids;
    for (const Change& change : page.changes) ids.push_back(change.id);
    return ids;
  });
}

}  // namespace

TEST_CASE("changes are listed by kind, name and time, in pages") {
  using Ids = std::vector<std::int64_t>;
  Fixture fixture;
  fixture.change([](Stores& stores) {
    CHECK(stores.changes.size() == 0);
    for (std::int64_t id = 1; id <= 5; ++id) {
      stores.changes.append({.id = id,
                             .at_ns = 10 * id,
                             .kind = id % 2 == 0 ? "plan" : "gauge",
                             .name = id == 5 ? "B" : "A",
                             .action = "created",
                             .after = "{}"},
                            sha256(std::to_string(id)));
    }
  });
  CHECK(listed_changes(fixture, {}, 0, 5, false) == Ids{1, 2, 3, 4, 5});
  CHECK(listed_changes(fixture, {}, 1, 3, true) == Ids{2, 3, 4});
  CHECK(listed_changes(fixture, {.kind = "gauge"}, 0, 9, false) == Ids{1, 3, 5});
  CHECK(listed_changes(fixture, {.kind = "gauge", .name = "A"}, 1, 9, false) == Ids{3});
  CHECK(listed_changes(fixture, {.name = "none"}, 0, 9, false).empty());
  CHECK(listed_changes(fixture, {.from_ns = 20, .to_ns = 40}, 0, 9, false) == Ids{2, 3});
  std::vector<Digest> leaves;
  Ids gauges;
  fixture.see([&](const Stores& stores) {
    CHECK(stores.changes.of_kind("none").empty());
    for (const Change& change : stores.changes.of_kind("gauge")) gauges.push_back(change.id);
    stores.changes.leaves(3, 2, [&](const Digest& leaf) { leaves.push_back(leaf); });
    return true;
  });
  CHECK(leaves == std::vector<Digest>{sha256("4"), sha256("5")});
  CHECK(gauges == Ids{1, 3, 5});
}

TEST_CASE("a page of long changes ends behind 4 MiB") {
  Fixture fixture;
  fixture.change([](Stores& stores) {
    for (std::int64_t id = 1; id <= 4; ++id) {
      stores.changes.append({.id = id,
                             .kind = "setup",
                             .name = "A",
                             .action = "created",
                             .after = std::string(std::size_t{3} << 20, ' ')},
                            {});
    }
  });
  CHECK(listed_changes(fixture, {}, 0, 9, true).size() == 2);
  CHECK(listed_changes(fixture, {}, 2, 9, false).size() == 2);
}
