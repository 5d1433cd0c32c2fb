// The real server on disks that fail in other ways than being full: read only, without inodes, with a damaged database;
// and after somebody has set the clock back. It says so, loses nothing, and goes on when that is over.

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sched.h>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/resource.h>

#include "tests/integration/cli/program.h"
#include "tests/integration/server/model_flow.h"

namespace semblante::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

class BadDisk : public ::testing::Test {
 protected:
  ~BadDisk() override { ::umount2(data().c_str(), MNT_DETACH); }
  [[nodiscard]] fs::path data() const { return folder_.path() / "data"; }
  /// A disk of its own for the data folder, which goes with this process. False when the process may not mount one.
  [[nodiscard]] bool mount_disk(const std::string& options) const {
    fs::create_directory(data());
    return ::unshare(CLONE_NEWNS) == 0 && ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
           ::mount("none", data().c_str(), "tmpfs", 0, options.c_str()) == 0;
  }
  void remount(unsigned long flags) const {
    // The kernel ends a killed server's workers a moment later, and until then they have files open.
    ASSERT_TRUE(testing::eventually([&] {
      return ::mount("none", data().c_str(), "tmpfs", MS_REMOUNT | flags, nullptr) == 0;
    })) << std::strerror(errno);
  }
  /// Makes empty files until no more can be made for half a second: a job that has ended may still remove its files.
  void take_all_inodes() const {
    fs::create_directory(data() / "filler");
    int made = 0;
    for (int refused = 0; refused < 10;) {
      if (std::ofstream(data() / "filler" / std::to_string(made))) {
        ++made;
        refused = 0;
      } else {
        ++refused;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
      }
    }
  }
  static std::string start_error(const fs::path& folder) {
    try {
      const ServerProcess server(folder);
      return {};
    } catch (const std::runtime_error& fault) {
      return fault.what();
    }
  }

  TemporaryFolder folder_;
};

/// What a server has, as it says it.
std::map<std::string, std::string> served(int port) {
  std::map<std::string, std::string> bodies;
  for (const std::string list : {"/v1/models", "/v1/recordings", "/v1/streams"})
    bodies[list] = request(port, "GET", list).body;
  for (const auto& model : json::parse(bodies["/v1/models"])["models"]) {
    const std::string self = model["links"]["self"];
    for (const std::string name : {"/face.glb", "/feature-points"})
      bodies[self + name] = request(port, "GET", self + name).body;
  }
  return bodies;
}

TEST_F(BadDisk, ThatBecomesReadOnly_IsSaid_AndHeals) {
  if (!mount_disk("size=64m")) GTEST_SKIP() << "this process may not mount a file system";
  const ServerProcess server(data(), {"--disk-reserve", "0"});
  const auto port = server.port();
  const auto model = "/v1/models/" + import_grid(port);
  ASSERT_EQ(parametrize_grid(port, model.substr(11))["state"], "done");
  request(port, "POST", "/v1/streams", R"({"name":"talk"})", json_type);
  const auto before = served(port);
  // Files that are open for writing would forbid it, as they do for umount: a file system that found an error in itself
  // does not ask. A read-only bind mount over the folder is the same for every file that is opened from now on.
  ASSERT_EQ(::mount(data().c_str(), data().c_str(), nullptr, MS_BIND, nullptr), 0);
  ASSERT_EQ(::mount(nullptr, data().c_str(), nullptr, MS_BIND | MS_REMOUNT | MS_RDONLY, nullptr), 0);
  EXPECT_EQ(served(port), before) << "everything can still be read";
  const auto upload = request(port, "POST", "/v1/models?filename=a.obj", grid_obj(5), obj_type);
  EXPECT_EQ(upload.status, 503) << upload.body;
  EXPECT_EQ(json_of(upload)["type"], "/problems/storage-unavailable");
  EXPECT_EQ(request(port, "POST", "/v1/streams/talk/recordings").status, 503);
  EXPECT_EQ(request(port, "GET", "/healthz").status, 200);
  EXPECT_THAT(server.errors(), HasSubstr("Read-only file system"));
  ::umount2(data().c_str(), MNT_DETACH);
  EXPECT_TRUE(testing::eventually([&] { return request(port, "GET", "/readyz").status == 200; }));
  EXPECT_EQ(served(port), before);
  EXPECT_EQ(request(port, "POST", "/v1/models?filename=a.obj", grid_obj(5), obj_type).status, 202);
}

TEST_F(BadDisk, ReadOnlyAtTheStart_IsSaid_AndItCanBeChecked) {
  if (!mount_disk("size=64m")) GTEST_SKIP() << "this process may not mount a file system";
  {
    ServerProcess server(data());
    import_grid(server.port());
    EXPECT_EQ(server.end(SIGTERM), 0);
  }
  remount(MS_RDONLY);
  EXPECT_THAT(start_error(data()), HasSubstr("Read-only file system"));
  const auto check = run_semblante({"check", "--data", data().string()});
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
  const auto copy = folder_.path() / "copy";
  EXPECT_EQ(run_semblante({"backup", "--data", data().string(), "--to", copy.string()}).exit_code, 0);
  remount(0);
  const ServerProcess server(data());
  EXPECT_EQ(json_of(request(server.port(), "GET", "/v1/models"))["models"].size(), 1U);
}

TEST_F(BadDisk, WithoutInodes_IsFull_AndHeals) {
  if (!mount_disk("size=64m,nr_inodes=200")) GTEST_SKIP() << "this process may not mount a file system";
  const ServerProcess server(data(), {"--disk-reserve", "0"});
  const auto port = server.port();
  const auto model = import_grid(port);
  ASSERT_EQ(parametrize_grid(port, model)["state"], "done");
  request(port, "POST", "/v1/streams", R"({"name":"talk"})", json_type);
  const auto before = served(port);
  take_all_inodes();
  const auto upload = request(port, "POST", "/v1/models?filename=a.obj", grid_obj(5), obj_type);
  EXPECT_EQ(upload.status, 507) << upload.body;
  EXPECT_EQ(json_of(upload)["type"], "/problems/insufficient-storage");
  EXPECT_EQ(request(port, "POST", "/v1/streams/talk/recordings").status, 507);
  EXPECT_EQ(served(port), before);
  // A change of a record needs no inode.
  EXPECT_EQ(request(port, "PATCH", "/v1/models/" + model, R"({"name":"Renamed"})", json_type).status, 200);
  const auto job = json_of(request(port, "POST", "/v1/models/" + model + "/parametrizations"));
  fs::remove_all(data() / "filler");
  EXPECT_TRUE(testing::eventually([&] { return request(port, "GET", "/readyz").status == 200; }));
  if (job.contains("id")) {
    const auto ended = wait_for_job(port, job["id"]);
    EXPECT_EQ(ended["state"], "done") << ended;
  }
  EXPECT_EQ(request(port, "POST", "/v1/models?filename=a.obj", grid_obj(5), obj_type).status, 202);
  EXPECT_EQ(run_semblante({"check", "--data", data().string()}).exit_code, 0);
}

TEST_F(BadDisk, LimitOfAFilesSize_IsSaid_AndEndsNothing) {
  ServerProcess server(data());
  const auto port = server.port();
  rlimit before{};
  ASSERT_EQ(::prlimit(server.pid(), RLIMIT_FSIZE, nullptr, &before), 0);
  const rlimit small{16'384, before.rlim_max};
  ASSERT_EQ(::prlimit(server.pid(), RLIMIT_FSIZE, &small, nullptr), 0);
  EXPECT_EQ(request(port, "POST", "/v1/models?filename=a.obj", grid_obj(60), obj_type).status, 503);
  EXPECT_EQ(request(port, "GET", "/healthz").status, 200);
  ASSERT_EQ(::prlimit(server.pid(), RLIMIT_FSIZE, &before, nullptr), 0);
  EXPECT_TRUE(testing::eventually([&] { return request(port, "GET", "/readyz").status == 200; }));
  EXPECT_EQ(request(port, "POST", "/v1/models?filename=a.obj", grid_obj(60), obj_type).status, 202);
  EXPECT_EQ(server.end(SIGTERM), 0);
}

class DamagedDatabase : public BadDisk {
 protected:
  /// Writes over a part of the database file, from the byte `from`.
  void damage(std::uintmax_t from, std::size_t bytes) const {
    std::fstream stream(data() / "semblante.sqlite", std::ios::in | std::ios::out | std::ios::binary);
    stream.seekp(static_cast<std::streamoff>(from));
    stream << std::string(bytes, '\x5a');
  }
  [[nodiscard]] std::size_t blobs() const {
    std::size_t count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(data() / "blobs"))
      count += entry.is_regular_file() ? 1U : 0U;
    return count;
  }
};

TEST_F(DamagedDatabase, IsNotStartedOn_AndNothingIsMoved) {
  {
    ServerProcess server(data());
    import_grid(server.port());
    EXPECT_EQ(server.end(SIGTERM), 0);
  }
  const auto before = blobs();
  fs::copy_file(data() / "semblante.sqlite", folder_.path() / "saved");
  for (const auto& [from, bytes] : std::map<std::uintmax_t, std::size_t>{{0, 100}, {100, 3000}}) {
    SCOPED_TRACE(from);
    damage(from, bytes);
    const auto error = start_error(data());
    EXPECT_THAT(error, HasSubstr("semblante.sqlite"));
    EXPECT_THAT(error, ::testing::AnyOf(HasSubstr("file is not a database"), HasSubstr("malformed")));
    EXPECT_EQ(blobs(), before);
    EXPECT_FALSE(fs::exists(data() / "trash"));
    EXPECT_EQ(run_semblante({"check", "--data", data().string()}).exit_code, 1);
    EXPECT_NE(
        run_semblante({"backup", "--data", data().string(), "--to", (folder_.path() / "copy").string()}).exit_code, 0);
    fs::remove_all(folder_.path() / "copy");
    fs::copy_file(folder_.path() / "saved", data() / "semblante.sqlite", fs::copy_options::overwrite_existing);
  }
  const ServerProcess server(data());
  EXPECT_EQ(json_of(request(server.port(), "GET", "/v1/models"))["models"].size(), 1U);
}

/// A page of one table: the server may start, and what it cannot read it does not take for empty.
TEST_F(DamagedDatabase, InOnePage_IsFound_AndNoFileIsTakenForUnknown) {
  {
    ServerProcess server(data());
    for (int i = 0; i < 3; ++i) import_grid(server.port(), 9 + i);
    EXPECT_EQ(server.end(SIGTERM), 0);
  }
  const auto before = blobs();
  const auto database = data() / "semblante.sqlite";
  const auto size = fs::file_size(database);
  fs::copy_file(database, folder_.path() / "saved");
  constexpr std::uintmax_t page = 4096;
  for (auto from = page; from < size; from += page) {
    SCOPED_TRACE("page " + std::to_string(from / page + 1));
    fs::copy_file(folder_.path() / "saved", database, fs::copy_options::overwrite_existing);
    fs::remove(database.string() + "-wal");
    fs::remove(database.string() + "-shm");
    damage(from, page);
    const auto check = run_semblante({"check", "--json", "--data", data().string()});
    EXPECT_EQ(check.exit_code, 1) << check.out << check.err;
    EXPECT_THAT(check.out, HasSubstr("damaged-database"));
    EXPECT_NE(run_semblante({"check", "--repair", "--data", data().string()}).exit_code, 0);
    start_error(data());
    EXPECT_EQ(blobs(), before) << "moved, because the database did not name them";
    if (HasFailure()) return;
  }
}

class SetClock : public BadDisk {
 protected:
  SetClock() {
    ::setenv("LD_PRELOAD", SEMBLANTE_CLOCK_LIBRARY, 1);
    set(0);
  }
  ~SetClock() override {
    ::unsetenv("LD_PRELOAD");
    ::unsetenv("SEMBLANTE_TEST_CLOCK");
  }
  static void set(long seconds) { ::setenv("SEMBLANTE_TEST_CLOCK", std::to_string(seconds).c_str(), 1); }
};

TEST_F(SetClock, Back_LosesNothing_AndKeepsTheOrder) {
  constexpr long days = 86400;
  std::vector<std::string> made;
  std::string recording, tag;
  const auto list = [](int port) {
    std::vector<std::string> ids;
    std::string after;
    while (true) {
      const auto page = json_of(request(port, "GET", "/v1/models?limit=2" + after));
      for (const auto& model : page["models"]) ids.push_back(model["id"]);
      if (page["next"].is_null()) return ids;
      after = "&after=" + page["next"].get<std::string>();
    }
  };
  for (const long clock : {0L, -40 * days, -80 * days, 20 * days, -30'000 * days /* before 1970 */, 0L}) {
    SCOPED_TRACE(clock / days);
    set(clock);
    ServerProcess server(data());
    const auto port = server.port();
    EXPECT_EQ(list(port), made);
    made.push_back(import_grid(port, 9 + static_cast<int>(made.size())));
    const auto first = "/v1/models/" + made.front();
    EXPECT_EQ(parametrize_grid(port, made.front())["state"], "done");
    // The tag of an edit depends on no clock.
    const auto now = request(port, "GET", first);
    EXPECT_NE(now.headers.at("etag"), tag);
    tag = now.headers.at("etag");
    const Fields if_match = {{"Content-Type", "application/json"}, {"If-Match", tag}};
    EXPECT_EQ(request(port, "PATCH", first, R"({"name":"A"})", if_match).status, 200);
    EXPECT_EQ(request(port, "PATCH", first, R"({"name":"B"})", if_match).status, 412);
    request(port, "POST", "/v1/streams", R"({"name":"talk"})", json_type);
    EXPECT_LT(json_of(request(port, "GET", "/v1/streams/talk"))["epoch"].get<std::uint64_t>(), std::uint64_t{1} << 53U)
        << "JavaScript's whole numbers";
    const auto begun = json_of(request(port, "POST", "/v1/streams/talk/recordings"));
    EXPECT_TRUE(
        std::regex_match(begun["created"].get<std::string>(), std::regex(R"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z)")))
        << begun["created"];
    const std::string id = begun["id"];
    for (int i = 0; i < 3; ++i)
      EXPECT_EQ(request(port, "POST", "/v1/streams/talk/frames", R"({"frames":[{"faps":{"3":80}}]})", json_type).status,
                202);
    EXPECT_EQ(json_of(request(port, "POST", "/v1/recordings/" + id + "/stop"))["frames"], 3);
    if (!recording.empty()) {
      EXPECT_EQ(json_of(request(port, "GET", "/v1/recordings/" + recording + "/frames"))["frames"].size(), 3U);
    }
    recording = id;
    EXPECT_EQ(run_semblante({"check", "--data", data().string()}).exit_code, 0);
    EXPECT_THAT(server.errors(), ::testing::Not(HasSubstr("THE DATABASE"))) << "it is not taken for an older copy";
    EXPECT_EQ(server.end(SIGTERM), 0);
  }
}

/// Files in the trash are kept at least as long as the grace period says, also when their batch is from the future.
TEST_F(SetClock, Back_RemovesNothingFromTheTrashTooEarly) {
  {
    ServerProcess server(data());
    import_grid(server.port());
    EXPECT_EQ(server.end(SIGTERM), 0);
  }
  const auto saved = folder_.path() / "saved";
  fs::rename(data() / "semblante.sqlite", saved);
  const auto count = [&] {
    std::size_t files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(data() / "trash"))
      files += entry.is_regular_file() ? 1U : 0U;
    return files;
  };
  {
    ServerProcess server(data(), {"--trash-grace", "1d"});
    EXPECT_GE(count(), 4U);
    EXPECT_EQ(server.end(SIGTERM), 0);
  }
  const auto before = count();
  set(-40L * 86400);
  {
    ServerProcess server(data(), {"--trash-grace", "1d"});
    EXPECT_EQ(request(server.port(), "GET", "/readyz").status, 200);
    EXPECT_EQ(count(), before);
    EXPECT_EQ(server.end(SIGTERM), 0);
  }
  fs::remove(data() / "semblante.sqlite-wal");
  fs::rename(saved, data() / "semblante.sqlite");
  const ServerProcess server(data());
  EXPECT_EQ(json_of(request(server.port(), "GET", "/v1/models"))["models"].size(), 1U);
  EXPECT_THAT(server.errors(), HasSubstr("returned from the trash"));
}

}  // namespace
}  // namespace semblante::test
