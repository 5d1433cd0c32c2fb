#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

namespace semblante {

/// The whole file. Throws CommandFailure with its name: missing, not readable, a folder, over `max_bytes`.
std::vector<std::uint8_t> read_file(const std::string& path, std::size_t max_bytes);

/// Writes the file at `path` with `write`: first beside it, then renamed over it, so that a failure leaves no partial
/// file. "-" is standard output. Throws CommandFailure.
void write_file(const std::string& path, const std::function<void(std::ostream&)>& write);
void write_file(const std::string& path, std::span<const std::uint8_t> bytes);

}  // namespace semblante
