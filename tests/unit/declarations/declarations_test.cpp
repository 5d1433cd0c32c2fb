#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clients/runtime/codegen/declaration_files.h"

namespace semblante::codegen {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* header = R"(
#define SEMBLANTE_COUNT 4u /* of parts */
/* Two
 * lines. */
typedef struct semblante_part {
  uint8_t first, second; /* a; b */
  double time;
} semblante_part;
typedef struct semblante_handle semblante_handle;
typedef struct semblante_two_parts {
  uint32_t size;
  const char* name;
  semblante_part parts[SEMBLANTE_COUNT + 1][SEMBLANTE_COUNT * 3];
} semblante_two_parts;
)";

TEST(Declarations, CommittedFiles_AreThoseOfTheHeaders) {
  EXPECT_THAT(out_of_date(SEMBLANTE_SOURCE_DIR, declaration_files), IsEmpty())
      << "run: ninja -C build semblante-generate-declarations";
}

TEST(Declarations, StructsOfAHeader_AreRead) {
  const std::vector<CStruct> structs = read_c_structs(header);
  ASSERT_EQ(structs.size(), 2U);
  EXPECT_EQ(structs[0].name, "semblante_part");
  EXPECT_EQ(structs[0].doc, "Two lines.");
  ASSERT_EQ(structs[0].members.size(), 3U);
  EXPECT_EQ(structs[0].members[1].name, "second");
  EXPECT_EQ(structs[0].members[1].type, "uint8_t");
  ASSERT_EQ(structs[1].members.size(), 3U);
  EXPECT_EQ(structs[1].doc, "");
  EXPECT_TRUE(structs[1].members[1].pointer);
  EXPECT_THAT(structs[1].members[2].lengths, ElementsAre(5, 12));
}

TEST(Declarations, WhatIsNotUnderstood_IsNamed) {
  const auto fault = [](const std::string& member) -> std::string {
    try {
      static_cast<void>(
          render_layouts(read_c_structs("typedef struct semblante_x {\n  " + member + "\n} semblante_x;")));
    } catch (const std::exception& thrown) {
      return thrown.what();
    }
    return "nothing";
  };
  EXPECT_THAT(fault("uint32_t size : 3;"), HasSubstr("semblante_x: not understood: uint32_t size : 3"));
  EXPECT_THAT(fault("float places[SEMBLANTE_UNKNOWN];"), HasSubstr("unknown length: SEMBLANTE_UNKNOWN"));
  EXPECT_THAT(fault("void (*call)(int);"), HasSubstr("not understood"));
  EXPECT_THAT(fault("int64_t time;"), HasSubstr("unknown type int64_t"));
}

TEST(Declarations, Layouts_HaveTheAlignmentOfWebAssembly) {
  const std::string text = render_layouts(read_c_structs(header));
  EXPECT_THAT(text, HasSubstr("partLayout = {\n  first: 0,\n  second: 1,\n  time: 8,\n  bytes: 16,\n}"));
  EXPECT_THAT(text, HasSubstr("twoPartsLayout = {\n  size: 0,\n  name: 4,\n  parts: 8,\n  bytes: 968,\n}"));
}

TEST(Declarations, Structs_AreClassesOfCtypes) {
  const std::string text = render_structs(read_c_structs(header));
  EXPECT_THAT(text, HasSubstr("class Part(ctypes.Structure):\n    \"\"\"Two lines.\"\"\"\n"));
  EXPECT_THAT(text, HasSubstr("class TwoParts(Sized):\n"));
  EXPECT_THAT(text, HasSubstr("(\"name\", c_char_p)"));
  EXPECT_THAT(text, HasSubstr("(\"parts\", Part * 12 * 5)"));
}

}  // namespace
}  // namespace semblante::codegen
