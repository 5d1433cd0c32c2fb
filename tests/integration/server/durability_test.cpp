// What was acknowledged survives kill -9; jobs that were cut off are taken up again; a hostile job takes down only its
// worker.

#include <array>
#include <csignal>
#include <cstdio>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/integration/server/model_flow.h"

namespace semblante::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

TEST(Durability, Acknowledged_SurvivesKill) {
  const TemporaryFolder folder;
  std::string model;
  std::string points;
  std::map<std::string, Reply> artefacts;
  {
    ServerProcess server(folder.path() / "data");
    model = import_grid(server.port());
    ASSERT_EQ(parametrize_grid(server.port(), model).value("state", ""), "done");
    for (const std::string name : {"mesh.drc", "weights", "rig.json", "face.glb", "preview.glb", "report.json"})
      artefacts[name] = request(server.port(), "GET", "/v1/models/" + model + "/" + name);
    const auto put = request(server.port(), "PUT", "/v1/models/" + model + "/feature-points",
                             R"({"points":{"2.1":{"vertex":7}}})", json_type);
    ASSERT_EQ(put.status, 200);
    points = put.body;
    EXPECT_EQ(server.end(SIGKILL), -SIGKILL);
  }
  ServerProcess server(folder.path() / "data");
  EXPECT_EQ(request(server.port(), "GET", "/v1/models/" + model + "/feature-points").body, points);
  EXPECT_EQ(json_of(request(server.port(), "GET", "/v1/models/" + model))["state"], "parametrized");
  for (const auto& [name, before] : artefacts) {
    const auto after = request(server.port(), "GET", "/v1/models/" + model + "/" + name);
    EXPECT_EQ(after.body, before.body) << name;
    EXPECT_EQ(after.headers.at("etag"), before.headers.at("etag"));
  }
}

TEST(Durability, FaultOfAnImport_KeepsItsAdvice) {
  const TemporaryFolder folder;
  json job, problem;
  {
    ServerProcess server(folder.path() / "data");
    const auto made = json_of(request(server.port(), "POST", "/v1/models?filename=head.gltf",
                                      R"({"asset":{"version":"2.0"},"extensionsRequired":["X_new"]})",
                                      {{"Content-Type", "model/gltf+json"}}));
    job = wait_for_job(server.port(), made["job"]["id"]);
    problem = job["problem"];
    EXPECT_EQ(problem.value("advice", ""), "export-as-glb") << problem;
    EXPECT_EQ(server.end(SIGKILL), -SIGKILL);
  }
  ServerProcess server(folder.path() / "data");
  EXPECT_EQ(json_of(request(server.port(), "GET", "/v1/jobs/" + job.value("id", "")))["problem"], problem);
  EXPECT_EQ(json_of(request(server.port(), "GET", "/v1/models/" + job.value("model", "")))["problem"], problem);
}

TEST(Durability, ManyPuts_EachSurvivesItsKill) {
  const TemporaryFolder folder;
  std::string model;
  for (int round = 0; round < 5; ++round) {
    ServerProcess server(folder.path() / "data");
    if (model.empty()) model = import_grid(server.port());
    const auto target = "/v1/models/" + model + "/feature-points";
    if (round > 0) {
      EXPECT_EQ(json_of(request(server.port(), "GET", target))["points"]["2.1"]["vertex"], round - 1);
    }
    const auto put = request(server.port(), "PUT", target,
                             R"({"points":{"2.1":{"vertex":)" + std::to_string(round) + "}}}", json_type);
    ASSERT_EQ(put.status, 200);
    server.end(SIGKILL);
  }
}

TEST(Durability, JobsCutOff_AreTakenUpAgain) {
  const TemporaryFolder folder;
  json made;
  {
    ServerProcess server(folder.path() / "data");
    made = json_of(
        request(server.port(), "POST", "/v1/models?filename=big.obj", grid_obj(300), {{"Content-Type", "model/obj"}}));
    server.end(SIGKILL);
  }
  ServerProcess server(folder.path() / "data");
  EXPECT_EQ(wait_for_job(server.port(), made["job"]["id"])["state"], "done");
  EXPECT_EQ(json_of(request(server.port(), "GET",
                            "/v1/models/" + made["model"]["id"].get<std::string>()))["counts"]["vertices"],
            90'000);
}

TEST(Durability, Streams_AreThereAfterARestart) {
  const TemporaryFolder folder;
  {
    ServerProcess server(folder.path() / "data");
    EXPECT_EQ(request(server.port(), "POST", "/v1/streams", R"({"name":"kept"})", json_type).status, 201);
    for (const char* body : {R"({"name":"spoken","viseme_share":0.25,"batch_interval":40,"quantizer_scale":0.5})",
                             R"({"name":"felt","viseme_share":0})"}) {
      EXPECT_EQ(request(server.port(), "POST", "/v1/streams", body, json_type).status, 201);
    }
    EXPECT_EQ(server.end(SIGINT), 0) << "Ctrl-C ends it well";
  }
  ServerProcess server(folder.path() / "data");
  const auto kept = request(server.port(), "GET", "/v1/streams/kept");
  EXPECT_EQ(kept.status, 200);
  EXPECT_TRUE(json_of(kept).at("viseme_share").is_null());
  EXPECT_EQ(json_of(kept).at("batch_interval"), 100);
  EXPECT_EQ(json_of(request(server.port(), "GET", "/v1/streams/spoken")).at("batch_interval"), 40);
  EXPECT_EQ(json_of(request(server.port(), "GET", "/v1/streams/spoken")).at("viseme_share"), 0.25);
  EXPECT_EQ(json_of(request(server.port(), "GET", "/v1/streams/spoken")).at("quantizer_scale"), 0.5);
  EXPECT_EQ(json_of(kept).at("quantizer_scale"), 1.0);
  EXPECT_EQ(json_of(request(server.port(), "GET", "/v1/streams/felt")).at("viseme_share"), 0.0);
}

TEST(Durability, Recording_HoldsWhatItSaidWasDurable) {
  const TemporaryFolder folder;
  std::string recording;
  std::size_t said = 0;
  for (int round = 0; round < 3; ++round) {
    ServerProcess server(folder.path() / "data");
    if (round == 0) request(server.port(), "POST", "/v1/streams", R"({"name":"talk"})", json_type);
    if (!recording.empty()) {
      const auto before = json_of(request(server.port(), "GET", "/v1/recordings/" + recording));
      EXPECT_EQ(before["state"], "finished");
      EXPECT_EQ(before["ended"], "server-killed");
      EXPECT_GE(before["frames"], said);
      const auto frames =
          json_of(request(server.port(), "GET", "/v1/recordings/" + recording + "/frames?limit=1000"))["frames"];
      ASSERT_GE(frames.size(), said);
      for (std::size_t i = 0; i < frames.size(); ++i) EXPECT_EQ(frames[i]["faps"]["3"], 4 * (i + 1));
      EXPECT_EQ(request(server.port(), "GET", "/v1/recordings/" + recording + "/content?format=fap").status, 200);
    }
    recording = json_of(request(server.port(), "POST", "/v1/streams/talk/recordings"))["id"];
    json now;
    for (std::size_t i = 0; i < 100 + 50U * static_cast<std::size_t>(round); ++i) {
      const auto body = R"({"frames":[{"faps":{"3":)" + std::to_string(4 * (i + 1)) + "}}]}";
      ASSERT_EQ(request(server.port(), "POST", "/v1/streams/talk/frames", body, json_type).status, 202);
    }
    // Some are known to be durable, others may still be on their way.
    testing::eventually([&] {
      now = json_of(request(server.port(), "GET", "/v1/recordings/" + recording));
      return now["frames"] > 0;
    });
    said = now["frames"];
    EXPECT_GT(said, 0U);
    server.end(SIGKILL);
  }
}

TEST(Durability, StoppedRecording_HasEveryFrame) {
  const TemporaryFolder folder;
  json stopped;
  {
    ServerProcess server(folder.path() / "data");
    request(server.port(), "POST", "/v1/streams", R"({"name":"talk"})", json_type);
    const std::string id = json_of(request(server.port(), "POST", "/v1/streams/talk/recordings"))["id"];
    for (int i = 0; i < 60; ++i)
      request(server.port(), "POST", "/v1/streams/talk/frames", R"({"frames":[{"faps":{"3":80}},{"time":9}]})",
              json_type);
    stopped = json_of(request(server.port(), "POST", "/v1/recordings/" + id + "/stop"));
    server.end(SIGKILL);
  }
  EXPECT_EQ(stopped["frames"], 120);
  ServerProcess server(folder.path() / "data");
  const std::string self = stopped["links"]["self"];
  EXPECT_EQ(json_of(request(server.port(), "GET", self)), stopped);
  EXPECT_EQ(json_of(request(server.port(), "GET", self + "/frames"))["frames"].size(), 120U);
}

TEST(Durability, Recording_OfAServerThatStops_IsWhole) {
  const TemporaryFolder folder;
  std::string id;
  {
    ServerProcess server(folder.path() / "data");
    request(server.port(), "POST", "/v1/streams", R"({"name":"talk"})", json_type);
    id = json_of(request(server.port(), "POST", "/v1/streams/talk/recordings"))["id"];
    request(server.port(), "POST", "/v1/streams/talk/frames", R"({"frames":[{"faps":{"3":80}},{"time":9}]})",
            json_type);
    EXPECT_EQ(server.end(SIGTERM), 0);
  }
  ServerProcess server(folder.path() / "data");
  const auto now = json_of(request(server.port(), "GET", "/v1/recordings/" + id));
  EXPECT_EQ(now["ended"], "server-stopped");
  EXPECT_EQ(now["frames"], 2);
}

TEST(Durability, SecondServerOnTheSameFolder_IsRefused) {
  const TemporaryFolder folder;
  const ServerProcess first(folder.path() / "data");
  EXPECT_THAT([&] { ServerProcess second(folder.path() / "data"); },
              ::testing::ThrowsMessage<std::runtime_error>(HasSubstr("another server works in")));
}

TEST(Start, PortInUse_SaysSo) {
  const TemporaryFolder folder;
  const ServerProcess first(folder.path() / "one");
  EXPECT_THAT(
      [&] {
        ServerProcess second(folder.path() / "two", {"--port", std::to_string(first.port())});
      },
      ::testing::ThrowsMessage<std::runtime_error>(::testing::AnyOf(HasSubstr("is in use"), HasSubstr("--port"))));
}

TEST(Start, PublicAddress_IsRefused) {
  const TemporaryFolder folder;
  EXPECT_THAT(
      [&] {
        ServerProcess server(folder.path() / "data", {"--address", "0.0.0.0"});
      },
      ::testing::ThrowsMessage<std::runtime_error>(HasSubstr("can be reached from other machines")));
}

/// A page's files are read without a token.
TEST(Start, PrivateFilesInTheWebRoot_AreRefused) {
  const TemporaryFolder folder;
  const auto web = folder.path() / "web";
  const auto link = folder.path() / "link";
  std::filesystem::create_directories(web);
  std::filesystem::create_symlink(web, link);
  const auto start = [&](const std::filesystem::path& data, const std::filesystem::path& root) {
    const ServerProcess server(data, {"--web-root", root.string()});
  };
  const auto is_refused = ::testing::ThrowsMessage<std::runtime_error>(HasSubstr("whose files everybody can read"));
  EXPECT_THAT([&] { start(web / "data", web); }, is_refused);
  EXPECT_THAT([&] { start(web, web); }, is_refused);
  EXPECT_THAT([&] { start(link / "data", web); }, is_refused);
  EXPECT_THAT([&] { start(web / "data", link); }, is_refused);
  EXPECT_FALSE(std::filesystem::exists(web / "data"));
  EXPECT_NO_THROW(start(folder.path() / "web-data", web));
}

TEST(Start, SampleThatIsNoFile_IsNamed) {
  const TemporaryFolder folder;
  const std::map<std::string, std::string> reasons = {
      {folder.path().string(), "it is a folder"}, {"/dev/zero", "it is no file"}, {"/nowhere.glb", "No such file"}};
  for (const auto& [sample, reason] : reasons) {
    const std::vector<std::string> options = {"--sample", sample};
    EXPECT_THAT(
        [&] { ServerProcess server(folder.path() / "data", options); },
        ::testing::ThrowsMessage<std::runtime_error>(HasSubstr("--sample: " + sample + " cannot be read: " + reason)));
  }
}

TEST(Start, NamesThatNoBrowserSends_AreRefused) {
  const TemporaryFolder folder;
  const auto start = [&](const std::vector<std::string>& options) {
    const ServerProcess server(folder.path() / "data", options);
  };
  for (const std::string origin : {"https://faces.example/", "faces.example", "https://*.faces.example",
                                   "HTTPS://faces.example", "https://faces.example:443", "http://faces.example:80", ""})
    EXPECT_THAT(
        [&] {
          start({"--allow-origin", origin});
        },
        ::testing::ThrowsMessage<std::runtime_error>(HasSubstr("is no origin as browsers send it")))
        << origin;
  for (const std::string host :
       {"https://faces.example", "faces.example:8443", "*.faces.example", "faces.example/", ""})
    EXPECT_THAT(
        [&] {
          start({"--allow-host", host});
        },
        ::testing::ThrowsMessage<std::runtime_error>(HasSubstr("is no name of a host alone")))
        << host;
  EXPECT_NO_THROW(start({"--allow-origin", "*", "--allow-origin", "null", "--allow-origin", "http://localhost:5173",
                         "--allow-origin", "capacitor://localhost", "--allow-origin", "http://[::1]:8080",
                         "--allow-host", "*", "--allow-host", "Faces.example", "--allow-host", "fe80::1"}));
}

TEST(Start, LimitsThatAreNoNumber_AreRefused) {
  const TemporaryFolder folder;
  for (const std::string option : {"--client-requests", "--client-failures", "--client-creations"})
    EXPECT_THAT(
        [&] {
          ServerProcess server(folder.path() / "data", {option, "nan"});
        },
        ::testing::ThrowsMessage<std::runtime_error>(HasSubstr("nan is no number")));
}

/// A start under limits of the system, which `ulimit` sets.
std::string start_under(const std::string& limits, const std::filesystem::path& data) {
  const auto command = limits + "; exec timeout 20 " SEMBLANTE_BINARY_DIR "/bin/semblante serve --port 0 --data " +
                       data.string() + " 2>&1";
  std::string out;
  FILE* const pipe = ::popen(command.c_str(), "r");
  std::array<char, 256> piece{};
  while (pipe != nullptr && std::fgets(piece.data(), piece.size(), pipe) != nullptr) out += piece.data();
  EXPECT_NE(::pclose(pipe), 0) << "it starts";
  return out;
}

TEST(Start, WithTooLittleOfTheSystem_SaysWhatIsMissing) {
  const TemporaryFolder folder;
  EXPECT_THAT(start_under("ulimit -n 63", folder.path() / "data"), HasSubstr("63 files open (ulimit -Hn)"));
}

TEST(Limits, WorkerOverItsMemory_FailsTheJobWithTheReason) {
  const TemporaryFolder folder;
  ServerProcess server(folder.path() / "data", {"--worker-memory", "60000000"});
  const auto made = json_of(
      request(server.port(), "POST", "/v1/models?filename=big.obj", grid_obj(700), {{"Content-Type", "model/obj"}}));
  const auto job = wait_for_job(server.port(), made["job"]["id"]);
  EXPECT_EQ(job["state"], "failed");
  // Said by the worker, or by the import if it meets the limit there.
  EXPECT_THAT(job["problem"].value("detail", ""), HasSubstr("the model needs more memory than is")) << job;
  EXPECT_EQ(request(server.port(), "GET", "/healthz").status, 200);
}

TEST(Limits, ModelsOverTheCount_AreRefused) {
  const TemporaryFolder folder;
  const ServerProcess server(folder.path() / "data", {"--max-models", "1"});
  import_grid(server.port(), 4);
  const auto reply =
      request(server.port(), "POST", "/v1/models?filename=b.obj", grid_obj(4), {{"Content-Type", "model/obj"}});
  EXPECT_EQ(reply.status, 507);
  EXPECT_EQ(json_of(reply)["type"], "/problems/limit-exceeded");
}

TEST(Jobs, Cancelled_EndsSoonAndFailsItsImport) {
  const TemporaryFolder folder;
  const ServerProcess server(folder.path() / "data");
  const auto made = json_of(
      request(server.port(), "POST", "/v1/models?filename=big.obj", grid_obj(900), {{"Content-Type", "model/obj"}}));
  const auto id = made["job"]["id"].get<std::string>();
  EXPECT_EQ(request(server.port(), "DELETE", "/v1/jobs/" + id).status, 202);
  EXPECT_EQ(wait_for_job(server.port(), id)["state"], "cancelled");
}

}  // namespace
}  // namespace semblante::test
