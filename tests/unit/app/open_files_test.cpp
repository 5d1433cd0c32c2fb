#include "server/app/open_files.h"

#include <gtest/gtest.h>

namespace semblante {
namespace {

TEST(OpenFiles, ConnectionsAndTheirFiles_FitInWhatTheProcessMayOpen) {
  for (const std::uint64_t may_open : {1, 2, 3, 10, 256, 1024, 1025, 4096, 20'000, 100'000, 1'048'576})
    for (const std::uint64_t wanted : {0, 1, 100, 5000, 1'000'000}) {
      const auto [connections, bodies] = divide_open_files(may_open, wanted);
      EXPECT_GE(connections, 1U);
      EXPECT_GE(bodies, 1U);
      if (wanted > 0) {
        EXPECT_LE(connections, wanted);
      }
      if (may_open > 1024) {
        EXPECT_LE(connections + bodies + 512U, may_open) << may_open << " " << wanted;
      } else if (may_open >= 4) {
        EXPECT_LE(connections + bodies, may_open / 2) << may_open << " " << wanted;
      }
    }
}

TEST(OpenFiles, MostAreConnections_UnlessFewerAreWanted) {
  EXPECT_EQ(divide_open_files(20'000, 0).connections, 14'616U);
  EXPECT_EQ(divide_open_files(20'000, 0).bodies, 4872U);
  EXPECT_EQ(divide_open_files(1'048'576, 0).connections, 65'536U);
  EXPECT_EQ(divide_open_files(1'048'576, 0).bodies, 65'536U);
  EXPECT_EQ(divide_open_files(12'000, 30'000).connections, 11'232U) << "all that can be, if more are wanted";
  EXPECT_EQ(divide_open_files(12'000, 30'000).bodies, 256U);
  EXPECT_EQ(divide_open_files(1024, 100).connections, 100U);
  EXPECT_EQ(divide_open_files(1024, 100).bodies, 100U) << "one for each connection is enough";
}

}  // namespace
}  // namespace semblante
