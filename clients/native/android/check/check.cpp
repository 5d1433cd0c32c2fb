// Follows a stream with the parts of the Android viewer that draw nothing, and prints the face and how its vertices
// move:
//
//   semblante-android-check http://HOST:PORT/view/STREAM FRAMES
//
// For machines without Android: an emulator of aarch64 runs it in the tests.

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "clients/native/viewer/address.h"
#include "clients/native/viewer/follower.h"

using namespace semblante;

namespace {

constexpr std::chrono::seconds patience(120);

int run(const char* address, int frames) {
  const auto stream = viewer::parse_stream_address(address);
  const auto url = stream ? client::parse_url(stream->server) : Result<client::Url>(stream.error());
  if (!url) {
    std::printf("error %s\n", url.error().message.c_str());
    return 1;
  }
  viewer::Follower follower(*url, stream->stream, "", 20'000);
  std::unique_ptr<viewer::LoadedFace> loaded;
  std::string words;
  const auto end = std::chrono::steady_clock::now() + patience;
  double last = -1;
  while (frames > 0 && std::chrono::steady_clock::now() < end) {
    if (auto face = follower.take_face()) {
      loaded = std::move(face);
      std::printf("face %s vertices %u triangles %zu images %zu\n", loaded->face.rig().name.c_str(),
                  loaded->face.rig().mesh.vertices, loaded->scene.triangles.size(), loaded->scene.textures.size());
    }
    const viewer::Now now = follower.now();
    if (now.words != words) {
      words = now.words;
      if (!words.empty()) std::printf("words %s\n", words.c_str());
    }
    if (loaded && now.header && now.frame && now.frame->media_time != last) {
      last = now.frame->media_time;
      loaded->face.play_by(*now.header);
      const auto& frame = *now.frame;
      static_cast<void>(
          semblante_head_set_interpolated(loaded->face.head(), &frame.from.frame, &frame.to.frame, frame.t));
      double sum = 0;
      const auto positions = loaded->face.positions();
      for (std::size_t v = 0; v < positions.size(); ++v) {
        const auto d = positions[v] - loaded->scene.rest[v];
        sum += std::sqrt(static_cast<double>(d.x * d.x + d.y * d.y + d.z * d.z));
      }
      std::printf("frame %.1f moved %.9g\n", frame.media_time, sum / static_cast<double>(positions.size()));
      --frames;
    }
    std::fflush(stdout);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return frames == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  return run(argv[1], std::atoi(argv[2]));
}
