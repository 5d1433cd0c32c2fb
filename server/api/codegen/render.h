#pragma once

#include <string>
#include <vector>

#include "server/api/codegen/api_document.h"

/// The generated files, each from the whole document. All throw std::runtime_error for constructs that they do not
/// support.
namespace semblante::codegen {

std::string render_handlers(const Json& document);
std::string render_route_table(const Json& document);
std::string render_answers_header(const Json& document);
std::string render_answers_source(const Json& document);
std::string render_body_members(const Json& document);
/// server/access/SCOPES.md.
std::string render_scopes(const Json& document);

/// A file that the server sends.
struct EmbeddedDocument {
  std::string function;  ///< of server/api/documents.h, that returns it
  std::string text;      ///< byte for byte
};
std::string render_documents(const std::vector<EmbeddedDocument>& documents);

}  // namespace semblante::codegen
