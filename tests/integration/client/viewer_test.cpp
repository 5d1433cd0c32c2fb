// semblante-viewer on SDL's screen without a screen, against the real server.

#include <algorithm>
#include <array>
#include <cstdlib>

#include <gtest/gtest.h>
#include <stb/stb_image.h>

#include "clients/native/client/face_package.h"
#include "clients/native/render/renderer.h"
#include "protocol/cpp/quantizers.h"
#include "tests/integration/client/sample_server.h"
#include "tests/support/tcp_proxy.h"
#include "tests/support/wait.h"

namespace semblante::testing {
namespace {

constexpr int side = 256;
/// Of a window's picture and a file's of the same face, in levels of 255 on average over all channels: four samples a
/// pixel instead of nine differ at edges. 0.4 was measured, and 78 for a single pixel.
constexpr double largest_mean_difference = 0.6;

render::Picture read_picture(const std::filesystem::path& path) {
  int width = 0;
  int height = 0;
  int channels = 0;
  stbi_uc* pixels = stbi_load(path.c_str(), &width, &height, &channels, 3);
  EXPECT_NE(pixels, nullptr) << path;
  render::Picture picture(width, height, {0, 0, 0});
  if (pixels != nullptr) std::copy_n(pixels, picture.rgb.size(), picture.rgb.begin());
  stbi_image_free(pixels);
  return picture;
}

std::vector<std::string> view(const std::string& address, const std::vector<std::string>& options) {
  setenv("SDL_VIDEODRIVER", "offscreen", 1);  // NOLINT(concurrency-mt-unsafe): before any thread
  std::vector<std::string> command = {SEMBLANTE_VIEWER, address, "--size", std::to_string(side), "--quality", "high"};
  command.insert(command.end(), options.begin(), options.end());
  return command;
}

std::string stream_address(const SampleServer& server, const std::string& stream) {
  return "ws" + server.url().substr(4) + "/v1/streams/" + stream;
}

/// The picture that semblante-render and semblante-client draw of these FAPs.
render::Picture drawn_to_a_file(const client::Face& face, const semblante_frame& frame) {
  const FeaturePointSet points = face.feature_points();
  auto scene = render::build_scene(face.model(), {.points = points, .role_of_vertex = face.roles()});
  EXPECT_TRUE(scene);
  auto renderer = render::Renderer::create(*std::move(scene));
  EXPECT_TRUE(renderer) << renderer.error().message;
  EXPECT_EQ(semblante_head_set_frame(face.head(), &frame), SEMBLANTE_OK);
  EXPECT_TRUE(renderer->set_positions(face.positions()));
  auto picture = renderer->draw(render::View::front, render::Subject::all, {side, side});
  EXPECT_TRUE(picture);
  return *std::move(picture);
}

TEST(Viewer, AStreamInAWindow_LooksLikeItsPictureInAFile) {
  const SampleServer server;
  server.create_stream("window");
  auto face = client::load_face(server.http(), "sample", {.lod = std::nullopt, .max_vertices = 20'000});
  ASSERT_TRUE(face) << face.error().message;
  for (const std::string& warning : client::fetch_images(server.http(), *face)) ADD_FAILURE() << warning;
  std::vector<render::Picture> windows;
  // The neutral face, and one with an open jaw that looks aside.
  for (const std::array<double, 2> faps : {std::array{0.0, 0.0}, std::array{800.0, 20'000.0}}) {
    const std::string frames = R"([{"faps":{"3":)" + std::to_string(faps[0]) + R"(,"49":)" + std::to_string(faps[1]);
    server.post_frames("window", frames + "}}]");
    const auto path = server.folder() / ("window-" + std::to_string(windows.size()) + ".png");
    ChildProcess process(view(stream_address(server, "window"), {"--picture", path.string(), "--after", "1"}));
    ASSERT_EQ(process.wait(patience), 0);
    windows.push_back(read_picture(path));
    // On the wire a FAP is a whole number of quantizer steps.
    const QuantizerSteps& steps = standard_quantizers();
    semblante_frame frame{};
    frame.fap[3] = static_cast<float>(*quantize(faps[0], steps[3]) * steps[3]);
    frame.fap[49] = static_cast<float>(*quantize(faps[1], steps[49]) * steps[49]);
    const render::Picture file = drawn_to_a_file(*face, frame);
    ASSERT_EQ(windows.back().rgb.size(), file.rgb.size());
    EXPECT_LT(render::mean_difference(windows.back(), file), largest_mean_difference);
    RecordProperty("mean_difference_" + std::to_string(windows.size()),
                   std::to_string(render::mean_difference(windows.back(), file)));
  }
  EXPECT_GT(render::mean_difference(windows[0], windows[1]), 5 * largest_mean_difference) << "the head has turned";
}

/// Of the pictures of two machines by the same rasterizer, in levels of 255 on average: 0.00003 was measured, five
/// values that differ by one.
constexpr double largest_difference_of_machines = 0.01;

// `tests/run --aarch64` builds that program and sets the variables. Mesa's llvmpipe makes code for the processor and
// ends the emulator; softpipe does not.
TEST(Viewer, OnAarch64_DrawsTheSamePicture) {
  const char* build = std::getenv("SEMBLANTE_AARCH64");
  const char* emulator = std::getenv("SEMBLANTE_AARCH64_EMULATOR");
  if (build == nullptr || emulator == nullptr) GTEST_SKIP() << "run by tests/run --aarch64";
  setenv("GALLIUM_DRIVER", "softpipe", 1);  // NOLINT(concurrency-mt-unsafe): before any thread
  const SampleServer server;
  server.create_stream("machines");
  server.post_frames("machines", R"([{"faps":{"3":800,"4":-200,"49":20000}}])");
  const std::string address = stream_address(server, "machines");
  const auto here = server.folder() / "here.png";
  const auto there = server.folder() / "there.png";
  ChildProcess native(view(address, {"--picture", here.string(), "--after", "1"}));
  ASSERT_EQ(native.wait(patience), 0);
  std::vector<std::string> command = view(address, {"--picture", there.string(), "--after", "1"});
  command[0] = std::string(build) + "/viewer/bin/semblante-viewer";
  const std::vector<std::string> emulated = {emulator, "-L", std::string(build) + "/system"};
  command.insert(command.begin(), emulated.begin(), emulated.end());
  ChildProcess foreign(command);
  ASSERT_EQ(foreign.wait(patience), 0);
  const double difference = render::mean_difference(read_picture(here), read_picture(there));
  EXPECT_LT(difference, largest_difference_of_machines);
  RecordProperty("mean_difference", std::to_string(difference));
}

TEST(Viewer, TheDemo_MovesAndComesBackAfterTheServerWasAway) {
  const SampleServer server;
  const auto& address = server.http().server().url;
  TcpProxy proxy({.target_port = static_cast<std::uint16_t>(std::stoi(address.port))});
  ChildProcess process(view("http://127.0.0.1:" + std::to_string(proxy.port()), {}));
  const auto expect_line = [&](const std::string& wanted) {
    std::string seen;
    for (int i = 0; i < 20; ++i) {
      const std::string line = process.read_line(patience);
      if (line.find(wanted) != std::string::npos) return;
      seen += line + "\n";
    }
    FAIL() << "instead of \"" << wanted << "\":\n" << seen;
  };
  expect_line("vertices");
  expect_line("showing");
  proxy.refuse(true);
  proxy.cut();
  expect_line("The connection was lost");
  proxy.refuse(false);
  expect_line("showing");
  process.interrupt();
  EXPECT_EQ(process.wait(patience), 0);
}

TEST(Viewer, NoSuchStream_SaysSoAndWaitsForIt) {
  const SampleServer server;
  const auto path = server.folder() / "late.png";
  ChildProcess process(view(stream_address(server, "late"), {"--picture", path.string()}));
  std::string line = process.read_line(patience);
  for (int i = 0; i < 5 && line.find("There is no stream \"late\"") == std::string::npos; ++i)
    line = process.read_line(patience);
  EXPECT_NE(line.find("There is no stream \"late\""), std::string::npos) << line;
  server.create_stream("late");
  server.post_frames("late", R"([{"faps":{"3":100}}])");
  EXPECT_EQ(process.wait(patience), 0);
  EXPECT_TRUE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace semblante::testing
