#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "protocol/codegen/render.h"

namespace semblante {
namespace {

const std::string root = std::string(SEMBLANTE_SOURCE_DIR) + "/protocol";

std::string read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(ProtocolCodegen, Render_CommittedFiles_AreWhatTheSchemaGives) {
  // When this fails: build the target semblante-generate-protocol and commit what it changed.
  const auto schema = codegen::read_schema(root + "/schema/messages.json");
  const auto packed = codegen::read_schema(root + "/schema/packed_tables.json");
  EXPECT_EQ(codegen::render_packed_cpp(packed), read(root + "/cpp/generated/packed_tables.h"));
  EXPECT_EQ(codegen::render_packed_typescript(packed), read(root + "/ts/generated/packed_tables.ts"));
  EXPECT_EQ(codegen::render_cpp(schema), read(root + "/cpp/generated/messages.h"));
  EXPECT_EQ(codegen::render_typescript(schema), read(root + "/ts/generated/messages.ts"));
  const std::string spec = read(root + "/SPEC.md");
  EXPECT_EQ(codegen::render_spec(schema, packed, spec), spec);
}

}  // namespace
}  // namespace semblante
