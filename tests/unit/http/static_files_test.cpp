#include "server/http/static_files.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace semblante::http {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(StaticFile, Pages_MayRunOnlyTheServersOwnScripts_AndNoPageFramesThem) {
  const std::filesystem::path root = ::testing::TempDir() + "static-file-pages";
  std::filesystem::create_directories(root);
  std::ofstream(root / "index.html") << "<!doctype html>";
  Request request;
  request.method = "GET";
  request.path = "/";
  const auto response = static_file(root, request);
  std::filesystem::remove_all(root);
  EXPECT_EQ(response.status, 200);
  const std::string& policy = response.headers.at("Content-Security-Policy");
  EXPECT_THAT(policy, HasSubstr("script-src 'self' 'wasm-unsafe-eval';"));
  EXPECT_THAT(policy, HasSubstr("frame-ancestors 'none'"));
  EXPECT_THAT(policy, Not(HasSubstr("unsafe-inline")));
  EXPECT_EQ(response.headers.at("Cross-Origin-Opener-Policy"), "same-origin");
}

}  // namespace
}  // namespace semblante::http
