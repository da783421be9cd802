#include <doctest/doctest.h>

#include "base/digest.hpp"
#include "proof/note.hpp"

using namespace fitgauge;
using namespace fitgauge::tlog;

namespace {

// The keys and the note of the documentation of golang.org/x/mod/sumdb/note.
constexpr auto kSigner =
    "PRIVATE+KEY+PeterNeumann+c74f20a3+AYEKFALVFGyNhPJEMzD1QIDr+Y7hfZx09iUvxdXHKDFz";
constexpr auto kVerifier = "PeterNeumann+c74f20a3+ARpc2QcUPDhMQegwxbzhKqiBfsVkmqq/LDE4izWy10TW";
constexpr auto kText =
    "If you think cryptography is the answer to your problem,\n"
    "then you don't know what your problem is.\n";
constexpr auto kNote =
    "If you think cryptography is the answer to your problem,\n"
    "then you don't know what your problem is.\n"
    "\n"
    "\xE2\x80\x94 PeterNeumann "
    "x08go/ZJkuBS9UG/"
    "SffcvIAQxVBtiFupLLr8pAcElZInNIuGUgYN1FFYC2pZSNXgKvqfqdngotpRZb6KE6RyyBwJnAM=\n";

}  // namespace

TEST_CASE("the documented note of another implementation is signed and opened") {
  const auto signer = SigningKey::parse(kSigner);
  REQUIRE(signer.has_value());
  CHECK(signer->text() == kSigner);
  CHECK(signer->verifier().text() == kVerifier);
  const SigningKey* keys[]{&*signer};
  CHECK(sign_note(kText, keys) == kNote);

  const auto verifier = VerifierKey::parse(kVerifier);
  REQUIRE(verifier.has_value());
  const auto note = open_note(kNote, {&*verifier, 1});
  REQUIRE(note.has_value());
  CHECK(note->text == kText);
  CHECK(note->signers.size() == 1);
}

TEST_CASE("a note that differs in one byte does not open") {
  const auto verifier = VerifierKey::parse(kVerifier).value();
  const std::string note = kNote;
  for (std::size_t i = 0; i < note.size(); ++i) {
    std::string changed = note;
    changed[i] ^= 1;
    CAPTURE(i);
    CHECK_FALSE(open_note(changed, {&verifier, 1}).has_value());
    CHECK_FALSE(open_note(note.substr(0, i), {&verifier, 1}).has_value());
  }
}

TEST_CASE(
    "a key rotates: signatures of unknown keys are skipped, a wrong one of a known key is not") {
  const SigningKey old_key = SigningKey::make("fitgauge/plant-3/0badcafe");
  const SigningKey new_key = SigningKey::make("fitgauge/plant-3/0badcafe");
  const Checkpoint head{.origin = old_key.verifier().name(), .size = 12, .root = leaf_hash("x")};
  const SigningKey* both[]{&new_key, &old_key};
  const std::string note = sign_note(head.text(), both);
  for (const SigningKey* key : both) {
    const auto opened = open_checkpoint(note, {&key->verifier(), 1});
    REQUIRE(opened.has_value());
    CHECK(*opened == head);
  }
  const SigningKey stranger = SigningKey::make("fitgauge/plant-3/0badcafe");
  CHECK(open_checkpoint(note, {&stranger.verifier(), 1}).error().code == ErrorCode::NoteUnverified);
  CHECK(open_checkpoint(note, {}).error().code == ErrorCode::NoteUnverified);

  // Signed by a known key, but in the name of another log.
  const SigningKey witness = SigningKey::make("witness.example");
  const SigningKey* only[]{&witness};
  CHECK(open_checkpoint(sign_note(head.text(), only), {&witness.verifier(), 1}).error().code ==
        ErrorCode::NoteUnverified);
}

TEST_CASE("keys are read exactly") {
  for (const std::string text :
       {"", "name", "name+", "name+c74f20a3",
        "PeterNeumann+c74f20a4+ARpc2QcUPDhMQegwxbzhKqiBfsVkmqq/LDE4izWy10TW",
        "PeterNeuman+c74f20a3+ARpc2QcUPDhMQegwxbzhKqiBfsVkmqq/LDE4izWy10TW",
        "PeterNeumann+C74F20A3+ARpc2QcUPDhMQegwxbzhKqiBfsVkmqq/LDE4izWy10TW",
        "PeterNeumann+c74f20a3+AhpC2QcUPDhMQegwxbzhKqiBfsVkmqq/LDE4izWy10TW",
        "PeterNeumann+c74f20a3+ARpc2QcUPDhMQegwxbzhKqiBfsVkmqq/LDE4izWy10T",
        "PeterNeumann+c74f20a3+ ARpc2QcUPDhMQegwxbzhKqiBfsVkmqq/LDE4izWy10TW", "++"}) {
    CAPTURE(text);
    CHECK_FALSE(VerifierKey::parse(text).has_value());
    CHECK_FALSE(SigningKey::parse(text).has_value());
    CHECK_FALSE(SigningKey::parse("PRIVATE+KEY+" + text).has_value());
  }
  for (const char* name : {"", "a b", "a+b", "a\nb", "\xff"}) CHECK_FALSE(is_key_name(name));
}

TEST_CASE("checkpoints are read exactly") {
  const std::string root = to_base64(leaf_hash("x"));
  CHECK(parse_checkpoint("log\n7\n" + root + "\n").has_value());
  CHECK(parse_checkpoint("log\n7\n" + root + "\nan extension\n").has_value());
  for (const std::string& text :
       {std::string(), std::string("log\n"), "log\n7\n" + root, "\n7\n" + root + "\n",
        "log\n07\n" + root + "\n", "log\n-7\n" + root + "\n", "log\n7 \n" + root + "\n",
        "log\n18446744073709551616\n" + root + "\n", "log\n7\n" + root.substr(4) + "\n",
        "log\n7\n" + root.substr(0, 43) + "\n"}) {
    CAPTURE(text);
    CHECK_FALSE(parse_checkpoint(text).has_value());
  }
}

// The examples of RFC 4648, section 10.
TEST_CASE("base64 has one spelling") {
  const std::pair<std::string, std::string> cases[]{
      {"", ""},        {"f", "Zg=="},        {"fo", "Zm8="},
      {"foo", "Zm9v"}, {"foob", "Zm9vYg=="}, {"foobar", "Zm9vYmFy"}};
  for (const auto& [plain, text] : cases) {
    const std::vector<std::uint8_t> bytes(plain.begin(), plain.end());
    CHECK(to_base64(bytes) == text);
    CHECK(from_base64(text) == bytes);
  }
  for (const char* text : {"Zg", "Zg=", "Zh==", "Zg==\n", " Zg=", "Zm9v=", "====", "Zm9-"}) {
    CHECK_FALSE(from_base64(text));
  }
}
