// Any bytes as JSON: what is refused says why, and what was read has no object with two members of
// one name and is no deeper than the reader says.

#include "base/json/json_value.hpp"
#include "target.hpp"

using namespace fitgauge;

namespace {

void check(const JsonValue& value, int depth) {
  require(depth <= 32);
  std::set<std::string> names;
  for (const auto& [name, member] : value.members) {
    require(names.insert(name).second && value.find(name) == &member);
    check(member, depth + 1);
  }
  for (const JsonValue& item : value.items) check(item, depth + 1);
}

}  // namespace

void take(std::string_view bytes) {
  const auto value = parse_json(bytes);
  if (value) check(*value, 0);
  require(value.has_value() || !value.error().message.empty());
}
