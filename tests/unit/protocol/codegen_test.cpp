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
  EXPECT_EQ(codegen::render_cpp(schema), read(root + "/cpp/generated/messages.h"));
  EXPECT_EQ(codegen::render_typescript(schema), read(root + "/ts/generated/messages.ts"));
  const std::string spec = read(root + "/SPEC.md");
  EXPECT_EQ(codegen::render_spec(schema, spec), spec);
}

}  // namespace
}  // namespace semblante
