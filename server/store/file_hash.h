#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "server/store/descriptor.h"

namespace semblante::store {

/// The SHA-256 of a file from where it is read to its end, as 64 hexadecimal digits; adds the number of bytes to
/// `bytes`. nullopt with errno when it cannot be read.
std::optional<std::string> hash_of(const Descriptor& file, std::uint64_t& bytes);

}  // namespace semblante::store
