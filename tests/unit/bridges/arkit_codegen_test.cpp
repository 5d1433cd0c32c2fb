#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/bridges/generate/render.h"

namespace semblante {
namespace {

TEST(BridgesCodegen, CommittedFiles_AreWhatTheDataGive) {
  EXPECT_THAT(codegen::out_of_date(SEMBLANTE_SOURCE_DIR, bridges::generated_files), ::testing::IsEmpty())
      << "run: ninja -C build semblante-generate-bridges";
}

}  // namespace
}  // namespace semblante
