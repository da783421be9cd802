#include "proof/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "base/digest.hpp"

namespace fitgauge::tlog {
namespace {

Error bad_checkpoint(std::string_view what) {
  return {ErrorCode::NoteMalformed, fmt::format("This is no checkpoint: {}", what)};
}

/// The next line of `text` without its newline, taken off its front.
std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

}  // namespace

std::string Checkpoint::text() const {
  return fmt::format("{}\n{}\n{}\n", origin, size, to_base64(root));
}

Result<Checkpoint> parse_checkpoint(std::string_view text) {
  if (!text.ends_with('\n')) return bad_checkpoint("its last line is cut");
  Checkpoint read{.origin = std::string(take_line(text))};
  if (read.origin.empty()) return bad_checkpoint("its first line names no log");
  const std::string_view size = take_line(text);
  const auto parsed = std::from_chars(size.data(), size.data() + size.size(), read.size);
  if (parsed.ec != std::errc{} || size != std::to_string(read.size)) {
    return bad_checkpoint("its second line is not the size of the tree");
  }
  const auto root = from_base64(take_line(text));
  if (!root || root->size() != read.root.size()) {
    return bad_checkpoint("its third line is not the root of the tree");
  }
  std::copy(root->begin(), root->end(), read.root.begin());
  return read;
}

Result<Checkpoint> open_checkpoint(std::string_view note, std::span<const VerifierKey> keys) {
  auto opened = open_note(note, keys);
  if (!opened) return opened.error();
  auto checkpoint = parse_checkpoint(opened->text);
  if (!checkpoint) return checkpoint;
  const bool own =
      std::any_of(opened->signers.begin(), opened->signers.end(),
                  [&](const VerifierKey* key) { return key->name() == checkpoint->origin; });
  if (!own) {
    return Error{ErrorCode::NoteUnverified,
                 fmt::format("No key of {} signed the checkpoint", checkpoint->origin)};
  }
  return checkpoint;
}

}  // namespace fitgauge::tlog
