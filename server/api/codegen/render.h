#pragma once

#include <string>

#include "server/api/codegen/api_document.h"

/// The generated files, each from the whole document. All throw std::runtime_error for constructs that they do not
/// support.
namespace semblante::codegen {

std::string render_handlers(const Json& document);
std::string render_route_table(const Json& document);
std::string render_answers_header(const Json& document);
std::string render_answers_source(const Json& document);
std::string render_body_members(const Json& document);
/// `text`: the document byte for byte.
std::string render_document(const std::string& text);

}  // namespace semblante::codegen
