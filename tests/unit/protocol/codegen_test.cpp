#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/codegen/render.h"

namespace semblante {
namespace {

using Json = nlohmann::ordered_json;

TEST(ProtocolCodegen, CommittedFiles_AreWhatTheSchemaGives) {
  EXPECT_THAT(codegen::out_of_date(SEMBLANTE_SOURCE_DIR, codegen::protocol_files), ::testing::IsEmpty())
      << "run: ninja -C build semblante-generate-protocol";
}

TEST(ProtocolCodegen, OptionalReal_IsAppendedByItsType) {
  const auto spec_of = [](bool marked) {
    Json field = {{"name", "share"}, {"type", "optional_real"}, {"min", 0}, {"max", 1}};
    if (marked) field["appended"] = true;
    const Json record = {{"type", 9}, {"wire", "nine"}, {"from", "server"}, {"fields", Json::array({field})}};
    const Json schema = {{"messages", Json::array({record})}, {"structs", Json::array()}};
    return codegen::render_spec(schema, {}, "<!-- generated: messages -->\n<!-- end -->\n");
  };
  EXPECT_THAT(spec_of(false),
              ::testing::HasSubstr("| `share` | appended: nothing, or u8, 0 or 1; if 1, an f64, 0 to 1 |"));
  EXPECT_EQ(spec_of(true), spec_of(false));
}

}  // namespace
}  // namespace semblante
