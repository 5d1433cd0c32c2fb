#include "server/http/multipart.h"

#include "core/types/letter_case.h"
#include "server/http/media_type.h"
#include "server/http/message.h"

namespace semblante::http {
namespace {

constexpr std::size_t max_part_header_bytes = 8192;

Error malformed(std::string message) { return {ErrorCode::malformed, "", std::move(message)}; }

/// The header block of a part: lines ended by CRLF.
void read_headers(std::string_view block, FormPart& part) {
  while (!block.empty()) {
    const auto end = block.find("\r\n");
    const auto line = block.substr(0, end);
    block = end == std::string_view::npos ? std::string_view{} : block.substr(end + 2);
    const auto colon = line.find(':');
    if (colon == std::string_view::npos) continue;
    const auto name = line.substr(0, colon);
    auto value = line.substr(colon + 1);
    while (!value.empty() && value.front() == ' ') value.remove_prefix(1);
    if (equal_ignoring_case(name, "Content-Disposition")) {
      part.name = parameter(value, "name");
      part.file_name = file_name_of(value);
    } else if (equal_ignoring_case(name, "Content-Type")) {
      part.content_type = std::string(value);
    }
  }
}

}  // namespace

Result<std::vector<FormPart>> parse_multipart(std::string_view body, std::string_view boundary, std::size_t max_parts) {
  if (boundary.empty() || boundary.size() > 70) return malformed("the Content-Type has no usable boundary");
  const std::string opening = "--" + std::string(boundary);
  const std::string delimiter = "\r\n" + opening;

  // The first delimiter may be at the beginning, without a line break before it.
  std::size_t at = 0;
  if (body.substr(0, opening.size()) == opening) {
    at = opening.size();
  } else {
    const auto found = body.find(delimiter);
    if (found == std::string_view::npos) return malformed("the body does not hold the boundary of its Content-Type");
    at = found + delimiter.size();
  }

  std::vector<FormPart> parts;
  while (true) {
    if (body.substr(at, 2) == "--") return parts;
    while (at < body.size() && (body[at] == ' ' || body[at] == '\t')) ++at;
    if (body.substr(at, 2) != "\r\n") return malformed("a boundary is not followed by a line break");
    if (parts.size() == max_parts) return Error{ErrorCode::too_large, "", "the form has more parts than are read"};
    at += 2;
    FormPart part;
    if (body.substr(at, 2) == "\r\n") {
      at += 2;
    } else {
      const auto end = body.substr(at, max_part_header_bytes).find("\r\n\r\n");
      if (end == std::string_view::npos) return malformed("the header of a part does not end");
      read_headers(body.substr(at, end), part);
      at += end + 4;
    }
    // The line break before the delimiter may be the one that ended the header (an empty part).
    const auto end = body.find(delimiter, at >= 2 ? at - 2 : at);
    if (end == std::string_view::npos) return malformed("the last part is not closed by the boundary");
    part.content = end < at ? std::string_view{} : body.substr(at, end - at);
    parts.push_back(std::move(part));
    at = end + delimiter.size();
  }
}

}  // namespace semblante::http
