#include <stdexcept>

#include "server/api/codegen/render.h"

namespace semblante::codegen {

std::string render_document(const std::string& text) {
  const std::string delimiter = "openapi";
  if (text.find(")" + delimiter + "\"") != std::string::npos)
    throw std::runtime_error("openapi.json has the end of a raw string in it");
  return generated_notice() + "#include \"server/api/openapi.h\"\n\nnamespace semblante::api {\n\n" +
         "std::string_view openapi_document() {\n  return R\"" + delimiter + "(" + text + ")" + delimiter +
         "\";\n}\n\n}  // namespace semblante::api\n";
}

}  // namespace semblante::codegen
