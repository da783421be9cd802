#include "http/method.hpp"

#include <array>
#include <cstddef>

namespace fitgauge::http {

namespace {
constexpr std::array<std::string_view, 7> kNames{"GET",    "HEAD",  "POST",   "PUT",
                                                 "DELETE", "PATCH", "OPTIONS"};
}  // namespace

std::string_view name(Method method) {
  const auto index = static_cast<std::size_t>(method);
  return index < kNames.size() ? kNames[index] : std::string_view{};
}

Method method_named(std::string_view name) {
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (kNames[i] == name) return static_cast<Method>(i);
  }
  return Method::Other;
}

}  // namespace fitgauge::http
