#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/codegen/render.h"

namespace semblante {
namespace {

TEST(ProtocolCodegen, CommittedFiles_AreWhatTheSchemaGives) {
  EXPECT_THAT(codegen::out_of_date(SEMBLANTE_SOURCE_DIR, codegen::protocol_files), ::testing::IsEmpty())
      << "run: ninja -C build semblante-generate-protocol";
}

}  // namespace
}  // namespace semblante
