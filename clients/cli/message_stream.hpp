#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace fitgauge::cli {

/// Reads messages of JSON-RPC as an editor sends them: lines of a header with Content-Length, an
/// empty line, the text. What is none is passed over up to the next header.
class MessageReader {
 public:
  explicit MessageReader(int descriptor) : descriptor_(descriptor) {}

  struct Message {
    std::string text;
    std::string problem;  ///< what is wrong with the header; the text is empty then
  };
  /// Waits for the next one; nothing at the end of the input.
  std::optional<Message> next();
  /// Whether next() has something to begin with at once.
  bool has_more() const;

 private:
  bool fill();
  std::optional<std::string> header_line();

  const int descriptor_;
  std::string buffer_;
  std::size_t at_ = 0;
  bool is_lost_ = false;  ///< behind a wrong header: looks for the next one
};

/// Writes one to standard output.
void send_message(std::string_view text);

}  // namespace fitgauge::cli
