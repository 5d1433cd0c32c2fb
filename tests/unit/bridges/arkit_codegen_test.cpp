#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "core/bridges/generate/render.h"

namespace semblante {
namespace {

const std::string root = SEMBLANTE_SOURCE_DIR;

std::string read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(BridgesCodegen, CommittedFiles_AreWhatTheDataGive) {
  // When this fails: build the target semblante-generate-bridges and commit what it changed.
  const auto data = bridges::read_arkit_data(root + "/core/bridges/data/arkit.json");
  EXPECT_EQ(bridges::render_cpp(data), read(root + "/core/bridges/generated/arkit_tables.h"));
  EXPECT_EQ(bridges::render_typescript(data), read(root + "/protocol/ts/generated/arkit.ts"));
}

}  // namespace
}  // namespace semblante
