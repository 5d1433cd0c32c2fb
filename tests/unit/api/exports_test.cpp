// Exports of recordings: the number that runs at the same time, and the disk space that they leave free.
#include <cstdlib>
#include <fstream>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/api/api.h"
#include "server/api/export_file.h"
#include "server/store/sqlite_store.h"
#include "tests/support/api_exchange.h"

namespace semblante::api {
namespace {

using ::testing::HasSubstr;

class ExportsTest : public ::testing::Test {
 protected:
  ExportsTest() {
    std::string name = (std::filesystem::temp_directory_path() / "semblante-exports-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~ExportsTest() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
};

TEST_F(ExportsTest, Slot_IsTakenUntilItIsReset) {
  ExportSlots slots(2);
  auto first = slots.take();
  const auto second = slots.take();
  EXPECT_TRUE(first);
  EXPECT_TRUE(second);
  EXPECT_FALSE(slots.take());
  first.reset();
  EXPECT_TRUE(slots.take());
}

TEST_F(ExportsTest, BeyondTheLimit_429_WithATimeToRetry) {
  const std::shared_ptr<store::Store> store = *store::open_sqlite_store(folder_ / "facts.sqlite");
  auto blobs = store::BlobStore::open(folder_);
  store::PendingWrites pending{{}};
  jobs::JobQueue jobs({*store, *store, *store}, blobs, pending, {});
  streams::InProcessHub hub;
  recordings::RecorderLimits limits;
  limits.disk_reserve = 0;
  const auto recorder = recordings::Recorder::open(*store, *store, pending, folder_ / "recordings", limits);
  const auto slots = std::make_shared<ExportSlots>(1);
  Context context{*store, blobs, pending, jobs, hub, {}, {}, recorder};
  context.exports = slots;
  Api api(context);
  const auto handle = [&](const std::string& method, const std::string& path, const std::string& format) {
    http::Request request;
    request.method = method;
    request.path = path;
    if (!format.empty()) request.query = {{"format", format}};
    if (method == "POST") request.body = R"({"name":"talk"})";
    api.find_route(request);
    return api.handle(request);
  };
  ASSERT_EQ(handle("POST", "/v1/streams", "").status, 201);
  const auto made = handle("POST", "/v1/streams/talk/recordings", "");
  ASSERT_EQ(made.status, 201);
  const auto content = made.headers.at("Location") + "/content";
  recorder->close();  // ends it

  auto other = slots->take();
  for (const char* const format : {"performance", "fap", "arkit-csv", "frames-json", "glb"}) {
    const auto refused = handle("GET", content, format);
    EXPECT_EQ(refused.status, 429) << format;
    EXPECT_EQ(refused.headers.at("Retry-After"), "2") << format;
    EXPECT_THAT(std::get<std::string>(refused.body), HasSubstr("as many exports")) << format;
  }
  EXPECT_EQ(handle("GET", content, "recording").status, 200) << "the file as it is takes no time";
  other.reset();
  for (int round = 0; round < 2; ++round)
    EXPECT_EQ(handle("GET", content, "fap").status, 409) << "it has no frame; a refusal gives its slot back";
}

TEST_F(ExportsTest, File_IsWhole_AndGoneWithItsBody) {
  std::string text;
  while (text.size() < (3U << 20U)) text += std::to_string(text.size()) + "\n";
  {
    ExportFile file(folder_, 0);
    for (std::size_t at = 0; at < text.size(); at += 1000) file.stream() << text.substr(at, 1000);
    const auto body = file.finish();
    EXPECT_EQ(body.length, text.size());
    std::ifstream stream(body.path, std::ios::binary);
    EXPECT_EQ(std::string((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>()), text);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(ExportsTest, File_LeavesTheReserve_AndNothingElse) {
  constexpr auto whole_disk = std::numeric_limits<std::uint64_t>::max();
  {
    ExportFile file(folder_, whole_disk);
    file.stream() << "a";
    EXPECT_THROW(static_cast<void>(file.finish()), store::DiskFull);
  }
  {
    ExportFile file(folder_, whole_disk);
    file.stream() << std::string(3U << 20U, 'x');
    EXPECT_FALSE(file.stream()) << "the export ends early";
    EXPECT_THROW(file.check(), store::DiskFull);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

}  // namespace
}  // namespace semblante::api
