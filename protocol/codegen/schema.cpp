#include "protocol/codegen/schema.h"

namespace semblante::codegen {

std::string documentation(const Json& field) {
  const std::string unit = text(field, "unit");
  std::string doc = text(field, "doc");
  if (unit.empty()) return doc;
  return doc.empty() ? unit : unit + "; " + doc;
}

}  // namespace semblante::codegen
