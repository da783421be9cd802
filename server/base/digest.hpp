#pragma once

struct evp_md_st;
struct evp_md_ctx_st;

namespace fitgauge {

/// A SHA-256 digest (FIPS 180-4).
using Digest = std::array<std::uint8_t, 32>;

/// Computes SHA-256 digests, any number of them one after the other. Not thread-safe.
class Sha256 {
 public:
  Sha256();
  Sha256& update(std::span<const std::uint8_t> bytes);
  Sha256& update(std::string_view text);

  /// The digest of everything since the last one; the next begins empty.
  Digest finish();

  /// Returns the digest of all data until now; more data may follow.
  Digest so_far() const;

 private:
  struct Free {
    void operator()(evp_md_st* algorithm) const;
    void operator()(evp_md_ctx_st* state) const;
  };

  std::unique_ptr<evp_md_st, Free> algorithm_;
  std::unique_ptr<evp_md_ctx_st, Free> state_;
};

Digest sha256(std::string_view text);

/// Lower-case hexadecimal.
std::string to_hex(std::span<const std::uint8_t> bytes);

/// Compares in a time that depends only on the sizes.
bool equal_in_constant_time(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b);

}  // namespace fitgauge

namespace fitgauge::tlog {

/// RFC 4648, section 4, with padding.
std::string to_base64(std::span<const std::uint8_t> bytes);

/// @returns none except for the spelling that to_base64 gives.
std::optional<std::vector<std::uint8_t>> from_base64(std::string_view text);

}  // namespace fitgauge::tlog
