#include "proof/note_key.hpp"

#include <openssl/evp.h>
#include <openssl/rand.h>

#include "base/digest.hpp"

namespace fitgauge::tlog {
namespace {

/// The signature type of Ed25519 in signed-note.
constexpr std::uint8_t kEd25519 = 1;
constexpr std::size_t kLongestName = 255;
constexpr std::string_view kPrivate = "PRIVATE+KEY+";

struct FreeKey {
  void operator()(EVP_PKEY* key) const { EVP_PKEY_free(key); }
};
struct FreeContext {
  void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
};
using Key = std::unique_ptr<EVP_PKEY, FreeKey>;
using Context = std::unique_ptr<EVP_MD_CTX, FreeContext>;

void require(bool succeeded) {
  if (!succeeded) throw std::runtime_error("OpenSSL cannot compute Ed25519");
}

Key private_key(const SigningKey::Seed& seed) {
  Key key(EVP_PKEY_new_raw_private_key(EVP_PKEY_ED25519, nullptr, seed.data(), seed.size()));
  require(key != nullptr);
  return key;
}

VerifierKey::Bytes public_key(EVP_PKEY* key) {
  VerifierKey::Bytes bytes{};
  std::size_t size = bytes.size();
  require(EVP_PKEY_get_raw_public_key(key, bytes.data(), &size) == 1);
  return bytes;
}

const unsigned char* bytes_of(std::string_view text) {
  return reinterpret_cast<const unsigned char*>(text.data());
}

std::uint32_t id_of(std::string_view name, const VerifierKey::Bytes& key) {
  constexpr std::array<std::uint8_t, 2> kType{'\n', kEd25519};
  const Digest digest = Sha256().update(name).update(kType).update(key).finish();
  return static_cast<std::uint32_t>(digest[0]) << 24U |
         static_cast<std::uint32_t>(digest[1]) << 16U |
         static_cast<std::uint32_t>(digest[2]) << 8U | static_cast<std::uint32_t>(digest[3]);
}

std::string type_and_key(const std::array<std::uint8_t, 32>& key) {
  std::vector<std::uint8_t> bytes{kEd25519};
  bytes.insert(bytes.end(), key.begin(), key.end());
  return to_base64(bytes);
}

/// `name+hash+base64`, in its parts.
struct KeyText {
  std::string name;
  std::uint32_t id = 0;
  std::array<std::uint8_t, 32> key{};
};

std::optional<KeyText> read_key_text(std::string_view text) {
  const std::size_t first = text.find('+');
  const std::size_t second = text.find('+', first == text.npos ? first : first + 1);
  if (second == text.npos) return {};
  KeyText read{.name = std::string(text.substr(0, first))};
  const std::string_view hash = text.substr(first + 1, second - first - 1);
  const auto parsed = std::from_chars(hash.data(), hash.data() + hash.size(), read.id, 16);
  if (parsed.ec != std::errc{} || hash != fmt::format("{:08x}", read.id)) return {};
  const auto bytes = from_base64(text.substr(second + 1));
  if (!bytes || bytes->size() != read.key.size() + 1 || bytes->front() != kEd25519) return {};
  std::copy(bytes->begin() + 1, bytes->end(), read.key.begin());
  if (!is_key_name(read.name)) return {};
  return read;
}

Error bad_key(std::string_view what) {
  return {ErrorCode::KeyMalformed, fmt::format("{} of a signed note", what)};
}

}  // namespace

bool is_key_name(std::string_view name) {
  return !name.empty() && name.size() <= kLongestName && is_utf8(name) &&
         std::ranges::none_of(name, [](char c) {
           return static_cast<unsigned char>(c) <= ' ' || c == '+' || c == '\x7f';
         });
}

VerifierKey::VerifierKey(std::string name, const Bytes& key)
    : name_(std::move(name)), key_(key), id_(id_of(name_, key)) {
  if (!is_key_name(name_)) throw std::invalid_argument("not a key's name: " + name_);
}

Result<VerifierKey> VerifierKey::parse(std::string_view vkey) {
  const auto read = read_key_text(vkey);
  if (!read) return bad_key("not a verifier key (name+hash+base64)");
  VerifierKey key(read->name, read->key);
  if (key.id() != read->id) return bad_key("the hash does not belong to the verifier key");
  return key;
}

std::string VerifierKey::text() const {
  return fmt::format("{}+{:08x}+{}", name_, id_, type_and_key(key_));
}

bool VerifierKey::verifies(std::string_view message, const Signature& signature) const {
  const Key key(EVP_PKEY_new_raw_public_key(EVP_PKEY_ED25519, nullptr, key_.data(), key_.size()));
  const Context context(EVP_MD_CTX_new());
  if (key == nullptr) return false;
  require(context != nullptr &&
          EVP_DigestVerifyInit(context.get(), nullptr, nullptr, nullptr, key.get()) == 1);
  return EVP_DigestVerify(context.get(), signature.data(), signature.size(), bytes_of(message),
                          message.size()) == 1;
}

SigningKey::SigningKey(std::string name, const Seed& seed)
    : SigningKey(std::move(name), seed, private_key(seed)) {}
SigningKey::SigningKey(std::string name, const Seed& seed, std::shared_ptr<evp_pkey_st> key)
    : seed_(seed), key_(std::move(key)), verifier_(std::move(name), public_key(key_.get())) {}

SigningKey SigningKey::make(std::string name) {
  Seed seed{};
  require(RAND_priv_bytes(seed.data(), static_cast<int>(seed.size())) == 1);
  return {std::move(name), seed};
}

Result<SigningKey> SigningKey::parse(std::string_view text) {
  if (!text.starts_with(kPrivate)) return bad_key("not a signing key (PRIVATE+KEY+…)");
  const auto read = read_key_text(text.substr(kPrivate.size()));
  if (!read) return bad_key("not a signing key (PRIVATE+KEY+name+hash+base64)");
  SigningKey key(read->name, read->key);
  if (key.verifier().id() != read->id) {
    return bad_key("the hash does not belong to the signing key");
  }
  return key;
}

std::string SigningKey::text() const {
  return fmt::format("{}{}+{:08x}+{}", kPrivate, verifier_.name(), verifier_.id(),
                     type_and_key(seed_));
}

VerifierKey::Signature SigningKey::sign(std::string_view message) const {
  const Context context(EVP_MD_CTX_new());
  VerifierKey::Signature signature{};
  std::size_t size = signature.size();
  require(context != nullptr &&
          EVP_DigestSignInit(context.get(), nullptr, nullptr, nullptr, key_.get()) == 1 &&
          EVP_DigestSign(context.get(), signature.data(), &size, bytes_of(message),
                         message.size()) == 1);
  return signature;
}

}  // namespace fitgauge::tlog
