#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace semblante::access {

/// The text of a token: "smb_<id>_<secret>". The id is public and finds the record; the secret has 256 random bits.
struct TokenText {
  std::string id, secret;
};

/// nullopt for any other text.
std::optional<TokenText> parse_token(std::string_view text);
std::string to_text(const TokenText& token);

/// 256 random bits in base64url (43 characters). Throws std::runtime_error when the system has none.
std::string random_secret();

/// What is stored of a secret: scrypt with its parameters and a random salt, "scrypt$1024$8$1$<salt>$<key>" in
/// hexadecimal digits. Throws std::runtime_error when OpenSSL fails.
std::string hash_secret(std::string_view secret);
/// Compares in constant time. False for a hash of another form. About 2 ms.
bool matches_hash(std::string_view secret, std::string_view hash);

/// A key of the process, so that digests of accepted tokens in memory cannot be prepared elsewhere.
class DigestKey {
 public:
  DigestKey();
  /// HMAC-SHA-256, 32 bytes. Some microseconds.
  [[nodiscard]] std::string digest(std::string_view text) const;

 private:
  std::string key_;
};

/// In a time that depends on the lengths only.
bool equal_in_constant_time(std::string_view a, std::string_view b);

}  // namespace semblante::access
