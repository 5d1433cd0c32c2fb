#include "server/access/secret.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>
#include <openssl/rand.h>

namespace semblante::access {
namespace {

constexpr std::string_view prefix = "smb_";
constexpr std::size_t secret_bytes = 32;
constexpr std::size_t secret_characters = 43;
constexpr std::size_t longest_id = 32;

// A secret has 256 random bits and cannot be guessed even if the hash is fast. These parameters only have to make a
// stolen database useless for precomputed tables, and to cost little at the first use of a token (1 MiB, about 2 ms).
constexpr std::string_view method = "scrypt$1024$8$1$";
constexpr std::uint64_t scrypt_n = 1024, scrypt_r = 8, scrypt_p = 1, scrypt_memory = 8U << 20U;
constexpr std::size_t salt_bytes = 16, key_bytes = 32;

using Bytes = std::vector<unsigned char>;

Bytes random_bytes(std::size_t count) {
  Bytes bytes(count);
  if (RAND_bytes(bytes.data(), static_cast<int>(count)) != 1)
    throw std::runtime_error("the system has no random numbers");
  return bytes;
}

std::string to_hex(std::span<const unsigned char> bytes) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text;
  for (const auto byte : bytes) {
    text.push_back(digits[byte >> 4U]);
    text.push_back(digits[byte & 15U]);
  }
  return text;
}

std::string stretched(std::string_view secret, std::string_view salt) {
  Bytes key(key_bytes);
  const auto* salt_data = reinterpret_cast<const unsigned char*>(salt.data());
  if (EVP_PBE_scrypt(secret.data(), secret.size(), salt_data, salt.size(), scrypt_n, scrypt_r, scrypt_p, scrypt_memory,
                     key.data(), key.size()) != 1)
    throw std::runtime_error("OpenSSL cannot compute scrypt");
  return to_hex(key);
}

bool is_base64url(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '_';
}

}  // namespace

std::optional<TokenText> parse_token(std::string_view text) {
  if (!text.starts_with(prefix)) return std::nullopt;
  text.remove_prefix(prefix.size());
  const auto end = text.find('_');
  if (end == std::string_view::npos || end == 0 || end > longest_id) return std::nullopt;
  const auto secret = text.substr(end + 1);
  if (secret.size() != secret_characters || !std::all_of(secret.begin(), secret.end(), is_base64url))
    return std::nullopt;
  return TokenText{std::string(text.substr(0, end)), std::string(secret)};
}

std::string to_text(const TokenText& token) { return std::string(prefix) + token.id + "_" + token.secret; }

std::string random_secret() {
  const auto bytes = random_bytes(secret_bytes);
  std::array<unsigned char, 48> text{};
  EVP_EncodeBlock(text.data(), bytes.data(), static_cast<int>(bytes.size()));
  std::string secret(text.begin(), text.begin() + secret_characters);
  std::replace(secret.begin(), secret.end(), '+', '-');
  std::replace(secret.begin(), secret.end(), '/', '_');
  return secret;
}

std::string hash_secret(std::string_view secret) {
  const auto salt = to_hex(random_bytes(salt_bytes));
  return std::string(method) + salt + "$" + stretched(secret, salt);
}

bool matches_hash(std::string_view secret, std::string_view hash) {
  if (!hash.starts_with(method) || hash.size() != method.size() + 2 * salt_bytes + 1 + 2 * key_bytes) return false;
  const auto salt = hash.substr(method.size(), 2 * salt_bytes);
  return equal_in_constant_time(stretched(secret, salt), hash.substr(hash.size() - 2 * key_bytes));
}

DigestKey::DigestKey() {
  const auto bytes = random_bytes(key_bytes);
  key_.assign(bytes.begin(), bytes.end());
}

std::string DigestKey::digest(std::string_view text) const {
  std::array<unsigned char, EVP_MAX_MD_SIZE> out{};
  unsigned length = 0;
  if (HMAC(EVP_sha256(), key_.data(), static_cast<int>(key_.size()),
           reinterpret_cast<const unsigned char*>(text.data()), text.size(), out.data(), &length) == nullptr)
    throw std::runtime_error("OpenSSL cannot compute HMAC-SHA-256");
  return {out.begin(), out.begin() + length};
}

bool equal_in_constant_time(std::string_view a, std::string_view b) {
  return a.size() == b.size() && CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0;
}

}  // namespace semblante::access
