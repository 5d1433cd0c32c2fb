#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "protocol/cpp/sha256.h"

namespace semblante {

/// Incremental SHA-256 (FIPS 180-4), for data that does not fit in memory.
class Sha256Stream {
 public:
  Sha256Stream();
  ~Sha256Stream();
  Sha256Stream(const Sha256Stream&) = delete;
  Sha256Stream& operator=(const Sha256Stream&) = delete;
  void update(std::span<const std::uint8_t> bytes);
  /// To be called once, at the end.
  Sha256 finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// SHA-256 of `bytes`: the name of every artefact and stored file.
Sha256 sha256(std::span<const std::uint8_t> bytes);

/// The same of text, as 64 lower-case hexadecimal digits.
std::string sha256_hex(std::string_view text);

/// Whether `text` is 64 lower-case hexadecimal digits and nothing else: safe as a file name.
bool is_sha256_hex(std::string_view text);

}  // namespace semblante
