#include "protocol/codegen/schema.h"

#include <cctype>
#include <fstream>
#include <stdexcept>

#include "protocol/codegen/render.h"

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

Json read_schema(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  return Json::parse(file);
}

}  // namespace semblante::codegen
