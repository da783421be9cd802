#include "http/engine/request_head.hpp"

#include <utility>

#include "base/text.hpp"

namespace fitgauge::http {

namespace {
constexpr std::size_t kKeptFields = 32;
}

std::optional<std::string_view> RequestHead::find(std::string_view name) const {
  for (const HeaderField& field : fields) {
    if (ascii_iequals(field.name, name)) return field.value;
  }
  return std::nullopt;
}

std::optional<std::string> RequestHead::find_list(std::string_view name) const {
  std::optional<std::string> joined;
  for (const HeaderField& field : fields) {
    if (!ascii_iequals(field.name, name)) continue;
    if (joined) {
      joined->append(", ").append(field.value);
    } else {
      joined.emplace(field.value);
    }
  }
  return joined;
}

void RequestHead::clear() {
  std::vector<HeaderField> kept = std::move(fields);
  kept.clear();
  if (kept.capacity() > kKeptFields) kept = {};
  *this = RequestHead{};
  fields = std::move(kept);
}

void RequestHead::rebase(const char* from, const char* to) {
  const auto move = [&](std::string_view& view) {
    if (view.data() != nullptr) view = {to + (view.data() - from), view.size()};
  };
  move(method);
  move(target);
  move(host);
  for (HeaderField& field : fields) {
    move(field.name);
    move(field.value);
  }
}

}  // namespace fitgauge::http
