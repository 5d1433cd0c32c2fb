#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <unistd.h>
#include <vector>

#include "server/recordings/recording_format.h"

namespace semblante::recordings {

/// A folder of its own that goes with the test.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "semblante-recordings-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

inline Header stream_header() {
  Header header;
  header.stream = "talk";
  header.title = "A talk";
  header.model = "head";
  header.epoch = 7;
  header.sequence = 41;
  header.media_time = 5000;
  header.server_time = 1'750'000'000'000.0;
  header.viseme_share = 0.25;
  return header;
}

/// Frames 42, 43, ... of a face that moves at random, 0 to 90 ms apart.
inline std::vector<RecordingFrame> random_frames(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<RecordingFrame> frames;
  RecordingFrame frame{42, 5010, {}};
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t fap = first_low_level_fap; fap < frame.state.level.size(); ++fap)
      if (random() % 4 == 0) frame.state.level[fap] = static_cast<std::int16_t>(random() % 401 - 200);
    frame.state.viseme = {static_cast<std::uint8_t>(random() % 15), static_cast<std::uint8_t>(random() % 15),
                          static_cast<std::uint8_t>(random() % 64)};
    frame.state.expression = {static_cast<std::uint8_t>(random() % 7), static_cast<std::uint8_t>(random() % 64), 0, 0};
    frames.push_back(frame);
    ++frame.sequence;
    frame.media_time += random() % 91;
  }
  return frames;
}

/// Frames as a stream hands them over: in batches of 1 to 5.
inline std::vector<Frames> in_batches(const std::vector<RecordingFrame>& frames, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Frames> batches;
  for (std::size_t i = 0; i < frames.size();) {
    Frames batch{frames[i].sequence, frames[i].media_time, {}};
    const std::size_t end = std::min<std::size_t>(frames.size(), i + 1 + random() % 5);
    for (; i < end; ++i)
      batch.frames.push_back({static_cast<std::uint32_t>(frames[i].media_time - batch.media_time), frames[i].state});
    batches.push_back(std::move(batch));
  }
  return batches;
}

inline std::vector<std::uint8_t> bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace semblante::recordings
