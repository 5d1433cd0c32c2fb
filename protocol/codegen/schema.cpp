#include "protocol/codegen/schema.h"

#include <cctype>

namespace semblante::codegen {

std::string snake_case(const std::string& name) {
  std::string result;
  for (const char c : name) {
    const bool upper = std::isupper(static_cast<unsigned char>(c)) != 0;
    if (upper && !result.empty()) result += '_';
    result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return result;
}

std::string documentation(const Json& field) {
  const std::string unit = text(field, "unit");
  std::string doc = text(field, "doc");
  if (unit.empty()) return doc;
  return doc.empty() ? unit : unit + "; " + doc;
}

}  // namespace semblante::codegen
