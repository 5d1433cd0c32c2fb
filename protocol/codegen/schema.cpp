#include "protocol/codegen/schema.h"

namespace semblante::codegen {

std::string documentation(const Json& field) {
  const std::string unit = text(field, "unit");
  std::string doc = text(field, "doc");
  if (unit.empty()) return doc;
  return doc.empty() ? unit : unit + "; " + doc;
}

std::string numbers(const Json& values, const std::string& indent) {
  std::string out;
  std::size_t i = 0;
  for (const Json& value : values) {
    out += (i % 20 == 0 ? (i == 0 ? "" : ",\n") + indent : ", ") + value.dump();
    ++i;
  }
  return out;
}

}  // namespace semblante::codegen
