// `semblante check`, `backup` and `restore` on the data folder of a real server, running and stopped.

#include <atomic>
#include <csignal>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <sqlite3.h>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/hash/sha256.h"
#include "tests/integration/cli/program.h"
#include "tests/integration/server/model_flow.h"

namespace semblante::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string id_of(const Reply& reply) { return json_of(reply).value("id", reply.body); }

class Upkeep : public ::testing::Test {
 protected:
  [[nodiscard]] fs::path data() const { return folder_.path() / "data"; }
  [[nodiscard]] fs::path copy() const { return folder_.path() / "backup"; }
  [[nodiscard]] fs::path restored() const { return folder_.path() / "restored"; }

  /// A model with its package, and a finished recording, of a server that has ended.
  void fill() {
    ServerProcess server(data());
    const auto port = server.port();
    model_ = import_grid(port);
    ASSERT_EQ(parametrize_grid(port, model_).value("state", ""), "done");
    const auto etag = request(port, "GET", "/v1/models/" + model_ + "/weights").headers.at("etag");
    weights_ = etag.substr(std::string("\"sha256-").size(), 64);
    request(port, "POST", "/v1/streams", R"({"name":"talk"})", json_type);
    recording_ = id_of(request(port, "POST", "/v1/streams/talk/recordings"));
    request(port, "POST", "/v1/streams/talk/frames", R"({"frames":[{"faps":{"3":80}},{"time":9}]})", json_type);
    request(port, "POST", "/v1/recordings/" + recording_ + "/stop");
    EXPECT_EQ(server.end(SIGTERM), 0);
  }
  [[nodiscard]] Outcome check(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {"check", "--data", data().string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_semblante(arguments);
  }
  /// The kinds of the faults that a check finds, with the names.
  static std::vector<std::pair<std::string, std::string>> faults_of(const Outcome& outcome) {
    std::vector<std::pair<std::string, std::string>> faults;
    const auto report = json::parse(outcome.out, nullptr, false);
    EXPECT_TRUE(report.is_object()) << outcome.out << outcome.err;
    if (!report.is_object()) return faults;
    for (const auto& fault : report["faults"]) faults.emplace_back(fault["kind"], fault["name"]);
    EXPECT_EQ(outcome.exit_code, faults.empty() ? 0 : 1) << outcome.err;
    return faults;
  }
  [[nodiscard]] fs::path blob(const std::string& hash) const { return data() / "blobs" / hash.substr(0, 2) / hash; }
  [[nodiscard]] fs::path recording_file() const { return data() / "recordings" / (recording_ + ".srec"); }
  void execute(const std::string& sql) const {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open((data() / "semblante.sqlite").c_str(), &database), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(database);
    sqlite3_close(database);
  }

  TemporaryFolder folder_;
  std::string model_, weights_, recording_;
};

TEST_F(Upkeep, WholeFolder_HasNoFault_AndIsNotChanged) {
  fill();
  const auto text = check();
  EXPECT_EQ(text.exit_code, 0) << text.out << text.err;
  EXPECT_THAT(text.out, HasSubstr(" and 1 recordings ("));
  EXPECT_THAT(text.out, HasSubstr("are intact; 0 faults"));
  const auto report = json::parse(check({"--json"}).out);
  EXPECT_EQ(report["server_runs"], false);
  EXPECT_THAT(report["notes"], IsEmpty());
  EXPECT_GE(report["blobs"]["intact"], 6);
  EXPECT_FALSE(fs::exists(data() / "trash"));
  const ServerProcess server(data());
  const auto running = json::parse(check({"--json"}).out);
  EXPECT_EQ(running["server_runs"], true);
  EXPECT_EQ(running["blobs"], report["blobs"]);
}

TEST_F(Upkeep, EachFault_IsFound) {
  const std::string unknown(64, 'a');
  using Faults = std::vector<std::pair<std::string, std::string>>;
  struct Case {
    std::string what;
    std::function<void()> damage;
    std::function<Faults()> expected;
  };
  const auto flip = [](const fs::path& file, std::streamoff at) {
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekp(at);
    stream.put('\x7f');
  };
  const std::vector<Case> cases = {
      {"blob gone", [&] { fs::remove(blob(weights_)); },
       [&] {
         return Faults{{"missing-blob", weights_}};
       }},
      {"byte of a blob", [&] { flip(blob(weights_), 40); },
       [&] {
         return Faults{{"damaged-blob", weights_}};
       }},
      {"link for a blob",
       [&] {
         fs::rename(blob(weights_), folder_.path() / "elsewhere");
         fs::create_symlink(folder_.path() / "elsewhere", blob(weights_));
       },
       [&] {
         return Faults{{"missing-blob", weights_}};
       }},
      {"size in a record", [&] { execute("UPDATE artefacts SET bytes = bytes + 1 WHERE sha256 = '" + weights_ + "'"); },
       [&] {
         return Faults{{"damaged-blob", weights_}};
       }},
      {"recording gone", [&] { fs::remove(recording_file()); },
       [&] {
         return Faults{{"missing-recording", recording_}};
       }},
      {"recording cut off", [&] { fs::resize_file(recording_file(), fs::file_size(recording_file()) - 3); },
       [&] {
         return Faults{{"damaged-recording", recording_}};
       }},
      {"byte of a recording",
       [&] { flip(recording_file(), static_cast<std::streamoff>(fs::file_size(recording_file()) - 2)); },
       [&] {
         return Faults{{"damaged-recording", recording_}};
       }},
      {"frames in a record", [&] { execute("UPDATE recordings SET frames = 7"); },
       [&] {
         return Faults{{"damaged-recording", recording_}};
       }},
      {"blob that no record knows",
       [&] {
         fs::create_directories(blob(unknown).parent_path());
         std::ofstream(blob(unknown)) << "?";
       },
       [&] {
         return Faults{{"unknown-blob", unknown}};
       }},
      {"recording that no record knows",
       [&] { fs::copy_file(recording_file(), data() / "recordings" / "aaaaaaaaaaaa.srec"); },
       [&] {
         return Faults{{"unknown-recording", "aaaaaaaaaaaa"}};
       }},
      {"row that refers to nothing",
       [&] {
         execute("PRAGMA foreign_keys=OFF; INSERT INTO feature_points VALUES('none',0,'2.1',1,NULL,NULL,NULL,NULL)");
       },
       [&] {
         return Faults{{"missing-row", ""}};
       }},
      {"header of the database", [&] { flip(data() / "semblante.sqlite", 3); },
       [&] {
         return Faults{{"damaged-database", ""}};
       }},
  };
  for (const auto& one : cases) {
    SCOPED_TRACE(one.what);
    fs::remove_all(data());
    fill();
    if (HasFatalFailure()) return;
    one.damage();
    const auto faults = faults_of(check({"--json"}));
    EXPECT_EQ(faults, one.expected());
    EXPECT_EQ(check().exit_code, 1);
  }
}

TEST_F(Upkeep, WhatCannotBeChecked_IsAnotherStatus) {
  EXPECT_EQ(check().exit_code, 2) << "no folder";
  fs::create_directories(data());
  const auto empty = check();
  EXPECT_EQ(empty.exit_code, 2);
  EXPECT_THAT(empty.err, HasSubstr("there is no semblante.sqlite"));
  fill();
  execute("PRAGMA user_version=1000");
  const auto later = check();
  EXPECT_EQ(later.exit_code, 2);
  EXPECT_THAT(later.err, HasSubstr("version 1000 of the schema"));
}

TEST_F(Upkeep, Repair_MovesWhatAStartWouldMove_AndOnlyWhenNoServerRuns) {
  fill();
  const std::string unknown(64, 'a');
  fs::create_directories(blob(unknown).parent_path());
  std::ofstream(blob(unknown)) << "?";
  const auto lost = data() / "trash" / "2025-01-02T03-04-05Z" / "blobs" / weights_.substr(0, 2) / weights_;
  fs::create_directories(lost.parent_path());
  fs::rename(blob(weights_), lost);
  EXPECT_EQ(faults_of(check({"--json"})).size(), 2U);
  {
    const ServerProcess server(folder_.path() / "other");
    EXPECT_EQ(run_semblante({"check", "--repair", "--data", (folder_.path() / "other").string()}).exit_code, 2);
  }
  const auto repaired = check({"--json", "--repair"});
  EXPECT_THAT(faults_of(repaired), IsEmpty());
  const auto report = json::parse(repaired.out);
  EXPECT_EQ(report["repaired"]["moved_to_trash"], 1);
  EXPECT_EQ(report["repaired"]["put_back"], 1);
  EXPECT_TRUE(fs::exists(blob(weights_)));
  EXPECT_FALSE(fs::exists(blob(unknown)));
  const ServerProcess server(data());
  EXPECT_EQ(request(server.port(), "GET", "/v1/models/" + model_ + "/weights").status, 200);
}

/// Everything that a server says it has can be fetched: the artefacts by their hash, the recordings to their end.
void expect_all_served(int port) {
  std::string after;
  while (true) {
    const auto page = json_of(request(port, "GET", "/v1/models?limit=50" + after));
    for (const auto& model : page["models"]) {
      const std::string self = model["links"]["self"];
      std::vector<std::string> names;
      if (model["state"] == "ready" || model["state"] == "parametrized") names = {"/preview.glb", "/report.json"};
      if (model["state"] == "parametrized")
        names.insert(names.end(), {"/mesh.drc", "/weights", "/rig.json", "/face.glb"});
      for (const auto& name : names) {
        const auto reply = request(port, "GET", self + name);
        EXPECT_EQ(reply.status, 200) << self + name << ": " << reply.body.substr(0, 500);
        EXPECT_EQ(reply.headers.at("etag"), "\"sha256-" + sha256_hex(reply.body) + "\"") << self + name;
      }
      EXPECT_EQ(request(port, "GET", self + "/feature-points").status, 200);
    }
    if (page["next"].is_null()) break;
    after = "&after=" + page["next"].get<std::string>();
  }
  for (const auto& recording : json_of(request(port, "GET", "/v1/recordings?limit=200"))["recordings"]) {
    const std::string self = recording["links"]["self"];
    const auto frames = json_of(request(port, "GET", self + "/frames?limit=1000"));
    EXPECT_EQ(frames["frames"].size(), std::min(recording["frames"].get<std::size_t>(), std::size_t{1000}))
        << recording;
  }
}

/// Uploads, removals, parametrizations and recordings, until it is destroyed.
class Load {
 public:
  explicit Load(int port) : port_(port) {
    threads_.emplace_back([this] { upload_and_remove(); });
    threads_.emplace_back([this] { parametrize(); });
    threads_.emplace_back([this] { record(); });
  }
  ~Load() {
    stop_ = true;
    for (auto& thread : threads_) thread.join();
  }
  Load(const Load&) = delete;
  Load& operator=(const Load&) = delete;

 private:
  void upload_and_remove() {
    for (int i = 0; !stop_; ++i) {
      const auto id = import_grid(port_, 5 + i % 20);
      if (i % 3 != 0) request(port_, "DELETE", "/v1/models/" + id);
    }
  }
  /// The artefacts of each package replace those of the one before.
  void parametrize() {
    const auto id = import_grid(port_);
    for (int i = 0; !stop_; ++i) {
      request(port_, "PATCH", "/v1/models/" + id, json{{"name", "Grid " + std::to_string(i)}}.dump(), json_type);
      parametrize_grid(port_, id);
    }
  }
  void record() {
    request(port_, "POST", "/v1/streams", R"({"name":"load"})", json_type);
    for (int i = 0; !stop_; ++i) {
      const auto id = id_of(request(port_, "POST", "/v1/streams/load/recordings"));
      for (int frame = 0; frame < 20 && !stop_; ++frame)
        request(port_, "POST", "/v1/streams/load/frames", R"({"frames":[{"faps":{"3":80}}]})", json_type);
      if (i % 2 == 0) request(port_, "POST", "/v1/recordings/" + id + "/stop");
      if (i % 4 == 0) request(port_, "DELETE", "/v1/recordings/" + id);
    }
  }

  const int port_;
  std::atomic<bool> stop_ = false;
  std::vector<std::thread> threads_;
};

TEST_F(Upkeep, BackupOfABusyServer_IsWholeAfterItsRestore) {
  fill();
  const ServerProcess server(data());
  json before;
  {
    const Load load(server.port());
    for (int round = 0; round < 4; ++round) {
      SCOPED_TRACE(round);
      std::this_thread::sleep_for(std::chrono::milliseconds(700));
      fs::remove_all(copy());
      fs::remove_all(restored());
      EXPECT_THAT(faults_of(check({"--json"})), IsEmpty()) << "a check of the busy folder";
      const auto backup = run_semblante({"backup", "--data", data().string(), "--to", copy().string()});
      EXPECT_EQ(backup.exit_code, 0) << backup.out << backup.err;
      const auto restore = run_semblante({"restore", "--from", copy().string(), "--data", restored().string()});
      EXPECT_EQ(restore.exit_code, 0) << restore.out << restore.err;
      EXPECT_THAT(restore.out, HasSubstr("; 0 faults"));
      const ServerProcess again(restored());
      EXPECT_EQ(request(again.port(), "GET", "/readyz").status, 200);
      EXPECT_EQ(request(again.port(), "GET", "/v1/models/" + model_).status, 200);
      EXPECT_EQ(request(again.port(), "GET", "/v1/recordings/" + recording_).status, 200);
      expect_all_served(again.port());
      EXPECT_THAT(again.errors(), ::testing::Not(HasSubstr("warning")));
    }
  }
  expect_all_served(server.port());
}

TEST_F(Upkeep, Backup_IsReadableForItsOwnerOnly_AndIsNotMixedWithAnother) {
  fill();
  const std::vector<std::string> back_up = {"backup", "--data", data().string(), "--to", copy().string()};
  ASSERT_EQ(run_semblante(back_up).exit_code, 0);
  constexpr auto of_others = fs::perms::group_all | fs::perms::others_all;
  for (const auto& entry : fs::recursive_directory_iterator(copy()))
    EXPECT_EQ(entry.symlink_status().permissions() & of_others, fs::perms::none) << entry.path();
  const auto again = run_semblante(back_up);
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.err, HasSubstr("not empty"));
  EXPECT_EQ(run_semblante({"restore", "--from", copy().string(), "--data", data().string()}).exit_code, 2);
  // A backup that was killed has no backup.json yet.
  fs::remove(copy() / "backup.json");
  const auto unfinished = run_semblante({"restore", "--from", copy().string(), "--data", restored().string()});
  EXPECT_EQ(unfinished.exit_code, 2);
  EXPECT_THAT(unfinished.err, HasSubstr("not completed"));
  EXPECT_FALSE(fs::exists(restored()));
  EXPECT_EQ(run_semblante({"backup", "--data", restored().string(), "--to", copy().string()}).exit_code, 2);
}

TEST_F(Upkeep, BackupWithinItsDataFolder_IsRefused) {
  fill();
  for (const std::string inside : {"backup", "tmp/backup", "blobs/../backup"}) {
    const auto backup = run_semblante({"backup", "--data", data().string(), "--to", (data() / inside).string()});
    EXPECT_EQ(backup.exit_code, 2) << inside;
    EXPECT_THAT(backup.err, HasSubstr("lies within the data folder"));
    EXPECT_FALSE(fs::exists(data() / inside)) << inside;
  }
}

TEST_F(Upkeep, BackupOfADamagedFolder_HasTheRest_AndSaysSo) {
  fill();
  std::ofstream(blob(weights_)) << "damaged";
  fs::remove(recording_file());
  const auto backup = run_semblante({"backup", "--data", data().string(), "--to", copy().string()});
  EXPECT_EQ(backup.exit_code, 1);
  EXPECT_THAT(backup.out, HasSubstr("not copied: blob " + weights_ + ": its bytes are damaged"));
  EXPECT_THAT(backup.out, HasSubstr("not copied: recording " + recording_ + ": it is missing"));
  const auto restore = run_semblante({"restore", "--from", copy().string(), "--data", restored().string()});
  EXPECT_EQ(restore.exit_code, 1);
  EXPECT_THAT(restore.out, HasSubstr("missing-blob " + weights_));
  const ServerProcess server(restored());
  EXPECT_EQ(request(server.port(), "GET", "/v1/models/" + model_ + "/mesh.drc").status, 200);
  EXPECT_EQ(request(server.port(), "GET", "/v1/models/" + model_ + "/weights").status, 500);
}

TEST_F(Upkeep, BackupAndRestore_KeepTheCertificateThatPhonesHaveAccepted) {
  fill();
  fs::create_directories(data() / "lan");
  const std::map<std::string, std::string> files = {{"lan/certificate.pem", "a certificate"}, {"lan/key.pem", "a key"}};
  for (const auto& [name, text] : files) std::ofstream(data() / name) << text;
  const auto backup = run_semblante({"backup", "--data", data().string(), "--to", copy().string()});
  ASSERT_EQ(backup.exit_code, 0) << backup.err;
  EXPECT_THAT(backup.out, HasSubstr("the certificate of serve --lan"));
  ASSERT_EQ(run_semblante({"restore", "--from", copy().string(), "--data", restored().string()}).exit_code, 0);
  for (const auto& [name, text] : files)
    for (const auto& place : {copy(), restored()}) {
      std::ifstream stream(place / name);
      EXPECT_EQ(std::string(std::istreambuf_iterator<char>(stream), {}), text) << place / name;
      EXPECT_EQ(fs::status(place / name).permissions(), fs::perms::owner_read | fs::perms::owner_write);
    }
}

}  // namespace
}  // namespace semblante::test
