#include "server/package/sha256.h"

#include <cassert>

#include <openssl/evp.h>

namespace semblante {

Sha256 sha256(std::span<const std::uint8_t> bytes) {
  Sha256 hash{};
  unsigned length = 0;
  // Cannot fail on memory it is given: the only errors are a missing algorithm or no heap, both ours.
  [[maybe_unused]] const int ok = EVP_Digest(bytes.data(), bytes.size(), hash.data(), &length, EVP_sha256(), nullptr);
  assert(ok == 1 && length == hash.size());
  return hash;
}

}  // namespace semblante
