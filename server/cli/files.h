#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

namespace semblante {

/// The whole file, or a CommandFailure that names it: not there, not readable, a folder, over `max_bytes`.
std::vector<std::uint8_t> read_file(const std::string& path, std::size_t max_bytes);

/// Lets `write` fill the file at `path`: first beside it, then renamed over it, so that a failure leaves no half file.
/// "-" is standard output. Throws CommandFailure.
void write_file(const std::string& path, const std::function<void(std::ostream&)>& write);
void write_file(const std::string& path, std::span<const std::uint8_t> bytes);

}  // namespace semblante
