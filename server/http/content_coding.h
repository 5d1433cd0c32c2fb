#pragma once

#include <string_view>

#include "server/http/message.h"

namespace semblante::http {

/// Whether an `Accept-Encoding` value takes this coding ("br", "gzip"): by its name, or by "*" if the name is not
/// there, and not with a weight of 0. An empty value takes none.
bool accepts_coding(std::string_view accept_encoding, std::string_view coding);

/// Adds a field name to Vary, unless it is there.
void vary_by(Response& response, std::string_view field);

/// Whether this request gets a compressed form: it takes the coding, and asks for no range, which would be one of the
/// compressed bytes.
bool wants_coding(const Request& request, std::string_view coding);

/// Marks an answer with an ETag as the form of this coding, before apply_conditions(): each form has an ETag of its
/// own.
void mark_coding(Response& response, std::string_view coding);

/// The largest body that gzip_body() compresses, bytes.
inline constexpr std::uint64_t max_gzip_bytes = std::uint64_t{4} * 1024 * 1024;

/// Compresses the body of a 200, a file or bytes. Blocks; not for I/O threads. Throws std::system_error when the file
/// cannot be read.
void gzip_body(Response& response);

}  // namespace semblante::http
