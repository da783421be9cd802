#include "base/json/applicable.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace fitgauge::api {
namespace {

bool has_word(std::string_view words, std::string_view word) {
  return fmt::format(" {} ", words).find(fmt::format(" {} ", word)) != std::string::npos;
}

}  // namespace

std::string listed(std::string_view words) {
  std::string text;
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t end = std::min(words.find(' ', at), words.size());
    if (at > 0) text += end == words.size() ? " or " : ", ";
    text += words.substr(at, end - at);
    at = end + 1;
  }
  return text;
}

std::optional<std::string> not_applicable(const Applicable& row, std::string_view what,
                                          std::string_view kind) {
  if (has_word(row.kinds, kind)) return std::nullopt;
  return fmt::format("{}{}{} would change nothing with {} {}: it belongs to {} {}", row.member,
                     row.values.empty() ? "" : " ", row.values, what, kind, what,
                     listed(row.kinds));
}

}  // namespace fitgauge::api
