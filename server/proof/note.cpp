#include "proof/note.hpp"

#include "base/digest.hpp"

namespace fitgauge::tlog {
namespace {

constexpr std::string_view kDash = "\xE2\x80\x94 ";  // an em dash and a blank
constexpr std::size_t kIdBytes = 4;

Error bad_note(std::string_view what) {
  return {ErrorCode::NoteMalformed, fmt::format("not a signed note: {}", what)};
}

bool has_control_character(std::string_view text) {
  return std::ranges::any_of(
      text, [](char c) { return (static_cast<unsigned char>(c) < ' ' && c != '\n'); });
}

struct SignatureLine {
  std::string_view name;
  std::uint32_t id = 0;
  std::vector<std::uint8_t> signature{};
};

Result<SignatureLine> read_signature(std::string_view line) {
  if (!line.starts_with(kDash)) return bad_note("a signature line must begin with an em dash");
  line.remove_prefix(kDash.size());
  const std::size_t blank = line.find(' ');
  if (blank == line.npos) return bad_note("a signature line must have a name and a signature");
  SignatureLine read{.name = line.substr(0, blank)};
  if (!is_key_name(read.name)) return bad_note("a signature line must name a key");
  const auto bytes = from_base64(line.substr(blank + 1));
  if (!bytes || bytes->size() <= kIdBytes) return bad_note("a signature is not base64");
  for (std::size_t i = 0; i < kIdBytes; ++i) read.id = read.id << 8U | (*bytes)[i];
  read.signature.assign(bytes->begin() + kIdBytes, bytes->end());
  return read;
}

bool is_signed(std::string_view text, const SignatureLine& line, const VerifierKey& key) {
  VerifierKey::Signature signature{};
  if (line.signature.size() != signature.size()) return false;
  std::ranges::copy(line.signature, signature.begin());
  return key.verifies(text, signature);
}

Error bad_checkpoint(std::string_view what) {
  return {ErrorCode::NoteMalformed, fmt::format("not a checkpoint: {}", what)};
}

}  // namespace

std::string sign_note(std::string_view text, std::span<const SigningKey* const> keys) {
  std::string note = fmt::format("{}\n", text);
  for (const SigningKey* key : keys) {
    const VerifierKey& verifier = key->verifier();
    std::vector<std::uint8_t> bytes;
    for (unsigned shift = 32; shift != 0; shift -= 8) {
      bytes.push_back(static_cast<std::uint8_t>(verifier.id() >> (shift - 8)));
    }
    const VerifierKey::Signature signature = key->sign(text);
    bytes.insert(bytes.end(), signature.begin(), signature.end());
    note += fmt::format("{}{} {}\n", kDash, verifier.name(), to_base64(bytes));
  }
  return note;
}

Result<Note> open_note(std::string_view note, std::span<const VerifierKey> keys) {
  if (note.size() > kLongestNote) return bad_note("it is longer than a megabyte");
  if (!is_utf8(note) || has_control_character(note)) return bad_note("it is not plain UTF-8");
  const std::size_t split = note.rfind("\n\n");
  if (split == note.npos) return bad_note("a blank line is missing before its signatures");
  Note read{.text = std::string(note.substr(0, split + 1)), .signers = {}};
  std::string_view rest = note.substr(split + 2);
  if (rest.empty() || !rest.ends_with('\n')) return bad_note("its last line is cut");

  for (std::size_t lines = 0; !rest.empty(); ++lines) {
    if (lines == kMostSignatures) return bad_note("it has more than 100 signatures");
    const std::size_t end = rest.find('\n');
    const auto line = TRY(read_signature(rest.substr(0, end)));
    rest.remove_prefix(end + 1);
    const auto key = std::ranges::find_if(keys, [&](const VerifierKey& known) {
      return known.name() == line.name && known.id() == line.id;
    });
    if (key == keys.end() || std::ranges::count(read.signers, &*key) != 0) {
      continue;
    }
    if (!is_signed(read.text, line, *key)) {
      return Error{ErrorCode::NoteUnverified,
                   fmt::format("the signature of {} does not belong to the note", key->name())};
    }
    read.signers.push_back(&*key);
  }
  if (read.signers.empty()) return Error{ErrorCode::NoteUnverified, "no known key signed the note"};
  return read;
}

std::string Checkpoint::text() const {
  return fmt::format("{}\n{}\n{}\n", origin, size, to_base64(root));
}

Result<Checkpoint> parse_checkpoint(std::string_view text) {
  if (!text.ends_with('\n')) return bad_checkpoint("its last line is cut");
  Checkpoint read{.origin = std::string(take_field(text, '\n'))};
  if (read.origin.empty()) return bad_checkpoint("its first line names no log");
  const std::string_view size = take_field(text, '\n');
  const auto parsed = std::from_chars(size.data(), size.data() + size.size(), read.size);
  if (parsed.ec != std::errc{} || size != std::to_string(read.size)) {
    return bad_checkpoint("its second line is not the size of the tree");
  }
  const auto root = from_base64(take_field(text, '\n'));
  if (!root || root->size() != read.root.size()) {
    return bad_checkpoint("its third line is not the root of the tree");
  }
  std::copy(root->begin(), root->end(), read.root.begin());
  return read;
}

Result<Checkpoint> open_checkpoint(std::string_view note, std::span<const VerifierKey> keys) {
  auto opened = TRY(open_note(note, keys));
  auto checkpoint = parse_checkpoint(opened.text);
  if (!checkpoint) return checkpoint;
  const bool own = std::ranges::any_of(
      opened.signers, [&](const VerifierKey* key) { return key->name() == checkpoint->origin; });
  if (!own) {
    return Error{ErrorCode::NoteUnverified,
                 fmt::format("no key of {} signed the checkpoint", checkpoint->origin)};
  }
  return checkpoint;
}

}  // namespace fitgauge::tlog
