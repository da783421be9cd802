// Any bytes as JSON: what is refused says why, and what was read has no object with two members of
// one name and is no deeper than the reader says.

#include "base/json/json_value.hpp"

using namespace fitgauge;

namespace {

void check(const JsonValue& value, int depth) {
  if (depth > 32) std::abort();
  std::set<std::string> names;
  for (const auto& [name, member] : value.members) {
    if (!names.insert(name).second || value.find(name) != &member) std::abort();
    check(member, depth + 1);
  }
  for (const JsonValue& item : value.items) check(item, depth + 1);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto value = parse_json({reinterpret_cast<const char*>(data), size});
  if (value) {
    check(*value, 0);
  } else if (value.error().message.empty()) {
    std::abort();
  }
  return 0;
}
