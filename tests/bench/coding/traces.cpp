#include "tests/bench/coding/traces.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>

#include "core/performance/performance.h"
#include "protocol/cpp/fap_file_frames.h"
#include "protocol/cpp/kernel_values.h"
#include "protocol/cpp/performance_document.h"

namespace semblante::bench {
namespace {

std::string read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<TimedFrame> played(const PerformanceScript& script, double frames_per_second) {
  const auto performance = Performance::compile(script);
  if (!performance) throw std::runtime_error(performance.error().where + ": " + performance.error().message);
  std::vector<TimedFrame> frames;
  for (int i = 0; i * 1000.0 / frames_per_second < performance->duration(); ++i) {
    const double time = std::round(i * 1000.0 / frames_per_second);
    frames.push_back({static_cast<std::uint32_t>(time), quantized(performance->frame_at(time))});
  }
  return frames;
}

/// The same numbers with every standard library, which distributions are not.
class Chance {
 public:
  explicit Chance(unsigned seed) : random_(seed) {}
  double between(double low, double high) { return low + (high - low) * static_cast<double>(random_() % 10001) / 1e4; }
  double whole(double low, double high) { return std::floor(between(low, high)); }
  unsigned below(unsigned count) { return static_cast<unsigned>(random_() % count); }

 private:
  std::mt19937 random_;
};

}  // namespace

std::vector<Trace> samples() {
  const char* folder = std::getenv("SEMBLANTE_SAMPLES_DIR");
  std::vector<Trace> traces;
  if (folder == nullptr || !std::ifstream(std::string(folder) + "/joy.fap")) return traces;
  for (const char* name : {"joy", "anger", "fear"}) {
    const auto file = read_fap_file(read(std::string(folder) + "/" + name + ".fap"));
    if (!file) throw std::runtime_error(file.error().where + ": " + file.error().message);
    const auto values = frames_of(file->file);
    if (!values) throw std::runtime_error(values.error().message);
    Trace trace{name, {}};
    for (const auto& frame : *values) trace.frames.push_back({frame.time, to_frame(frame.state)});
    traces.push_back(std::move(trace));
  }
  return traces;
}

Trace talking_minute(const std::string& source_folder) {
  auto script = read_performance(read(source_folder + "/protocol/examples/performances/minute.json"));
  if (!script) throw std::runtime_error(script.error().where + ": " + script.error().message);
  std::erase_if(script->cues, [](const Cue& cue) { return std::holds_alternative<FapTarget>(cue.target); });
  return {"talk", played(*script, 25)};
}

Trace made_up_talk(unsigned seed, double frames_per_second) {
  constexpr double end = 60'000;
  Chance chance(seed);
  PerformanceScript script;
  script.duration = end;
  script.idle = IdleLife{seed, chance.between(10, 22), chance.between(0.2, 0.7), chance.between(0.3, 0.8)};
  for (double time = 300; time < end - 1500; time += chance.whole(100, 1200)) {
    for (unsigned i = 4 + chance.below(20); i > 0 && time < end - 1500; --i) {
      Cue cue;
      cue.time = time;
      cue.duration = chance.whole(60, 220);
      cue.attack = std::min(std::floor(*cue.duration / 2), chance.whole(50, 100));
      cue.target = VisemeTarget{static_cast<std::uint8_t>(1 + chance.below(14)), 0};
      if (chance.below(4) == 0) cue.value = chance.between(0.6, 1);
      script.cues.push_back(cue);
      time += *cue.duration;
    }
  }
  const auto now_and_then = [&](double longest_gap, double longest, const auto& target) {
    for (double time = chance.whole(500, 2500); time < end - 6000; time += chance.whole(1500, longest_gap)) {
      Cue cue;
      cue.time = time;
      cue.duration = chance.whole(900, longest);
      cue.value = chance.between(0.3, 1);
      cue.target = target();
      script.cues.push_back(cue);
    }
  };
  now_and_then(8000, 5000, [&] { return ExpressionTarget{static_cast<std::uint8_t>(1 + chance.below(6))}; });
  now_and_then(6000, 3000, [&] {
    LookTarget look;
    look.yaw = chance.between(-25, 25);
    look.pitch = chance.between(-10, 12);
    return look;
  });
  now_and_then(6000, 2000, [&] {
    return HeadTarget{chance.between(-6, 8), chance.between(-9, 9), chance.between(-5, 5)};
  });
  std::stable_sort(script.cues.begin(), script.cues.end(), [](const Cue& a, const Cue& b) { return a.time < b.time; });
  return {"made-up talk " + std::to_string(seed), played(script, frames_per_second), 0.05};
}

Trace live_capture(unsigned seed) {
  Chance chance(seed);
  Trace trace{"live capture " + std::to_string(seed), {}, 0.03};
  std::vector<double> tremble(69, 0.0);
  std::vector<double> pace(69);
  std::vector<double> reach(69);
  for (std::size_t fap = 3; fap <= 68; ++fap) {
    pace[fap] = chance.between(0.02, 0.5);
    reach[fap] = chance.below(3) == 0 ? chance.between(20, 150) : 0.0;
  }
  double time = 0;
  for (int i = 0; i < 1800; ++i, time += 1000.0 / 30) {
    TimedFrame frame;
    frame.time = static_cast<std::uint32_t>(std::round(time + chance.between(0, 6)));
    for (std::size_t fap = 3; fap <= 60; ++fap) {
      if (fap >= 43 && fap <= 47) continue;  // nobody sees a tongue
      tremble[fap] = 0.9 * tremble[fap] + chance.between(-5, 5);
      frame.state.level[fap] =
          static_cast<std::int16_t>(std::lround(tremble[fap] + reach[fap] * std::sin(pace[fap] * i)));
    }
    trace.frames.push_back(frame);
  }
  return trace;
}

std::vector<Trace> made_up_traces() {
  std::vector<Trace> traces;
  for (unsigned seed = 1; seed <= 8; ++seed) traces.push_back(made_up_talk(seed, seed <= 5 ? 25 : seed <= 7 ? 30 : 60));
  traces.push_back(live_capture(9));
  traces.push_back(live_capture(10));
  return traces;
}

}  // namespace semblante::bench
