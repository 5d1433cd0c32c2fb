#include "protocol/codegen/render.h"
#include "protocol/codegen/schema.h"

namespace semblante::codegen {

std::vector<GeneratedFile> protocol_files(const std::string& source_folder) {
  const std::string room = source_folder + "/protocol";
  const Json schema = read_json(room + "/schema/messages.json");
  const Json packed = read_json(room + "/schema/packed_tables.json");
  const Json prime = read_json(room + "/schema/text_prime.json");
  return {{"protocol/cpp/generated/packed_tables.h", render_packed_cpp(packed)},
          {"protocol/cpp/generated/text_prime.h", render_text_prime(prime)},
          {"protocol/cpp/generated/messages.h", render_cpp(schema)},
          {"protocol/ts/generated/messages.ts", render_typescript(schema)},
          {"protocol/SPEC.md", render_spec(schema, packed, read_text(room + "/SPEC.md"))}};
}

}  // namespace semblante::codegen
