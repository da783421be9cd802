#include "base/base64.hpp"

#include <openssl/evp.h>

#include <algorithm>

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
  // libcrypto skips blanks and takes padding and spare bits as they come.
  if (to_base64(bytes) != text) return {};
  return bytes;
}

}  // namespace fitgauge::tlog
