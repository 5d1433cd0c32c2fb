// A real server beside a database that is gone, empty, another or older: it serves, destroys nothing, and serves
// everything again when the right database is back.

#include <csignal>
#include <fstream>
#include <random>
#include <spawn.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include "tests/integration/server/model_flow.h"
#include "tests/support/prometheus_text.h"

extern char** environ;

namespace semblante::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using Served = std::map<std::string, std::string>;  ///< bodies by path

double metric(int port, const std::string& name) {
  return read_prometheus_text(request(port, "GET", "/metrics").body).value(name);
}

class DataFolder : public ::testing::Test {
 protected:
  /// A model with its package, and a recording that has ended: what is fetched of them.
  static Served make(int port, const std::string& stream) {
    const auto model = import_grid(port);
    EXPECT_EQ(parametrize_grid(port, model).value("state", ""), "done");
    request(port, "POST", "/v1/streams", json{{"name", stream}}.dump(), json_type);
    const std::string recording = json_of(request(port, "POST", "/v1/streams/" + stream + "/recordings"))["id"];
    request(port, "POST", "/v1/streams/" + stream + "/frames", R"({"frames":[{"faps":{"3":80}},{"time":9}]})",
            json_type);
    EXPECT_EQ(json_of(request(port, "POST", "/v1/recordings/" + recording + "/stop"))["frames"], 2);
    Served served;
    for (const std::string name : {"mesh.drc", "weights", "rig.json", "face.glb", "preview.glb", "report.json"})
      served["/v1/models/" + model + "/" + name];
    served["/v1/models/" + model];
    served["/v1/recordings/" + recording];
    served["/v1/recordings/" + recording + "/content?format=recording"];
    for (auto& [path, body] : served) body = request(port, "GET", path).body;
    return served;
  }
  static void expect_served(int port, const Served& served) {
    for (const auto& [path, body] : served) {
      const auto reply = request(port, "GET", path);
      EXPECT_EQ(reply.status, 200) << path;
      EXPECT_EQ(reply.body, body) << path;
    }
  }
  static void expect_gone(int port, const Served& served) {
    for (const auto& [path, body] : served) EXPECT_EQ(request(port, "GET", path).status, 404) << path;
  }
  /// Moves the database with all that belongs to it; the data folder has none then.
  void take_database(const fs::path& to) const {
    fs::create_directories(to);
    for (const auto* end : {"", "-wal", "-shm"})
      if (fs::exists(database().string() + end))
        fs::rename(database().string() + end, to / ("semblante.sqlite" + std::string(end)));
  }
  void put_database(const fs::path& from) const {
    take_database(folder_.path() / "thrown-away");
    for (const auto& file : fs::directory_iterator(from)) fs::copy_file(file.path(), data() / file.path().filename());
  }
  [[nodiscard]] std::size_t files_below(const fs::path& folder) const {
    std::size_t count = 0;
    if (!fs::exists(folder)) return 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) count += entry.is_regular_file() ? 1U : 0U;
    return count;
  }
  [[nodiscard]] fs::path data() const { return folder_.path() / "data"; }
  [[nodiscard]] fs::path database() const { return data() / "semblante.sqlite"; }

  TemporaryFolder folder_;
};

TEST_F(DataFolder, OtherAccounts_MayNotReadIt) {
  ServerProcess server(data());
  make(server.port(), "talk");
  constexpr auto of_others = fs::perms::group_all | fs::perms::others_all;
  EXPECT_EQ(fs::status(data()).permissions() & of_others, fs::perms::none);
  for (const auto& entry : fs::recursive_directory_iterator(data()))
    EXPECT_EQ(entry.symlink_status().permissions() & of_others, fs::perms::none) << entry.path();
}

TEST_F(DataFolder, DatabaseGoneOrEmpty_NothingIsLost_AndAllComesBackWithIt) {
  Served served;
  {
    ServerProcess server(data());
    served = make(server.port(), "talk");
    EXPECT_EQ(metric(server.port(), "semblante_trash_files"), 0.0);
    EXPECT_THAT(server.errors(), Not(HasSubstr("THE DATABASE"))) << "a new folder is nothing to warn of";
    server.end(SIGTERM);
  }
  const auto files = files_below(data() / "blobs") + files_below(data() / "recordings");
  ASSERT_GT(files, 6U);
  const auto saved = folder_.path() / "saved";
  take_database(saved);
  for (const bool empty : {false, true}) {
    if (empty) std::ofstream(database()).flush();
    {
      ServerProcess server(data());
      EXPECT_EQ(request(server.port(), "GET", "/readyz").status, 200) << "it serves all the same";
      expect_gone(server.port(), served);
      EXPECT_EQ(metric(server.port(), "semblante_trash_files"), static_cast<double>(files));
      EXPECT_GT(metric(server.port(), "semblante_trash_bytes"), 1000.0);
      EXPECT_EQ(metric(server.port(), "semblante_artefact_bytes"), 0.0);
      EXPECT_EQ(metric(server.port(), "semblante_recordings_bytes"), 0.0);
      const auto log = server.errors();
      EXPECT_THAT(log, HasSubstr("warning THE DATABASE " + database().string() + " is new and does not know"));
      EXPECT_THAT(log, HasSubstr("1 recording"));
      EXPECT_THAT(log, HasSubstr("moved to " + (data() / "trash").string() + "/20"));
      EXPECT_THAT(log, HasSubstr("7 days (--trash-grace)"));
      EXPECT_THAT(log, HasSubstr("put the right " + database().string()));
      server.end(SIGTERM);
    }
    EXPECT_EQ(files_below(data() / "blobs") + files_below(data() / "recordings"), 0U);
    EXPECT_EQ(files_below(data() / "trash"), files);
    put_database(saved);
    {
      ServerProcess server(data());
      expect_served(server.port(), served);
      EXPECT_EQ(metric(server.port(), "semblante_trash_files"), 0.0);
      EXPECT_THAT(server.errors(), HasSubstr("1 recording that the database knows returned from the trash"));
      EXPECT_THAT(server.errors(), Not(HasSubstr("missing")));
      server.end(SIGTERM);
    }
    take_database(folder_.path() / "thrown-away");
  }
}

TEST_F(DataFolder, OlderCopy_ServesWhatItKnows_AndTheNewerOneGetsAllBack) {
  const auto older = folder_.path() / "older";
  const auto newer = folder_.path() / "newer";
  Served first, second;
  {
    ServerProcess server(data());
    first = make(server.port(), "first");
    server.end(SIGTERM);
  }
  fs::create_directories(older);
  fs::copy_file(database(), older / "semblante.sqlite");
  {
    ServerProcess server(data());
    // Another face, so that it has files of its own.
    const auto model = import_grid(server.port(), 12);
    for (const auto& path : {"/v1/models/" + model, "/v1/models/" + model + "/preview.glb"})
      second[path] = request(server.port(), "GET", path).body;
    server.end(SIGTERM);
  }
  take_database(newer);
  put_database(older);
  {
    ServerProcess server(data());
    expect_served(server.port(), first);
    expect_gone(server.port(), second);
    EXPECT_THAT(server.errors(), HasSubstr("is an older copy of the one last used in this folder"));
    EXPECT_GT(metric(server.port(), "semblante_trash_files"), 0.0);
    server.end(SIGTERM);
  }
  put_database(newer);
  ServerProcess server(data());
  expect_served(server.port(), first);
  expect_served(server.port(), second);
  EXPECT_EQ(metric(server.port(), "semblante_trash_files"), 0.0);
}

TEST_F(DataFolder, GraceThatIsOver_EndsInRemoval) {
  {
    ServerProcess server(data());
    make(server.port(), "talk");
    server.end(SIGTERM);
  }
  take_database(folder_.path() / "thrown-away");
  const std::vector<std::string> no_grace = {"--trash-grace", "0"};
  {
    ServerProcess server(data(), no_grace);
    EXPECT_GT(metric(server.port(), "semblante_trash_files"), 6.0);
    EXPECT_THAT(server.errors(), HasSubstr("until the next start"));
    server.end(SIGTERM);
  }
  const auto batch = fs::directory_iterator(data() / "trash")->path();
  fs::rename(batch, data() / "trash" / "2024-01-01T00-00-00Z");
  {
    ServerProcess server(data(), {"--trash-grace", "3650d"});
    EXPECT_GT(metric(server.port(), "semblante_trash_files"), 6.0);
    server.end(SIGTERM);
  }
  ServerProcess server(data(), {"--trash-grace", "36h"});
  for (int i = 0; i < 1000 && fs::exists(data() / "trash"); ++i) ::usleep(20'000);
  EXPECT_FALSE(fs::exists(data() / "trash"));
  EXPECT_EQ(metric(server.port(), "semblante_trash_files"), 0.0);
}

TEST_F(DataFolder, NoGrace_IsOverAtTheNextStart) {
  {
    ServerProcess server(data());
    import_grid(server.port());
    server.end(SIGTERM);
  }
  take_database(folder_.path() / "thrown-away");
  for (const bool first : {true, false}) {
    ServerProcess server(data(), {"--trash-grace", "0"});
    for (int i = 0; !first && i < 1000 && fs::exists(data() / "trash"); ++i) ::usleep(20'000);
    EXPECT_EQ(fs::exists(data() / "trash"), first);
    server.end(SIGTERM);
  }
}

TEST_F(DataFolder, CommitLogOfADatabaseThatIsGone_IsKept) {
  Served served;
  {
    ServerProcess server(data());
    served = make(server.port(), "talk");
    server.end(SIGKILL);
  }
  ASSERT_GT(fs::file_size(database().string() + "-wal"), 0U) << "the newest commits are only there";
  fs::rename(database(), folder_.path() / "moved-away");
  {
    ServerProcess server(data());
    expect_gone(server.port(), served);
    EXPECT_THAT(server.errors(), HasSubstr("write-ahead log"));
    server.end(SIGTERM);
  }
  take_database(folder_.path() / "thrown-away");
  fs::rename(folder_.path() / "moved-away", database());
  for (const auto& batch : fs::directory_iterator(data() / "trash"))
    fs::rename(batch.path() / "semblante.sqlite-wal", database().string() + "-wal");
  ServerProcess server(data());
  expect_served(server.port(), served);
}

TEST_F(DataFolder, OrphansOfACrash_GoQuietly_AndOddFilesStay) {
  Served served;
  {
    ServerProcess server(data());
    served = make(server.port(), "talk");
    server.end(SIGKILL);
  }
  const std::string hash(64, 'a');
  fs::create_directories(data() / "blobs" / "aa");
  std::ofstream(data() / "blobs" / "aa" / hash) << "adopted, and never committed";
  std::ofstream(data() / "recordings" / "aaaaaaaaaaaa.srec") << "begun, and never committed";
  std::ofstream(data() / "recordings" / "notes.txt") << "somebody's";
  fs::create_symlink(database(), data() / "recordings" / "bbbbbbbbbbbb.srec");
  ServerProcess server(data());
  expect_served(server.port(), served);
  EXPECT_EQ(metric(server.port(), "semblante_trash_files"), 2.0);
  EXPECT_THAT(server.errors(), HasSubstr("info 1 blob and 1 recording"));
  EXPECT_THAT(server.errors(), Not(HasSubstr("warning")));
  EXPECT_TRUE(fs::exists(data() / "recordings" / "notes.txt"));
  EXPECT_TRUE(fs::is_symlink(data() / "recordings" / "bbbbbbbbbbbb.srec"));
  EXPECT_TRUE(fs::exists(database()));
}

TEST_F(DataFolder, WhatIsNowhere_IsNamed) {
  std::string model, recording;
  {
    ServerProcess server(data());
    for (const auto& [path, body] : make(server.port(), "talk")) {
      const auto end = path.find('/', 15);
      if (path.starts_with("/v1/models/")) model = path.substr(11, path.find('/', 11) - 11);
      if (path.starts_with("/v1/recordings/")) recording = path.substr(15, end == path.npos ? end : end - 15);
    }
    server.end(SIGTERM);
  }
  const auto blobs = files_below(data() / "blobs");
  for (const auto* folder : {"blobs", "recordings"}) fs::remove_all(data() / folder);
  ServerProcess server(data());
  EXPECT_THAT(
      server.errors(),
      HasSubstr("warning " + std::to_string(blobs) +
                " blobs that the database refers to are neither in the data folder nor in its trash; of model " +
                model));
  EXPECT_THAT(
      server.errors(),
      HasSubstr("warning 1 recording of the database without a file in the data folder or its trash: " + recording));
}

/// What else may have the name of a file or folder. Some of it is waited for when it is opened, some never ends.
enum class Instead { fifo, folder, loop, device };

void put(Instead what, const fs::path& path) {
  fs::remove_all(path);
  fs::create_directories(path.parent_path());
  if (what == Instead::fifo) ::mkfifo(path.c_str(), 0600);
  if (what == Instead::folder) fs::create_directories(path / "content");
  if (what == Instead::loop) fs::create_symlink(path, path);
  if (what == Instead::device) fs::create_symlink("/dev/zero", path);
}

TEST_F(DataFolder, WhatIsNoFile_HoldsUpNoStart_AndIsNamed) {
  Served served;
  const auto first = folder_.path() / "first";
  std::string finished, running, blob;
  {
    ServerProcess server(data());
    served = make(server.port(), "talk");
    for (const auto& [path, body] : served)
      if (path.ends_with("?format=recording")) finished = path.substr(15, 12);
    running = json_of(request(server.port(), "POST", "/v1/streams/talk/recordings"))["id"];
    server.end(SIGKILL);
  }
  for (const auto& entry : fs::recursive_directory_iterator(data() / "blobs"))
    if (entry.is_regular_file())
      blob = "blobs/" + entry.path().filename().string().substr(0, 2) + "/" + entry.path().filename().string();
  fs::copy(data(), first, fs::copy_options::recursive);
  const std::string of_finished = "recordings/" + finished + ".srec", of_running = "recordings/" + running + ".srec";
  const std::vector<std::string> folders = {"recordings", "blobs", "tmp", "trash"}, own = {"reserve", "last-database"};
  for (const auto& names : {folders, own, {of_finished, of_running, blob}})
    for (const auto& name : names)
      for (const auto what : {Instead::fifo, Instead::folder, Instead::loop, Instead::device}) {
        SCOPED_TRACE(name + " " + std::to_string(static_cast<int>(what)));
        fs::remove_all(data());
        fs::copy(first, data(), fs::copy_options::recursive);
        put(what, data() / name);
        ServerProcess server(data());
        EXPECT_TRUE(fs::exists(fs::symlink_status(data() / name)) || name == "trash");
        // The server's own files are replaced, unless it would remove a folder; the trash is not needed.
        const bool is_well = names == own ? what != Instead::folder : names == folders && what == Instead::folder;
        if (!is_well && name != "trash") {
          EXPECT_THAT(server.errors(), HasSubstr(fs::path(name).stem().string()));
        }
        for (const auto& [path, body] : served) {
          const auto reply = request(server.port(), "GET", path);
          const bool of_recordings = path.ends_with("?format=recording");
          const bool is_gone = of_recordings ? name == "recordings" || name == of_finished : name.starts_with("blobs");
          if (!is_gone) {
            EXPECT_EQ(reply.body, body) << path;
          } else if (reply.status != 200) {
            EXPECT_EQ(reply.status, of_recordings ? 409 : 500) << path;
          }
        }
        EXPECT_EQ(server.end(SIGTERM), 0);
      }
}

TEST_F(DataFolder, DatabaseThatIsNoFile_IsNamed_AndItsLogStays) {
  {
    ServerProcess server(data());
    make(server.port(), "talk");
    server.end(SIGKILL);
  }
  const auto log = data() / "semblante.sqlite-wal";
  const auto bytes = fs::file_size(log);
  ASSERT_GT(bytes, 0U);
  fs::rename(database(), folder_.path() / "moved-away");
  for (const auto what : {Instead::fifo, Instead::folder, Instead::loop, Instead::device}) {
    put(what, database());
    try {
      const ServerProcess server(data());
      ADD_FAILURE() << "started";
    } catch (const std::runtime_error& fault) {
      EXPECT_THAT(fault.what(), HasSubstr(database().string() + ": a "));
      EXPECT_THAT(fault.what(), HasSubstr(" is in its place"));
    }
    EXPECT_EQ(fs::file_size(log), bytes);
    EXPECT_FALSE(fs::exists(data() / "trash"));
  }
}

TEST_F(DataFolder, FilesBehindALinkForUploads_AreNotRemoved) {
  const auto other = folder_.path() / "other";
  fs::create_directories(other);
  std::ofstream(other / "letter") << "somebody's";
  fs::create_directories(data());
  fs::create_directory_symlink(other, data() / "tmp");
  ServerProcess server(data());
  EXPECT_TRUE(fs::exists(other / "letter"));
}

TEST_F(DataFolder, DeletedByItsUser_IsGoneAtOnce) {
  ServerProcess server(data());
  const auto served = make(server.port(), "talk");
  for (const auto& [path, body] : served)
    if (std::count(path.begin(), path.end(), '/') == 3) {
      EXPECT_EQ(request(server.port(), "DELETE", path).status, 204);
    }
  EXPECT_EQ(files_below(data() / "blobs") + files_below(data() / "recordings"), 0U);
  EXPECT_FALSE(fs::exists(data() / "trash"));
}

TEST_F(DataFolder, StartsKilledAtAnyMoment_LoseNothing) {
  Served served;
  {
    ServerProcess server(data());
    served = make(server.port(), "talk");
    server.end(SIGTERM);
  }
  // Files enough that moving them takes a while; the database knows none of them, so they are in the trash at the end.
  constexpr std::size_t orphans = 2000;
  for (std::size_t i = 0; i < orphans; ++i) {
    auto hash = std::to_string(1'000'000 + i);
    hash = std::string(hash.rbegin(), hash.rend()) + std::string(57, 'b');
    fs::create_directories(data() / "blobs" / hash.substr(0, 2));
    std::ofstream(data() / "blobs" / hash.substr(0, 2) / hash) << i;
  }
  const auto files = [&] {
    return files_below(data() / "blobs") + files_below(data() / "recordings") + files_below(data() / "trash");
  };
  const auto before = files();
  const auto saved = folder_.path() / "saved";
  take_database(saved);
  std::mt19937 random(3);
  const std::string program = SEMBLANTE_BINARY_DIR "/bin/semblante";
  const std::string folder = data().string();
  for (int round = 0; round < 24; ++round) {
    if (round % 2 == 1)
      put_database(saved);
    else
      take_database(folder_.path() / "thrown-away");
    std::vector<std::string> arguments = {program, "serve", "--port", "0", "--data", folder, "--log-level", "error"};
    std::vector<char*> argv;
    for (auto& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    pid_t child = -1;
    ASSERT_EQ(posix_spawn(&child, program.c_str(), nullptr, nullptr, argv.data(), environ), 0);
    ::usleep(random() % 150'000);
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    ASSERT_EQ(files(), before) << "in round " << round;
  }
  put_database(saved);
  ServerProcess server(data());
  expect_served(server.port(), served);
  EXPECT_EQ(metric(server.port(), "semblante_trash_files"), static_cast<double>(orphans));
}

TEST_F(DataFolder, GraceThatIsNoTime_IsRefused) {
  for (const std::string grace : {"-1", "soon", "3w", "4000d"}) {
    EXPECT_THROW(ServerProcess(data(), {"--trash-grace", grace}), std::runtime_error) << grace;
  }
}

}  // namespace
}  // namespace semblante::test
