#include <stdexcept>

#include "server/api/codegen/render.h"

namespace semblante::codegen {

std::string render_documents(const std::vector<EmbeddedDocument>& documents) {
  const std::string delimiter = "document";
  std::string out = generated_notice() + "#include \"server/api/documents.h\"\n\nnamespace semblante::api {\n";
  for (const auto& [function, text] : documents) {
    if (text.find(")" + delimiter + "\"") != std::string::npos)
      throw std::runtime_error("the text of " + function + " has the end of a raw string in it");
    out.append("\nstd::string_view ").append(function).append("() {\n  return R\"").append(delimiter).append("(");
    out.append(text).append(")").append(delimiter).append("\";\n}\n");
  }
  return out + "\n}  // namespace semblante::api\n";
}

}  // namespace semblante::codegen
