// A real server on a data folder in which something was changed, removed or closed behind its back: it says what is
// wrong without saying where, serves nothing that is damaged, and is mended by the same bytes.

#include <algorithm>
#include <csignal>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/integration/cli/program.h"
#include "tests/integration/server/model_flow.h"

namespace semblante::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

void flip_a_byte(const fs::path& file) {
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(fs::file_size(file) / 2));
  const char byte = static_cast<char>(stream.peek() ^ 1);
  stream.seekp(static_cast<std::streamoff>(fs::file_size(file) / 2));
  stream.put(byte);
}

class DamagedData : public ::testing::Test {
 protected:
  void start(std::vector<std::string> options = {}) {
    server_.reset();
    server_ = std::make_unique<ServerProcess>(data(), options);
  }
  Reply ask(const std::string& method, const std::string& target, const std::string& body = {},
            const Fields& fields = json_type) const {
    return request(server_->port(), method, target, body, fields);
  }
  std::string make_face() {
    const auto model = import_grid(server_->port());
    EXPECT_EQ(parametrize_grid(server_->port(), model).value("state", ""), "done");
    return "/v1/models/" + model;
  }
  std::string make_recording() {
    ask("POST", "/v1/streams", R"({"name":"talk"})");
    const std::string id = json_of(ask("POST", "/v1/streams/talk/recordings"))["id"];
    ask("POST", "/v1/streams/talk/frames", R"({"frames":[{"faps":{"3":80}},{"time":9}]})");
    EXPECT_EQ(json_of(ask("POST", "/v1/recordings/" + id + "/stop"))["frames"], 2);
    return id;
  }
  static std::string hash_in(const Reply& reply) {
    const auto etag = reply.headers.at("etag");
    return etag.substr(std::string("\"sha256-").size(), 64);
  }
  [[nodiscard]] fs::path blob(const std::string& hash) const { return data() / "blobs" / hash.substr(0, 2) / hash; }
  static void expect_damaged(const Reply& reply, const std::string& hash, const std::string& how) {
    EXPECT_EQ(reply.status, 500) << reply.body;
    EXPECT_EQ(json_of(reply).value("type", ""), "/problems/damaged-data");
    EXPECT_THAT(reply.body, HasSubstr("the stored bytes with the SHA-256 " + hash + " are " + how));
  }
  [[nodiscard]] fs::path data() const { return folder_.path() / "data"; }

  TemporaryFolder folder_;
  std::unique_ptr<ServerProcess> server_;
};

TEST_F(DamagedData, Artefact_IsNotServed_AndIsMendedByMakingItAgain) {
  start();
  const auto model = make_face();
  for (const std::string name : {"mesh.drc", "weights", "rig.json", "face.glb"}) {
    for (const bool gone : {false, true}) {
      SCOPED_TRACE(name + (gone ? " is gone" : " is damaged"));
      const auto target = model + "/" + name;
      const auto before = ask("GET", target);
      ASSERT_EQ(before.status, 200);
      const auto hash = hash_in(before);
      if (gone)
        fs::remove(blob(hash));
      else
        flip_a_byte(blob(hash));
      const auto how = gone ? "missing" : "damaged";
      expect_damaged(ask("GET", target), hash, how);
      expect_damaged(ask("GET", "/v1/artefacts/" + hash), hash, how);
      expect_damaged(ask("GET", target, {}, {{"Range", "bytes=0-9"}}), hash, how);
      expect_damaged(ask("GET", target, {}, {{"If-None-Match", before.headers.at("etag")}}), hash, how);
      EXPECT_EQ(ask("HEAD", target).status, 500);
      EXPECT_EQ(ask("GET", model + "/preview.glb").status, 200) << "the others are served";
      EXPECT_EQ(parametrize_grid(server_->port(), model.substr(11)).value("state", ""), "done");
      const auto after = ask("GET", target);
      EXPECT_EQ(after.status, 200);
      EXPECT_EQ(after.body, before.body);
      EXPECT_THAT(server_->errors(), HasSubstr(hash));
    }
  }
}

TEST_F(DamagedData, SourceOfAModel_FailsItsJobs_AndIsMendedByUploadingItAgain) {
  start();
  const auto model = make_face();
  const std::string hash = json_of(ask("GET", model))["source"]["sha256"];
  flip_a_byte(blob(hash));
  const auto failed = parametrize_grid(server_->port(), model.substr(11));
  EXPECT_EQ(failed.value("state", ""), "failed");
  EXPECT_EQ(failed["problem"].value("type", ""), "/problems/damaged-data") << failed;
  EXPECT_THAT(failed["problem"].value("detail", ""), HasSubstr("the model: the stored bytes with the SHA-256 " + hash));
  EXPECT_EQ(ask("GET", model + "/face.glb").status, 200) << "the package stays";
  import_grid(server_->port());
  EXPECT_EQ(parametrize_grid(server_->port(), model.substr(11)).value("state", ""), "done");
}

TEST_F(DamagedData, WhatIsReadFromABlob_IsNotReadFromADamagedOne) {
  start();
  const auto model = make_face();
  const auto id = model.substr(11);
  const auto recording = make_recording();
  const auto rig = hash_in(ask("GET", model + "/rig.json"));
  flip_a_byte(blob(rig));
  expect_damaged(ask("GET", "/v1/expressions/joy?model=" + id), rig, "damaged");
  expect_damaged(ask("GET", "/v1/recordings/" + recording + "/content?format=glb&model=" + id), rig, "damaged");
}

TEST_F(DamagedData, DamagedWhileNoServerRan_IsFoundByTheNext) {
  start();
  const auto model = make_face();
  const auto hash = hash_in(ask("GET", model + "/weights"));
  server_->end(SIGTERM);
  flip_a_byte(blob(hash));
  start();
  expect_damaged(ask("GET", model + "/weights"), hash, "damaged");
}

/// Files that have grown to a size that nobody can read in a test's time, as a damaged file system may show them.
TEST_F(DamagedData, WhatHasGrownWithoutEnd_IsNotRead) {
  start();
  const auto model = make_face();
  const auto recording = make_recording();
  const auto rig = hash_in(ask("GET", model + "/rig.json"));
  constexpr std::uintmax_t size = std::uintmax_t{1} << 42U;
  fs::resize_file(blob(rig), size);
  fs::resize_file(data() / "recordings" / (recording + ".srec"), size);
  expect_damaged(ask("GET", model + "/rig.json"), rig, "damaged");
  expect_damaged(ask("GET", "/v1/recordings/" + recording + "/content?format=glb&model=" + model.substr(11)), rig,
                 "damaged");
  ASSERT_EQ(ask("POST", "/v1/streams", R"({"name":"again"})", json_type).status, 201);
  EXPECT_EQ(ask("POST", "/v1/streams/again/plays", json{{"recording", recording}}.dump(), json_type).status, 202)
      << "its chunks are whole";
  const auto check = run_semblante({"check", "--data", data().string()});
  EXPECT_EQ(check.exit_code, 1);
  EXPECT_THAT(check.out, HasSubstr("it has " + std::to_string(size) + " bytes"));
  EXPECT_EQ(server_->end(SIGTERM), 0);
}

TEST_F(DamagedData, Recording_IsSaidToBeDamagedOrGone) {
  start();
  const auto recording = "/v1/recordings/" + make_recording();
  const auto file = data() / "recordings" / (recording.substr(15) + ".srec");
  fs::resize_file(file, 20);
  const auto cut = ask("GET", recording + "/frames");
  EXPECT_EQ(cut.status, 409) << cut.body;
  EXPECT_THAT(cut.body, HasSubstr("the recording is damaged"));
  fs::remove(file);
  for (const std::string part : {"/frames", "/content?format=fap", "/content?format=recording"}) {
    const auto gone = ask("GET", recording + part);
    EXPECT_EQ(gone.status, 409) << gone.body;
    EXPECT_THAT(gone.body, HasSubstr("its file is missing"));
  }
  EXPECT_EQ(ask("DELETE", recording).status, 204) << "it can be removed";
}

/// Something that is no folder in the place of a folder of the data folder: the calls of every user fail, also of root.
/// No answer says where (request() checks each); /readyz and the log say that something is wrong.
TEST_F(DamagedData, FoldersThatAreNone_AreSaidWithoutTheirPlace) {
  start();
  const auto model = make_face();
  const auto recording = make_recording();
  for (const std::string folder : {"blobs", "tmp", "recordings"}) {
    SCOPED_TRACE(folder);
    fs::rename(data() / folder, data() / "moved");
    std::ofstream(data() / folder) << "no folder";
    const auto upload = ask("POST", "/v1/models?filename=a.obj", grid_obj(5), obj_type);
    if (folder != "recordings") {
      EXPECT_EQ(upload.status, 503) << upload.body;
    }
    const auto record = ask("POST", "/v1/streams/talk/recordings");
    if (folder == "recordings") {
      EXPECT_EQ(record.status, 503) << record.body;
    }
    for (const std::string name : {"/face.glb", "/report.json", "/feature-points", ""}) ask("GET", model + name);
    for (const std::string part : {"", "/frames", "/content?format=fap", "/content?format=glb"})
      ask("GET", "/v1/recordings/" + recording + part);
    const auto job = json_of(ask("POST", model + "/parametrizations"));
    if (job.contains("id")) {
      ask("GET", "/v1/jobs/" + job["id"].get<std::string>());
      ask("DELETE", "/v1/jobs/" + job["id"].get<std::string>());
    }
    ask("POST", "/v1/expressions", R"({"model":")" + model.substr(11) + R"(","target":"smile"})");
    for (const std::string target : {"/readyz", "/metrics", "/v1/models", "/v1/jobs/none", "/v1/recordings"})
      ask("GET", target);
    fs::remove(data() / folder);
    fs::rename(data() / "moved", data() / folder);
    EXPECT_TRUE(testing::eventually([&] { return ask("GET", "/readyz").status == 200; }));
  }
  EXPECT_THAT(server_->errors(), HasSubstr(data().string())) << "the log says where";
  EXPECT_EQ(ask("GET", model + "/face.glb").status, 200) << "all is as it was";
  EXPECT_EQ(ask("GET", "/v1/recordings/" + recording + "/frames").status, 200);
}

/// `count` triangles apart from each other: as many parts.
std::string loose_triangles(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    const auto x = std::to_string(3 * i);
    text += "v " + x + " 0 0\nv " + std::to_string(3 * i + 1) + " 0 0\nv " + x + " 1 0\n";
  }
  for (int i = 0; i < count; ++i)
    text += "f " + std::to_string(3 * i + 1) + " " + std::to_string(3 * i + 2) + " " + std::to_string(3 * i + 3) + "\n";
  return text;
}

TEST_F(DamagedData, ModelOfThousandsOfParts_ListsTheLargest) {
  start();
  constexpr int count = 5000;
  const auto made = json_of(ask("POST", "/v1/models?filename=shards.obj", loose_triangles(count), obj_type));
  const auto model = "/v1/models/" + made["model"]["id"].get<std::string>();
  ASSERT_EQ(wait_for_job(server_->port(), made["job"]["id"])["state"], "done");
  const auto whole = json_of(ask("GET", model));
  EXPECT_EQ(whole["counts"]["parts"], count);
  EXPECT_EQ(whole["parts"].size(), 512U);
  const auto list = ask("GET", "/v1/models");
  EXPECT_EQ(json_of(list)["models"][0]["counts"]["parts"], count);
  EXPECT_EQ(json_of(list)["models"][0]["parts"].size(), 32U);
  EXPECT_LT(list.body.size(), 20'000U);
  EXPECT_EQ(ask("PATCH", model, R"({"roles":{"511":"body"}})").status, 200);
  EXPECT_EQ(json_of(ask("GET", model))["parts"][511]["role"], "body");
  const auto small = ask("PATCH", model, R"({"roles":{"4000":"body"}})");
  EXPECT_EQ(small.status, 422);
  EXPECT_EQ(json_of(small)["pointer"], "/roles/4000");
  EXPECT_THAT(small.body, HasSubstr("512 largest"));
  EXPECT_EQ(ask("PATCH", model, R"({"roles":{"5000":"body"}})").status, 422);
}

}  // namespace
}  // namespace semblante::test
