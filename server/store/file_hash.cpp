#include "server/store/file_hash.h"

#include <span>
#include <vector>

#include "protocol/hash/sha256.h"

namespace semblante::store {

std::optional<std::string> hash_of(const Descriptor& file, std::uint64_t& bytes) {
  Sha256Stream hash;
  std::vector<std::uint8_t> piece(1U << 18U);
  while (true) {
    const auto got = ::read(file.get(), piece.data(), piece.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return std::nullopt;
    if (got == 0) return to_hex(hash.finish());
    hash.update(std::span(piece).first(static_cast<std::size_t>(got)));
    bytes += static_cast<std::uint64_t>(got);
  }
}

}  // namespace semblante::store
