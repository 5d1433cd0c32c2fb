#pragma once

#include <cstddef>
#include <string>

#include "core/performance/performance.h"
#include "protocol/cpp/fap_file.h"
#include "server/http/message.h"

namespace semblante::api {

/// Limit of a .fap file; other bodies have their own limits.
inline constexpr std::size_t max_fap_body_bytes = std::size_t{16} << 20U;

/// Reads the body, from the disk if it is there: bodies that are still arriving take no memory.
std::string text_of_body(const http::Request& request);

/// The performance document of the body. Refuses with 400, 413 or 422, with the JSON pointer.
Performance performance_of_body(const http::Request& request);

/// The .fap file of the body. Refuses with 413 or 422, with the line.
FapFileReading fap_file_of_body(const http::Request& request);

[[noreturn]] void refuse_performance(const Error& error);
[[noreturn]] void refuse_fap_file(const Error& error);

}  // namespace semblante::api
