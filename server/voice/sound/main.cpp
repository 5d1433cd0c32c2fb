// Reads a sound file and writes its sound as a voice does (README.md), by libsndfile.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iostream>
#include <memory>
#include <samplerate.h>
#include <sndfile.h>
#include <string>
#include <string_view>
#include <vector>

#include <sys/resource.h>

#include "server/jobs/isolation.h"
#include "server/voice/program.h"
#include "server/voice/voice_protocol.h"

namespace semblante::voice {
namespace {

constexpr int most_channels = 8, least_rate = 1'000, most_rate = 384'000;
constexpr std::size_t block = 16'384;  // samples of a line

/// The file in memory, for libsndfile.
struct Bytes {
  std::string_view all;
  sf_count_t at = 0;
};

SF_VIRTUAL_IO memory_io() {
  SF_VIRTUAL_IO io{};
  io.get_filelen = [](void* user) { return static_cast<sf_count_t>(static_cast<Bytes*>(user)->all.size()); };
  io.seek = [](sf_count_t offset, int from, void* user) -> sf_count_t {
    auto& bytes = *static_cast<Bytes*>(user);
    const auto size = static_cast<sf_count_t>(bytes.all.size());
    const sf_count_t base = from == SEEK_SET ? 0 : from == SEEK_CUR ? bytes.at : size;
    if (offset < -base || offset > size - base) return -1;
    return bytes.at = base + offset;
  };
  io.read = [](void* to, sf_count_t count, void* user) {
    auto& bytes = *static_cast<Bytes*>(user);
    const sf_count_t here = std::clamp<sf_count_t>(count, 0, static_cast<sf_count_t>(bytes.all.size()) - bytes.at);
    std::memcpy(to, bytes.all.data() + bytes.at, static_cast<std::size_t>(here));
    bytes.at += here;
    return here;
  };
  io.write = [](const void*, sf_count_t, void*) -> sf_count_t { return 0; };
  io.tell = [](void* user) { return static_cast<Bytes*>(user)->at; };
  return io;
}

class Writer {
 public:
  explicit Writer(std::uint32_t rate) : most_(static_cast<std::size_t>(max_seconds * rate)) {}
  void write(const float* samples, std::size_t count) {
    for (std::size_t first = 0; first < count && !too_long; first += block) {
      const std::size_t here = std::min(block, count - first);
      too_long = written_ + here > most_;
      if (too_long) return;
      line_.resize(here);
      for (std::size_t i = 0; i < here; ++i) {
        const float value = samples[first + i];  // a float in a file may be no number
        line_[i] = std::isfinite(value)
                       ? static_cast<std::int16_t>(std::lround(std::clamp(value, -1.0F, 1.0F) * 32767.0F))
                       : std::int16_t{0};
      }
      written_ += here;
      const std::string line = audio_line(line_);
      say(line);
    }
  }
  bool too_long = false;

 private:
  std::vector<std::int16_t> line_;
  std::size_t written_ = 0, most_;
};

/// Standard input to its end, or its first `most` bytes; memory for what there is, as most files are small.
std::string read_input(std::size_t most) {
  constexpr std::size_t step = std::size_t{1} << 20U;
  std::string file;
  while (std::cin && file.size() < most) {
    const auto before = file.size();
    file.resize(std::min(before + step, most));
    std::cin.read(file.data() + before, static_cast<std::streamsize>(file.size() - before));
    file.resize(before + static_cast<std::size_t>(std::cin.gcount()));
  }
  return file;
}

int run() {
  const std::string file = read_input(max_sound_file_bytes + 1);
  if (file.size() > max_sound_file_bytes)
    return refuse("is longer than " + std::to_string(max_sound_file_bytes >> 20U) + " MiB");
  const rlimit none{0, 0};
  if (::setrlimit(RLIMIT_NOFILE, &none) != 0) return refuse("cannot forbid itself to open files");
  if (const auto isolated = jobs::isolate_this_process({}, {.highest_landlock = 0}); !isolated)
    return refuse(isolated.error().message);

  Bytes bytes{file};
  SF_VIRTUAL_IO io = memory_io();
  SF_INFO info{};
  const std::unique_ptr<SNDFILE, decltype(&sf_close)> sound(sf_open_virtual(&io, SFM_READ, &info, &bytes), sf_close);
  if (!sound) return refuse("is no sound file that is known here: WAV, FLAC, Ogg with Vorbis or Opus, or MP3");
  if (info.channels < 1 || info.channels > most_channels) return refuse("must have one to eight channels");
  if (info.samplerate < least_rate || info.samplerate > most_rate)
    return refuse("must have 1,000 to 384,000 samples a second");
  const auto rate = std::clamp(static_cast<std::uint32_t>(info.samplerate), least_sample_rate, most_sample_rate);
  const double ratio = static_cast<double>(rate) / info.samplerate;
  int fault = 0;
  const std::unique_ptr<SRC_STATE, decltype(&src_delete)> converter(src_new(SRC_SINC_FASTEST, 1, &fault), src_delete);
  if (!converter) return refuse(src_strerror(fault));

  const std::string header = header_line("semblante-sound", rate);
  say(header);
  const auto channels = static_cast<std::size_t>(info.channels);
  std::vector<float> frames(block * channels), mixed(block);
  std::vector<float> converted(static_cast<std::size_t>(std::ceil(ratio * block)) + 16);
  Writer writer(rate);
  for (bool ended = false; !ended;) {
    const sf_count_t count = sf_readf_float(sound.get(), frames.data(), block);
    ended = count < static_cast<sf_count_t>(block);
    const auto here = static_cast<std::size_t>(std::max<sf_count_t>(0, count));
    for (std::size_t i = 0; i < here; ++i) {
      float sum = 0.0F;
      for (std::size_t c = 0; c < channels; ++c) sum += frames[i * channels + c];
      mixed[i] = sum / static_cast<float>(channels);
    }
    if (rate == static_cast<std::uint32_t>(info.samplerate)) {
      writer.write(mixed.data(), here);
    } else {
      SRC_DATA data{};
      data.data_in = mixed.data();
      data.input_frames = static_cast<long>(here);
      data.src_ratio = ratio;
      data.end_of_input = ended ? 1 : 0;
      do {  // at the end, until nothing is left in the converter
        data.data_out = converted.data();
        data.output_frames = static_cast<long>(converted.size());
        if (const int code = src_process(converter.get(), &data); code != 0) return refuse(src_strerror(code));
        writer.write(converted.data(), static_cast<std::size_t>(data.output_frames_gen));
        data.data_in += data.input_frames_used;
        data.input_frames -= data.input_frames_used;
      } while (data.input_frames > 0 || (ended && data.output_frames_gen > 0));
    }
    if (writer.too_long)
      return refuse("the sound is longer than " + std::to_string(static_cast<int>(max_seconds)) + " s");
    if (!std::cout) return 1;
  }
  return finish_answer();
}

}  // namespace
}  // namespace semblante::voice

int main() { return semblante::voice::run_program(semblante::voice::run); }
