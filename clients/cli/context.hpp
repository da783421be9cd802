#pragma once

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <string_view>

#include "cli/http_client.hpp"
#include "cli/terminal.hpp"

namespace fitgauge::cli {

/// What every command works with.
struct Context {
  HttpClient& client;
  Terminal out{};                       ///< of standard output
  Terminal err{};                       ///< of standard error
  bool json = false;                    ///< the service's documents instead of text
  std::chrono::seconds retry_budget{};  ///< how long a write may wait for the service

  template <class... Arguments>
  void print(fmt::format_string<Arguments...> format, Arguments&&... arguments) const {
    fmt::print(stdout, format, std::forward<Arguments>(arguments)...);
  }

  /// A document of the service, and a line end.
  void print_document(std::string_view document) const { print("{}\n", document); }

  /// A remark for the one who looks on.
  void note(std::string_view text) const { fmt::print(stderr, "fitgauge: {}\n", text); }
};

}  // namespace fitgauge::cli
