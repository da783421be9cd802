// Bytes as a signed checkpoint, as keys and as the path of a tile: what is accepted prints as it
// was read.

#include "../support/tile_path.hpp"
#include "proof/note.hpp"
#include "target.hpp"

using namespace fitgauge::tlog;

void take(std::string_view text) {
  static const VerifierKey key =
      VerifierKey::parse("PeterNeumann+c74f20a3+ARpc2QcUPDhMQegwxbzhKqiBfsVkmqq/LDE4izWy10TW")
          .value();
  if (const auto note = open_note(text, {&key, 1})) require(text.starts_with(note->text));
  if (const auto head = parse_checkpoint(text)) require(text.starts_with(head->text()));
  if (const auto verifier = VerifierKey::parse(text)) require(verifier->text() == text);
  if (const auto signer = SigningKey::parse(text)) require(signer->text() == text);
  if (const auto tile = parse_tile(text)) require(tile_path(*tile) == text);
}
