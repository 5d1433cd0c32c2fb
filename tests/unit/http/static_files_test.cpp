#include "server/http/static_files.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace semblante::http {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

using std::filesystem::path;

/// A web root with these files, removed at the end.
class WebRoot {
 public:
  explicit WebRoot(const std::string& name) : root_(::testing::TempDir() + "web-root-" + name) {
    std::filesystem::remove_all(root_);
  }
  ~WebRoot() { std::filesystem::remove_all(root_); }
  WebRoot(const WebRoot&) = delete;
  WebRoot& operator=(const WebRoot&) = delete;
  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((root_ / name).parent_path());
    std::ofstream(root_ / name) << text;
  }
  [[nodiscard]] path file(const std::string& name) const { return root_ / name; }
  [[nodiscard]] Response get(const std::string& address, const Headers& headers = {}) const {
    Request request;
    request.method = "GET";
    request.path = address;
    request.headers = headers;
    return static_file(root_, request);
  }

 private:
  path root_;
};

std::string header(const Response& response, const std::string& name) {
  const auto found = response.headers.find(name);
  return found == response.headers.end() ? "" : found->second;
}

TEST(StaticFile, AFolderWithoutItsSlash_IsRedirectedIfItHasAPage) {
  const WebRoot root("folder");
  root.write("view/index.html", "the page");
  root.write("assets/a.js", "no page");
  const auto moved = root.get("/view");
  EXPECT_EQ(moved.status, 308);
  EXPECT_EQ(header(moved, "Location"), "view/");
  EXPECT_EQ(root.get("/view/").status, 200);
  EXPECT_EQ(root.get("/assets").status, 404);
}

TEST(StaticFile, CompressedForm_IsSentToThoseWhoAcceptIt) {
  const WebRoot root("compressed");
  root.write("page.js", "the text itself");
  root.write("page.js.br", "in brotli");
  root.write("page.js.gz", "in gzip..");

  const auto brotli = root.get("/page.js", {{"Accept-Encoding", "gzip, deflate, br"}});
  EXPECT_EQ(header(brotli, "Content-Encoding"), "br");
  EXPECT_EQ(header(brotli, "Content-Type"), "text/javascript; charset=utf-8");
  EXPECT_EQ(header(brotli, "Vary"), "Accept-Encoding");
  EXPECT_EQ(std::get<FileBody>(brotli.body).path.filename(), "page.js.br");
  EXPECT_EQ(brotli.body_size(), 9U);

  EXPECT_EQ(header(root.get("/page.js", {{"Accept-Encoding", "gzip"}}), "Content-Encoding"), "gzip");
  EXPECT_EQ(header(root.get("/page.js", {{"Accept-Encoding", "br;q=0, *"}}), "Content-Encoding"), "gzip");
  for (const auto* refused : {"", "identity", "br;q=0, gzip;q=0.0", "*;q=0", "brotli"}) {
    const auto plain = root.get("/page.js", {{"Accept-Encoding", refused}});
    EXPECT_EQ(header(plain, "Content-Encoding"), "") << refused;
    EXPECT_EQ(header(plain, "Vary"), "Accept-Encoding") << refused;
    EXPECT_EQ(plain.body_size(), 15U);
  }
}

TEST(StaticFile, EachForm_HasItsOwnETag_AndRangesAreOfTheFileItself) {
  const WebRoot root("etags");
  root.write("page.js", "the text itself");
  root.write("page.js.br", "in brotli");
  const auto plain = header(root.get("/page.js"), "ETag");
  const auto brotli = header(root.get("/page.js", {{"Accept-Encoding", "br"}}), "ETag");
  EXPECT_NE(plain, brotli);
  const auto again = root.get("/page.js", {{"Accept-Encoding", "br"}, {"If-None-Match", brotli}});
  EXPECT_EQ(again.status, 304);
  EXPECT_EQ(header(again, "Vary"), "Accept-Encoding");
  EXPECT_EQ(root.get("/page.js", {{"Accept-Encoding", "br"}, {"If-None-Match", plain}}).status, 200);
  const auto part = root.get("/page.js", {{"Accept-Encoding", "br"}, {"Range", "bytes=4-7"}});
  EXPECT_EQ(part.status, 206);
  EXPECT_EQ(header(part, "Content-Encoding"), "");
  EXPECT_EQ(header(part, "Content-Range"), "bytes 4-7/15");
}

TEST(StaticFile, CompressedFormOfAnEarlierFile_IsNotSent) {
  const WebRoot root("stale");
  root.write("page.js", "the text itself");
  root.write("page.js.gz", "old");
  std::filesystem::last_write_time(root.file("page.js.gz"),
                                   std::filesystem::last_write_time(root.file("page.js")) - std::chrono::seconds(1));
  const auto response = root.get("/page.js", {{"Accept-Encoding", "gzip"}});
  EXPECT_EQ(header(response, "Content-Encoding"), "");
  EXPECT_EQ(header(response, "Vary"), "");
}

TEST(StaticFile, PageOfAStream_IsOneFileForAllStreams) {
  const WebRoot root("view");
  root.write("view/index.html", "<!doctype html>");
  root.write("view/worker.js", "self");
  for (const auto* address : {"/view/", "/view/demo", "/view/a-b_9"}) {
    const auto response = root.get(address);
    EXPECT_EQ(response.status, 200) << address;
    EXPECT_EQ(header(response, "Content-Type"), "text/html; charset=utf-8") << address;
  }
  EXPECT_EQ(header(root.get("/view/worker.js"), "Content-Type"), "text/javascript; charset=utf-8");
  for (const auto* address : {"/view/demo/more", "/view/demo.js", "/views/demo", "/view/../secret"})
    EXPECT_EQ(root.get(address).status, 404) << address;
}

TEST(StaticFile, LiesWithin_WhereverItIsNamedFrom_AndBeforeItExists) {
  const WebRoot root("within");
  root.write("page.js", "x");
  for (const std::string inside : {"page.js", "data", "data/key", "a/../data"})
    EXPECT_TRUE(lies_within(root.file(""), root.file(inside))) << inside;
  for (const std::string outside : {"..", "../web-root-within-data", "a/../../data"})
    EXPECT_FALSE(lies_within(root.file(""), root.file(outside))) << outside;
  EXPECT_TRUE(lies_within(std::filesystem::current_path(), "not-there-yet"));
  EXPECT_TRUE(lies_within(".", "not-there-yet"));
  EXPECT_FALSE(lies_within("not-there-yet", "not-there-yet/data"));
}

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
