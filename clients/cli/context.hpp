#pragma once

#include <cstdio>

#include "cli/http_client.hpp"

namespace fitgauge::cli {

/// The colours with their codes (ECMA-48, SGR).
enum class Colour { Red = 31, Green = 32, Yellow = 33, Blue = 34, Cyan = 36 };

/// Abilities of a stream.
struct Terminal {
  bool interactive = false;  ///< someone looks at it
  bool unicode = false;      ///< its locale is UTF-8
  bool colour = false;

  /// `text` in a colour, or unchanged without colours.
  std::string painted(std::string_view text, Colour colour) const;

  /// µm, or um if the terminal has no µ.
  std::string_view micrometre() const { return unicode ? "µm" : "um"; }
};

/// The value of an environment variable, empty when it is not set.
using Environment = std::function<std::string(const char* name)>;

std::string environment_variable(const char* name);

/// UTF-8 by LC_ALL, LC_CTYPE or LANG, the first that is set (POSIX, 8.2); colour on a terminal that
/// is not dumb, unless NO_COLOR is set (no-color.org).
Terminal terminal_of(bool interactive, const Environment& environment);

/// The terminal of a file descriptor of this process.
Terminal terminal_of(int descriptor);

/// Progress of a long upload.
struct Progress {
  std::string name;
  std::uint64_t bytes = 0;
  std::optional<std::uint64_t> bytes_in_all{};  ///< none for a pipe
  std::uint64_t rows = 0;                       ///< stored by this run
  double seconds = 0;
};

/// One line of at most 79 columns for an ordinary name: the name, a bar, rows, rows a second.
std::string format_progress(const Progress& progress, const Terminal& terminal);

/// `1234567` as `1,234,567`.
std::string grouped(std::uint64_t number);

/// A line of standard error that is overwritten; nothing without a terminal.
class ProgressLine {
 public:
  explicit ProgressLine(const Terminal& terminal) : terminal_(terminal) {}
  ~ProgressLine() { clear(); }
  ProgressLine& operator=(ProgressLine&&) = delete;  // neither copied nor moved

  void show(const Progress& progress);
  /// Makes room for another text.
  void clear();

 private:
  const Terminal& terminal_;
  bool shown_ = false;
};

/// Objects that every command uses.
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

  /// Prints a remark for the user.
  void note(std::string_view text) const { fmt::print(stderr, "fitgauge: {}\n", text); }
  template <class... Arguments>
  void note(fmt::format_string<Arguments...> format, Arguments&&... arguments) const
      requires(sizeof...(Arguments) > 0) {
    note(fmt::format(format, std::forward<Arguments>(arguments)...));
  }

  /// Prints the warnings of a response, also with --json: scripts show standard error to people.
  void note_warnings(const JsonValue& document) const {
    for (const JsonValue& warning : document.member("warnings").items)
      note("{}", warning.text_of("detail"));
  }

  /// Sends a request once. @errors also those of a response that is no success.
  Outcome<Answer> send(const Request& request) const {
    return expect_ok(client.send(request), client.url());
  }
  /// Sends a request until it is answered, as send_until_answered(), with a remark at each wait.
  /// @errors as send()
  Outcome<Answer> persist(const Request& request) const {
    return expect_ok(send_until_answered(client, request, Backoff(retry_budget),
                                         [this](const Failure& f, auto) { note(f.message); }),
                     client.url());
  }
  /// Posts JSON in the same way, under a new idempotency key.
  Outcome<Answer> post_once(std::string target, std::string body) const {
    return persist({.method = "POST",
                    .target = std::move(target),
                    .headers = {"Idempotency-Key: " + new_idempotency_key()},
                    .content_type = "application/json",
                    .body = std::move(body)});
  }
  /// Returns the document of a response. @errors NoAnswer if it is not JSON.
  Outcome<JsonValue> document_of(const Answer& answer) const {
    return read_document(answer, client.url());
  }
};

/// Prints the response of the service: unchanged with --json, else by `print` with the document.
/// @errors those of the response, and of an unreadable document.
template <class Print>
Outcome<ExitCode> show(const Context& context, const Outcome<Answer>& answer, const Print& print) {
  if (!answer) return answer.error();
  if (context.json) context.print_document(answer->body);
  const auto document = TRY(context.document_of(*answer));
  if (!context.json) print(document);
  return ExitCode::Good;
}

}  // namespace fitgauge::cli
