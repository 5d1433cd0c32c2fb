#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numeric>
#include <sstream>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <stb/stb_image.h>

#include "clients/native/client/face_package.h"
#include "clients/native/client/frame_player.h"
#include "clients/native/tools/files.h"
#include "protocol/cpp/json_codec.h"
#include "protocol/cpp/rig_document.h"
#include "protocol/cpp/weights_format.h"
#include "tests/integration/client/sample_server.h"
#include "tests/pictures/posed_head.h"
#include "tests/support/wait.h"

namespace semblante::testing {
namespace {

std::vector<glm::vec3> read_obj(const std::filesystem::path& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file) << path;
  std::vector<glm::vec3> positions;
  std::string word;
  for (std::string line; std::getline(file, line);) {
    glm::vec3 p;
    if (std::istringstream text(line); text >> word >> p.x >> p.y >> p.z && word == "v") {
      positions.push_back(p);
    }
  }
  return positions;
}

std::vector<std::string> follow(const SampleServer& server, const std::string& stream, const std::filesystem::path& out,
                                int frames) {
  return {SEMBLANTE_CLIENT, server.url(), "--stream",  stream, "--frames", std::to_string(frames),
          "--out",          out.string(), "--timeout", "600",  "--format", "obj"};
}

/// Each vertex of the package stands for a file vertex at its place (seams: several, which move alike). Draco moves it
/// by up to half a step of 14 bits, and 12-bit weights move what they weigh.
void expect_same_motion(const std::vector<glm::vec3>& package_rest, const std::vector<glm::vec3>& package_posed,
                        const std::vector<glm::vec3>& file_rest, const std::vector<glm::vec3>& file_posed) {
  glm::vec3 low(file_rest[0]);
  glm::vec3 high(file_rest[0]);
  float farthest = 0;
  for (std::size_t v = 0; v < file_rest.size(); ++v) {
    low = glm::min(low, file_rest[v]);
    high = glm::max(high, file_rest[v]);
    farthest = std::max(farthest, glm::length(file_posed[v] - file_rest[v]));
  }
  const glm::vec3 size = high - low;
  const float quantum = 0.52F * std::max({size.x, size.y, size.z}) / 16383.0F;
  const float tolerance = 2 * quantum + farthest * 12.0F / 4095.0F;
  ASSERT_GT(farthest, 20 * tolerance) << "nothing to compare: the frame hardly moves the head";
  std::vector<std::uint32_t> by_x(file_rest.size());
  std::iota(by_x.begin(), by_x.end(), 0U);
  std::sort(by_x.begin(), by_x.end(), [&](auto a, auto b) { return file_rest[a].x < file_rest[b].x; });
  std::size_t alike = 0;
  for (std::size_t v = 0; v < package_rest.size(); ++v) {
    const auto first = std::lower_bound(by_x.begin(), by_x.end(), package_rest[v].x - 2 * quantum,
                                        [&](std::uint32_t i, float x) { return file_rest[i].x < x; });
    bool found = false;
    for (auto it = first; it != by_x.end() && file_rest[*it].x <= package_rest[v].x + 2 * quantum && !found; ++it) {
      const glm::vec3 apart = glm::abs(file_rest[*it] - package_rest[v]);
      const bool same_place = std::max({apart.x, apart.y, apart.z}) <= 2 * quantum;
      const glm::vec3 motion = package_posed[v] - package_rest[v];
      found = same_place && glm::length(motion - (file_posed[*it] - file_rest[*it])) <= tolerance;
    }
    alike += found ? 1 : 0;
  }
  // The motion of lids and neck is not linear in the quantized weights: 2 of 11,478 vertices differ by more.
  EXPECT_GE(alike, package_rest.size() - package_rest.size() / 1000);
}

TEST(NativeClient, FollowingAFedStream_WritesWhatTheKernelGives) {
  const SampleServer server;
  server.create_stream("show");
  const std::filesystem::path binary_out = server.folder() / "binary";
  const std::filesystem::path json_out = server.folder() / "json";
  ChildProcess binary(follow(server, "show", binary_out, 3));
  std::vector<std::string> command = follow(server, "show", json_out, 3);
  command.emplace_back("--json");
  ChildProcess json(command);
  server.wait_for_subscribers("show", 2);
  server.post_frames("show", R"([{"faps":{"3":400,"4":-120,"23":12000,"49":-15000}}])");
  server.post_frames("show", R"([{"viseme":{"select1":10,"select2":0,"blend":63},
                                  "expression":{"select1":1,"intensity1":40,"select2":0,"intensity2":0}}])");
  ASSERT_EQ(binary.wait(patience), 0);
  ASSERT_EQ(json.wait(patience), 0);

  // The same frames in this process, on the model file itself: full precision, no package between.
  // The server gives its sample smooth weights.
  const auto head = pictures::load_posed_head(server.model_file(), server.points_file(), WeightMethod::smooth);
  ASSERT_TRUE(head) << head.error().message;
  semblante_frame faps{};
  // On the wire a FAP is a whole number of quantizer steps.
  const QuantizerSteps& steps = standard_quantizers();
  const auto set = [&](std::size_t fap, double value) {
    faps.fap[fap] = static_cast<float>(*quantize(value, steps[fap]) * steps[fap]);
  };
  set(3, 400);
  set(4, -120);
  set(23, 12000);
  set(49, -15000);
  semblante_frame speech{};
  speech.viseme1 = 10;
  speech.viseme_blend = 63;
  speech.expression1 = 1;
  speech.intensity1 = 40;

  const std::vector<glm::vec3> rest = read_obj(binary_out / "frame-00000.obj");
  ASSERT_GT(rest.size(), 5000U);
  const std::array<semblante_frame, 2> frames = {faps, speech};
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::string name = "frame-0000" + std::to_string(i + 1) + ".obj";
    const std::vector<glm::vec3> posed = read_obj(binary_out / name);
    ASSERT_EQ(posed.size(), rest.size());
    expect_same_motion(rest, posed, head->model.positions, head->pose(frames[i]));
    EXPECT_EQ(read_obj(json_out / name), posed) << "the subprotocols carry the same frame";
  }
}

/// The displacement of an FP in a set; zero where the set does not move it.
glm::vec3 displacement_of(const RigDocument::DisplacementSet& set, FeaturePointId point) {
  for (const RigDocument::Displacement& each : set.displacements) {
    if (each.id == point) {
      return each.by;
    }
  }
  return glm::vec3(0);
}

TEST(NativeClient, StreamsOfUnlikeShares_SplitVisemeAndExpressionByTheirOwn) {
  const SampleServer server;
  const std::array<float, 2> shares = {0.0F, 1.0F};
  std::array<std::filesystem::path, 2> out;
  std::vector<std::unique_ptr<ChildProcess>> clients;
  for (std::size_t s = 0; s < shares.size(); ++s) {
    const std::string name = "share-" + std::to_string(s);
    server.create_stream(name, shares[s]);
    out[s] = server.folder() / name;
    clients.push_back(std::make_unique<ChildProcess>(follow(server, name, out[s], 2)));
    server.wait_for_subscribers(name, 1);
    server.post_frames(name, R"([{"viseme":{"select1":10,"select2":0,"blend":63},
                                  "expression":{"select1":1,"intensity1":63,"select2":0,"intensity2":0}}])");
  }
  for (const auto& process : clients) {
    ASSERT_EQ(process->wait(patience), 0);
  }
  const auto package = client::fetch_package(server.http(), "sample");
  ASSERT_TRUE(package) << package.error().message;
  const auto rig = read_rig(package->rig_json);
  const auto table =
      decode_weights({reinterpret_cast<const std::uint8_t*>(package->weights.data()), package->weights.size()});
  ASSERT_TRUE(rig && table);

  const float size = glm::length(rig->bounds_max - rig->bounds_min);
  std::array<std::vector<glm::vec3>, 2> posed;
  for (std::size_t s = 0; s < shares.size(); ++s) {
    const auto rest = read_obj(out[s] / "frame-00000.obj");
    posed[s] = read_obj(out[s] / "frame-00001.obj");
    ASSERT_EQ(rest.size(), table->vertex_count);
    ASSERT_EQ(posed[s].size(), rest.size());
    std::size_t compared = 0;
    for (const auto& marked : rig->feature_points) {
      if (!marked.vertex || displacement_of(rig->visemes[10], marked.id) == glm::vec3(0) ||
          displacement_of(rig->expressions[1], marked.id) == glm::vec3(0)) {
        continue;
      }
      const std::size_t v = *marked.vertex;
      glm::vec3 expected = rest[v];
      for (std::size_t i = 0; i < table->rows.points_of(v).size(); ++i) {
        const glm::vec3 spoken = displacement_of(rig->visemes[10], table->rows.points_of(v)[i]);
        const glm::vec3 felt = displacement_of(rig->expressions[1], table->rows.points_of(v)[i]);
        const bool both = spoken != glm::vec3(0) && felt != glm::vec3(0);
        const glm::vec3 blended = both ? shares[s] * spoken + (1 - shares[s]) * felt : spoken + felt;  // Eq. 5
        expected += table->rows.weights_of(v)[i] * blended;
      }
      EXPECT_LT(glm::length(posed[s][v] - expected), 1e-5F * size) << to_string(marked.id);
      ++compared;
    }
    EXPECT_GT(compared, 3U) << "points of the mouth that both move";
  }
  EXPECT_NE(posed[0], posed[1]);
}

TEST(NativeClient, FollowingTheDemo_DrawsAFaceThatMoves) {
  const SampleServer server;
  const std::filesystem::path out = server.folder() / "demo";
  std::vector<std::string> command = {SEMBLANTE_CLIENT, server.url(), "--frames",  "5",   "--fps",    "2.5",
                                      "--out",          out.string(), "--format",  "png", "--format", "table",
                                      "--size",         "128",        "--timeout", "600"};
  ChildProcess process(command);
  ASSERT_EQ(process.wait(patience), 0);
  std::vector<std::vector<std::uint8_t>> pictures;
  for (int i = 0; i < 5; ++i) {
    const std::filesystem::path path = out / ("frame-0000" + std::to_string(i) + ".png");
    int width = 0;
    int height = 0;
    int channels = 0;
    stbi_uc* pixels = stbi_load(path.c_str(), &width, &height, &channels, 3);
    ASSERT_NE(pixels, nullptr) << path;
    ASSERT_EQ(width, 128);
    ASSERT_EQ(height, 128);
    pictures.emplace_back(pixels, pixels + std::size_t{128} * 128 * 3);
    stbi_image_free(pixels);
    // A face and a backdrop, not one colour.
    const auto [darkest, lightest] = std::minmax_element(pictures.back().begin(), pictures.back().end());
    EXPECT_GT(*lightest - *darkest, 100);
    EXPECT_TRUE(std::filesystem::exists(out / ("frame-0000" + std::to_string(i) + ".csv")));
  }
  std::size_t changed = 0;
  for (std::size_t i = 1; i < pictures.size(); ++i) {
    changed += pictures[i] != pictures[i - 1] ? 1 : 0;
  }
  EXPECT_GE(changed, 3U) << "two seconds of the demo in five pictures";
}

TEST(NativeClient, PublishingAPerformance_ReachesASubscriber) {
  const SampleServer server;
  server.create_stream("stage");
  const std::filesystem::path performance = server.folder() / "performance.json";
  ASSERT_TRUE(tools::write_file(performance, R"({"frames":[{"time":0,"faps":{"3":40}},{"time":60,"faps":{"3":80}}]})"));
  client::LiveStream stream(server.http().server(), "stage");
  client::FramePlayer player(stream, patience);
  ASSERT_TRUE(player.wait_for_header());
  EXPECT_EQ(player.header()->model, "sample");
  ChildProcess publisher({SEMBLANTE_CLIENT, server.url(), "--stream", "stage", "--role", "publish", "--frames-file",
                          performance.string()});
  ASSERT_EQ(publisher.wait(patience), 0);
  std::vector<float> jaws;
  while (jaws.size() < 8 && (jaws.empty() || jaws.back() != 80)) {
    const auto frame = player.next_received();
    ASSERT_TRUE(frame) << frame.error().message;
    ASSERT_TRUE(frame->has_value());
    jaws.push_back((*frame)->frame.fap[3]);
  }
  EXPECT_EQ(jaws.back(), 80.0F);
  EXPECT_NE(std::find(jaws.begin(), jaws.end(), 40.0F), jaws.end());
}

TEST(NativeClient, PublishingADocumentOfCues_SaysWhichFileAndWhatMakesFramesOfIt) {
  const SampleServer server;
  const std::filesystem::path cues = server.folder() / "cues.json";
  ASSERT_TRUE(tools::write_file(cues, R"({"version":1,"cues":[]})"));
  ChildProcess publisher({"/bin/sh", "-c",
                          std::string(SEMBLANTE_CLIENT) + " " + server.url() + " --role publish --frames-file '" +
                              cues.string() + "' 2>&1"});
  const std::string said = publisher.read_line(patience);
  EXPECT_NE(said.find(cues.string() + ": /frames: "), std::string::npos) << said;
  EXPECT_NE(said.find("semblante convert"), std::string::npos) << said;
  EXPECT_NE(publisher.wait(patience), 0);
}

TEST(NativeClient, RecordingOfAStreamThatStops_KeepsWhatCame) {
  const SampleServer server;
  server.create_stream("brief");
  server.post_frames("brief", R"([{"faps":{"3":40}}])");
  const std::filesystem::path record = server.folder() / "brief.json";
  ChildProcess process({SEMBLANTE_CLIENT, server.url(), "--stream", "brief", "--frames", "1000", "--timeout", "2",
                        "--record", record.string()});
  EXPECT_EQ(process.wait(patience), 1);
  const auto bytes = tools::read_file(record);
  ASSERT_TRUE(bytes) << bytes.error().message;
  const auto frames = decode_json_frames({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
  ASSERT_TRUE(frames) << frames.error().message;
  EXPECT_FALSE(frames->empty());
}

TEST(NativeClient, PicturesOfAStreamThatStops_AreWrittenOfWhatCame) {
  const SampleServer server;
  server.create_stream("brief");
  server.post_frames("brief", R"([{"faps":{"3":40}}])");
  const std::filesystem::path out = server.folder() / "brief";
  ChildProcess process({SEMBLANTE_CLIENT, server.url(), "--stream", "brief", "--model", "sample", "--frames", "1000",
                        "--timeout", "2", "--format", "table", "--format", "obj", "--out", out.string()});
  EXPECT_EQ(process.wait(patience), 1);
  EXPECT_TRUE(std::filesystem::exists(out / "frame-00000.obj"));
  EXPECT_TRUE(std::filesystem::exists(out / "frames.csv"));
}

TEST(NativeClient, ALevelOfDetail_AnimatesLikeTheFullMesh) {
  const SampleServer server;
  const auto full = client::load_face(server.http(), "sample");
  const auto light = client::load_face(server.http(), "sample", {.lod = std::nullopt, .max_vertices = 5000});
  ASSERT_TRUE(full && light);
  EXPECT_EQ(full->rig().lod, 0U);
  EXPECT_EQ(light->rig().lod, 1U);
  EXPECT_LE(light->rig().mesh.vertices, 5000U);
  semblante_frame smile{};
  smile.expression1 = 1;
  smile.intensity1 = SEMBLANTE_BLEND_MAX;
  for (const client::Face* face : {&*full, &*light}) {
    ASSERT_EQ(semblante_head_set_interpolated(face->head(), &smile, &smile, 0.0F), SEMBLANTE_OK);
  }
  const auto fine = full->positions();
  const auto coarse = light->positions();
  const float quantum = 2e-3F * glm::distance(full->rig().bounds_min, full->rig().bounds_max);
  float moved = 0.0F;
  for (std::size_t i = 0; i < full->rig().feature_points.size(); ++i) {
    const auto& point = full->rig().feature_points[i];
    const auto& same = light->rig().feature_points[i];
    ASSERT_EQ(point.vertex.has_value(), same.vertex.has_value()) << to_string(point.id);
    if (!point.vertex) {
      continue;
    }
    EXPECT_LT(glm::distance(fine[*point.vertex], coarse[*same.vertex]), quantum) << to_string(point.id);
    moved = std::max(moved, glm::distance(coarse[*same.vertex], same.position));
  }
  EXPECT_GT(moved, 3.0F * quantum) << "a smile moves the lips";
}

TEST(NativeClient, WrongIdsAndMixedPackages_AreRefusedWithTheReason) {
  const SampleServer server;
  const auto no_model = client::load_face(server.http(), "nobody");
  ASSERT_FALSE(no_model);
  EXPECT_EQ(no_model.error().code, ErrorCode::missing) << no_model.error().message;
  const auto no_stream = client::StreamSocket::open(server.http().server(), "nothing");
  ASSERT_FALSE(no_stream);
  EXPECT_EQ(no_stream.error().code, ErrorCode::missing) << no_stream.error().message;

  auto bytes = client::fetch_package(server.http(), "sample");
  ASSERT_TRUE(bytes) << bytes.error().message;
  ASSERT_TRUE(client::Face::create(*bytes));
  // The table of another mesh, itself in order.
  auto table = decode_weights({reinterpret_cast<const std::uint8_t*>(bytes->weights.data()), bytes->weights.size()});
  ASSERT_TRUE(table);
  table->mesh_sha256[31] ^= 1U;
  const std::vector<std::uint8_t> other = encode_weights(*table);
  client::PackageBytes mixed = *bytes;
  mixed.weights.assign(other.begin(), other.end());
  const auto face = client::Face::create(mixed);
  ASSERT_FALSE(face);
  EXPECT_EQ(face.error().code, ErrorCode::mismatch) << face.error().message;
}

}  // namespace
}  // namespace semblante::testing
