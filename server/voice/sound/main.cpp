// Reads a sound file and writes its sound as a voice does (README.md), by libsndfile.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iostream>
#include <memory>
#include <optional>
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

/// All of a sound, mixed to one channel of this rate. Returns what is wrong with it; empty: nothing.
std::string write_sound(SNDFILE& sound, const SF_INFO& info, std::uint32_t rate, Writer& writer) {
  const double ratio = static_cast<double>(rate) / info.samplerate;
  int fault = 0;
  const std::unique_ptr<SRC_STATE, decltype(&src_delete)> converter(src_new(SRC_SINC_FASTEST, 1, &fault), src_delete);
  if (!converter) return src_strerror(fault);

  const auto channels = static_cast<std::size_t>(info.channels);
  std::vector<float> frames(block * channels), mixed(block);
  std::vector<float> converted(static_cast<std::size_t>(std::ceil(ratio * block)) + 16);
  for (bool ended = false; !ended;) {
    const sf_count_t count = sf_readf_float(&sound, frames.data(), block);
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
        if (const int code = src_process(converter.get(), &data); code != 0) return src_strerror(code);
        writer.write(converted.data(), static_cast<std::size_t>(data.output_frames_gen));
        data.data_in += data.input_frames_used;
        data.input_frames -= data.input_frames_used;
      } while (data.input_frames > 0 || (ended && data.output_frames_gen > 0));
    }
    if (writer.too_long) return "the sound is longer than " + std::to_string(static_cast<int>(max_seconds)) + " s";
    if (!std::cout) break;
  }
  return {};
}

/// The sounds of a file: of an Ogg file its streams one after another, as a recording of a radio has them, of any other
/// file itself. libsndfile reads only the first of them.
std::vector<std::string_view> sounds_in(std::string_view file) {
  constexpr std::size_t header = 27;  // of a page, before its table of segments
  constexpr unsigned char first_page = 2;
  std::vector<std::string_view> sounds;
  std::size_t at = 0, begin = 0;
  bool within = false;  // past the first pages, of which a stream has one for each of its tracks
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(file[i]); };
  while (file.size() - at >= header && file.substr(at, 4) == "OggS") {
    const bool first = (byte(at + 5) & first_page) != 0;
    if (first && within) {
      sounds.push_back(file.substr(begin, at - begin));
      begin = at;
    }
    within = !first;
    const std::size_t segments = byte(at + 26);
    std::size_t size = header + segments;
    for (std::size_t i = 0; i < segments && at + header + i < file.size(); ++i) size += byte(at + header + i);
    at += std::min(size, file.size() - at);
  }
  sounds.push_back(file.substr(begin));
  return sounds;
}

int run() {
  const std::string file = read_input(max_sound_file_bytes + 1);
  if (file.size() > max_sound_file_bytes)
    return refuse("is longer than " + std::to_string(max_sound_file_bytes >> 20U) + " MiB");
  const rlimit none{0, 0};
  if (::setrlimit(RLIMIT_NOFILE, &none) != 0) return refuse("cannot forbid itself to open files");
  if (const auto isolated = jobs::isolate_this_process({}, {.highest_landlock = 0}); !isolated)
    return refuse(isolated.error().message);

  std::optional<Writer> writer;
  std::uint32_t rate = 0;
  for (const std::string_view part : sounds_in(file)) {
    Bytes bytes{part};
    SF_VIRTUAL_IO io = memory_io();
    SF_INFO info{};
    const std::unique_ptr<SNDFILE, decltype(&sf_close)> sound(sf_open_virtual(&io, SFM_READ, &info, &bytes), sf_close);
    if (!sound && writer) break;  // a file that is cut
    if (!sound) return refuse("is no sound file that is known here: WAV, FLAC, Ogg with Vorbis or Opus, or MP3");
    if (info.channels < 1 || info.channels > most_channels) return refuse("must have one to eight channels");
    if (info.samplerate < least_rate || info.samplerate > most_rate)
      return refuse("must have 1,000 to 384,000 samples a second");
    if (!writer) {
      rate = std::clamp(static_cast<std::uint32_t>(info.samplerate), least_sample_rate, most_sample_rate);
      writer.emplace(rate);
      const std::string header = header_line("semblante-sound", rate);
      say(header);
    }
    if (const std::string fault = write_sound(*sound, info, rate, *writer); !fault.empty()) return refuse(fault);
    if (!std::cout) return 1;
  }
  return finish_answer();
}

}  // namespace
}  // namespace semblante::voice

int main() { return semblante::voice::run_program(semblante::voice::run); }
