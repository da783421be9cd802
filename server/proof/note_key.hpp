#pragma once

struct evp_pkey_st;

namespace fitgauge::tlog {

/// An Ed25519 public key with the name it signs under (C2SP signed-note).
class VerifierKey {
 public:
  using Bytes = std::array<std::uint8_t, 32>;
  using Signature = std::array<std::uint8_t, 64>;

  /// @pre is_key_name(name).
  VerifierKey(std::string name, const Bytes& key);

  /// Reads a vkey: `name+hash+base64(0x01 || key)`.
  /// @errors KeyMalformed, also if the hash does not match name and key.
  static Result<VerifierKey> parse(std::string_view vkey);

  const std::string& name() const { return name_; }
  /// Returns this key under another name. @pre is_key_name(name).
  VerifierKey named(std::string name) const { return {std::move(name), key_}; }
  /// The first four bytes of SHA-256(name || "\n" || 0x01 || key), big-endian.
  std::uint32_t id() const { return id_; }
  /// The vkey that parse() reads.
  std::string text() const;

  bool verifies(std::string_view message, const Signature& signature) const;

  friend bool operator==(const VerifierKey&, const VerifierKey&) = default;

 private:
  std::string name_;
  Bytes key_;
  std::uint32_t id_;
};

/// The Ed25519 key that signs. Thread-safe.
class SigningKey {
 public:
  using Seed = std::array<std::uint8_t, 32>;

  /// @pre is_key_name(name).
  SigningKey(std::string name, const Seed& seed);

  /// A new key from the system's random numbers.
  static SigningKey make(std::string name);

  /// Reads `PRIVATE+KEY+name+hash+base64(0x01 || seed)`, the form golang.org/x/mod/sumdb/note
  /// keeps.
  /// @errors KeyMalformed.
  static Result<SigningKey> parse(std::string_view text);

  /// The text for parse(). Secret.
  std::string text() const;

  const VerifierKey& verifier() const { return verifier_; }
  /// Returns this key under another name. @pre is_key_name(name).
  SigningKey named(std::string name) const { return {std::move(name), seed_, key_}; }
  VerifierKey::Signature sign(std::string_view message) const;

 private:
  SigningKey(std::string name, const Seed& seed, std::shared_ptr<evp_pkey_st> key);

  Seed seed_;
  std::shared_ptr<evp_pkey_st> key_;  ///< of the seed, which takes long to make
  VerifierKey verifier_;
};

/// 1 to 255 visible characters of UTF-8, none of them a blank or `+`.
bool is_key_name(std::string_view name);

}  // namespace fitgauge::tlog
