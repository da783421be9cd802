#include "base/digest.hpp"

#include <openssl/crypto.h>
#include <openssl/evp.h>

namespace fitgauge {
namespace {

void require(bool succeeded) {
  if (!succeeded) throw std::runtime_error("OpenSSL cannot compute SHA-256");
}

}  // namespace

void Sha256::Free::operator()(evp_md_st* algorithm) const { EVP_MD_free(algorithm); }
void Sha256::Free::operator()(evp_md_ctx_st* state) const { EVP_MD_CTX_free(state); }

/// The algorithm is fetched once: a fetch for every digest costs as much as hashing a row.
Sha256::Sha256() : algorithm_(EVP_MD_fetch(nullptr, "SHA256", nullptr)), state_(EVP_MD_CTX_new()) {
  require(algorithm_ != nullptr && state_ != nullptr &&
          EVP_DigestInit_ex2(state_.get(), algorithm_.get(), nullptr) == 1);
}

Sha256& Sha256::update(std::span<const std::uint8_t> bytes) {
  require(EVP_DigestUpdate(state_.get(), bytes.data(), bytes.size()) == 1);
  return *this;
}

Sha256& Sha256::update(std::string_view text) {
  require(EVP_DigestUpdate(state_.get(), text.data(), text.size()) == 1);
  return *this;
}

Digest Sha256::finish() {
  Digest digest;
  require(EVP_DigestFinal_ex(state_.get(), digest.data(), nullptr) == 1 &&
          EVP_DigestInit_ex2(state_.get(), algorithm_.get(), nullptr) == 1);
  return digest;
}

Digest Sha256::so_far() const {
  const Sha256 copy;
  Digest digest;
  require(EVP_MD_CTX_copy_ex(copy.state_.get(), state_.get()) == 1 &&
          EVP_DigestFinal_ex(copy.state_.get(), digest.data(), nullptr) == 1);
  return digest;
}

Digest sha256(std::string_view text) { return Sha256().update(text).finish(); }

std::string to_hex(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string out;
  out.reserve(bytes.size() * 2);
  for (const std::uint8_t byte : bytes) {
    out += kDigits[byte >> 4U];
    out += kDigits[byte & 0xFU];
  }
  return out;
}

bool equal_in_constant_time(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) {
  return a.size() == b.size() && CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0;
}

}  // namespace fitgauge

namespace fitgauge::tlog {

std::string to_base64(std::span<const std::uint8_t> bytes) {
  std::string text((bytes.size() + 2) / 3 * 4 + 1, '\0');
  auto* out = reinterpret_cast<unsigned char*>(text.data());
  const int size = EVP_EncodeBlock(out, bytes.data(), static_cast<int>(bytes.size()));
  text.resize(static_cast<std::size_t>(size));
  return text;
}

std::optional<std::vector<std::uint8_t>> from_base64(std::string_view text) {
  if (text.size() % 4 != 0) return {};
  std::vector<std::uint8_t> bytes(text.size() / 4 * 3);
  const auto* in = reinterpret_cast<const unsigned char*>(text.data());
  const int size = EVP_DecodeBlock(bytes.data(), in, static_cast<int>(text.size()));
  if (size < 0 || static_cast<std::size_t>(size) != bytes.size()) return {};
  const auto padding = text.ends_with("==") ? 2U : text.ends_with("=") ? 1U : 0U;
  bytes.resize(bytes.size() - padding);
  // libcrypto skips blanks and accepts any padding and spare bits.
  if (to_base64(bytes) != text) return {};
  return bytes;
}

}  // namespace fitgauge::tlog
