#include "protocol/cpp/fap_file_frames.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/types/decimal.h"
#include "protocol/cpp/fap_number.h"

namespace semblante {
namespace {

constexpr std::size_t first_fap = first_low_level_fap;
constexpr std::size_t last_fap = last_low_level_fap;
constexpr double ms_per_s = 1000.0;
constexpr double lone_frame_rate = 25.0;

/// Advances `state` from the frame before to `frame`.
void advance(FaceValues& state, const FapFileFrame& frame, AbsentFap absent) {
  if (absent == AbsentFap::zero) state = {};
  if (frame.present[1]) state.viseme = {frame.viseme.select1, frame.viseme.select2, frame.viseme.blend};
  if (frame.present[2]) {
    const auto& e = frame.expression;
    state.expression = {e.select1, e.intensity1, e.select2, e.intensity2};
  }
  for (std::size_t fap = first_fap; fap <= last_fap; ++fap) {
    if (frame.present[fap]) state.fap[fap] = frame.value[fap];
  }
}

std::uint8_t step_between(std::uint8_t a, std::uint8_t b, double t) {
  return static_cast<std::uint8_t>(std::lround(a + t * (b - a)));
}

/// A value that a file can represent: clamped, small values as 0, and rounded if `whole`.
double sayable(double value, bool whole) {
  value = std::clamp(whole ? std::round(value) : value, -max_fap_value, max_fap_value);
  return std::abs(value) < least_fap_value ? 0.0 : value;
}

FapFileFrame to_file_frame(const FaceValues& state, std::uint32_t number, const std::bitset<69>& mask, bool whole) {
  FapFileFrame frame;
  frame.number = number;
  frame.present = mask;
  frame.viseme = {state.viseme.select1, state.viseme.select2, state.viseme.blend, 0};
  const auto& e = state.expression;
  frame.expression = {e.select1, e.intensity1, e.select2, e.intensity2, 0, 0};
  for (std::size_t fap = first_fap; fap <= last_fap; ++fap) {
    if (mask[fap]) frame.value[fap] = sayable(state.fap[fap], whole);
  }
  return frame;
}

/// FAPs that any frame uses.
std::bitset<69> used(std::span<const TimedValues> frames, bool whole) {
  std::bitset<69> mask;
  for (const auto& [time, state] : frames) {
    if (!(state.viseme == VisemeBlend{})) mask.set(1);
    if (!(state.expression == ExpressionBlend{})) mask.set(2);
    for (std::size_t fap = first_fap; fap <= last_fap; ++fap) {
      if (sayable(state.fap[fap], whole) != 0.0) mask.set(fap);
    }
  }
  return mask;
}

}  // namespace

FaceValues between(const FaceValues& a, const FaceValues& b, double t) {
  FaceValues state = a;
  if (a.viseme.select1 == b.viseme.select1 && a.viseme.select2 == b.viseme.select2) {
    state.viseme.blend = step_between(a.viseme.blend, b.viseme.blend, t);
  }
  if (a.expression.select1 == b.expression.select1 && a.expression.select2 == b.expression.select2) {
    state.expression.intensity1 = step_between(a.expression.intensity1, b.expression.intensity1, t);
    state.expression.intensity2 = step_between(a.expression.intensity2, b.expression.intensity2, t);
  }
  for (std::size_t fap = first_fap; fap <= last_fap; ++fap) state.fap[fap] = a.fap[fap] + t * (b.fap[fap] - a.fap[fap]);
  return state;
}

Result<std::vector<TimedValues>> frames_of(const FapFile& file, const FapFileMeaning& meaning) {
  assert(!file.frames.empty());
  const auto time_of = [&](std::uint32_t number) {
    return static_cast<std::uint32_t>(std::lround(number * ms_per_s / file.rate));
  };
  const double seconds = file.frames.back().number / file.rate;
  if (seconds * ms_per_s > max_frame_time) {
    return Error{ErrorCode::out_of_range, "", "the file lasts longer than 24 hours"};
  }
  std::vector<TimedValues> frames;
  FaceValues state;
  std::uint32_t before = 0;
  for (const auto& frame : file.frames) {
    if (meaning.gap == FrameGap::hold && frame.number > before + 1)
      frames.push_back({time_of(frame.number - 1), state});
    advance(state, frame, meaning.absent);
    frames.push_back({time_of(frame.number), state});
    before = frame.number;
  }
  return frames;
}

double rate_of(std::span<const TimedValues> frames) {
  if (frames.size() < 2 || frames.back().time == frames.front().time) return lone_frame_rate;
  const auto on_a_frame = [&](const TimedValues& frame, double rate) {
    const double since = frame.time - frames.front().time;
    return std::abs(std::round(since * rate / ms_per_s) * ms_per_s / rate - since) <= 0.5;
  };
  for (int rate = 1; rate < ms_per_s; ++rate) {
    if (std::all_of(frames.begin(), frames.end(), [&](const TimedValues& f) { return on_a_frame(f, rate); }))
      return rate;
  }
  return ms_per_s;  // a frame every millisecond: every whole ms is the time of a frame
}

Result<FapFile> fap_file_of(std::span<const TimedValues> frames, const FapFileStyle& style,
                            const FapFileLimits& limits) {
  if (frames.empty()) return Error{ErrorCode::empty, "", "there is no frame"};
  FapFile file;
  file.name = style.name;
  file.rate = style.rate > 0 ? style.rate : rate_of(frames);
  const auto number_of = [&](const TimedValues& frame) {
    return std::round((frame.time - frames.front().time) * file.rate / ms_per_s);
  };
  if (number_of(frames.back()) >= static_cast<double>(limits.frames)) {
    return Error{ErrorCode::too_large, "", "a .fap file has at most " + natural_text(limits.frames) + " frames"};
  }
  const auto mask = used(frames, style.whole_values);
  const auto add = [&](const FaceValues& state, std::size_t number) {
    file.frames.push_back(to_file_frame(state, static_cast<std::uint32_t>(number), mask, style.whole_values));
  };
  const FaceValues* before = nullptr;  ///< the state last written
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto number = static_cast<std::size_t>(number_of(frames[i]));
    if (i + 1 < frames.size() && number_of(frames[i + 1]) == static_cast<double>(number)) continue;  // the last is used
    if (before == nullptr) before = &frames[i].state;
    const std::size_t begin = file.frames.size();  // one after the last written frame
    for (std::size_t k = begin; k < number; ++k) {
      const double t = static_cast<double>(k + 1 - begin) / static_cast<double>(number + 1 - begin);
      add(between(*before, frames[i].state, t), k);
    }
    add(frames[i].state, number);
    before = &frames[i].state;
  }
  return file;
}

}  // namespace semblante
