#include "core/performance/idle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/performance/easing.h"

namespace semblante {
namespace {

// At full strength, degrees.
constexpr double glance_yaw = 7.0;
constexpr double glance_pitch = 3.5;
constexpr double drift_pitch = 3.0;
constexpr double drift_yaw = 5.0;
constexpr double drift_roll = 2.0;

constexpr double glance_interval = 1100.0;  ///< ms, mean
constexpr double glance_jump = 45.0;        ///< ms a small jump of the eyes takes
constexpr double blink_closing = 80.0;      ///< ms
constexpr double blink_opening = 160.0;

enum Channel : std::uint32_t { blink_gaps, glance_gaps, glance_yaws, glance_pitches, first_drift };

/// A 32-bit hash with full avalanche.
std::uint32_t mix(std::uint32_t x) {
  x ^= x >> 16U;
  x *= 0x7feb352dU;
  x ^= x >> 15U;
  x *= 0x846ca68bU;
  x ^= x >> 16U;
  return x;
}

/// A pseudo-random number 0..1 from a seed and indices. Stateless, for random access.
double uniform(std::uint32_t seed, std::uint32_t channel, std::uint32_t block, std::uint32_t index) {
  const std::uint32_t bits = mix(mix(mix(seed + channel * 0x9e3779b9U) + block) + index);
  return static_cast<double>(bits) / 4294967296.0;
}

/// Irregular events without state: time is divided into blocks of this many mean intervals. The intervals of a block
/// fill it exactly, so its last event is the start of the next block.
constexpr std::size_t events_per_block = 16;

struct Event {
  std::uint32_t block = 0;
  std::uint32_t index = 0;  ///< within the block, 0 at its beginning
  double since = 0.0;       ///< ms since it
};

/// The newest event at or before a time.
Event newest_event(std::uint32_t seed, std::uint32_t channel, double mean, double ms) {
  const double length = mean * static_cast<double>(events_per_block);
  const double block = std::floor(ms / length);
  Event event;
  event.block = static_cast<std::uint32_t>(std::fmod(block, 4294967296.0));
  std::array<double, events_per_block> gaps{};
  double sum = 0.0;
  for (std::size_t i = 0; i < events_per_block; ++i) {
    const double u = uniform(seed, channel, event.block, static_cast<std::uint32_t>(i));
    gaps[i] = 0.25 + 2.25 * u * u;  // mean 1, many short, few long
    sum += gaps[i];
  }
  const double within = ms - block * length;
  double at = 0.0;
  for (std::size_t i = 0; i < events_per_block; ++i) {
    const double next = at + gaps[i] / sum * length;
    if (within < next || i + 1 == events_per_block) {
      event.index = static_cast<std::uint32_t>(i);
      break;
    }
    at = next;
  }
  event.since = std::max(0.0, within - at);
  return event;
}

double closure_at(const IdleLife& idle, double ms) {
  if (idle.blinks_per_minute <= 0.0) return 0.0;
  const double mean = 60'000.0 / idle.blinks_per_minute;
  const Event blink = newest_event(idle.seed, blink_gaps, mean, ms);
  if (blink.block == 0 && blink.index == 0) return 0.0;  // no blink at time 0
  if (blink.since < blink_closing) return smooth_step(blink.since / blink_closing);
  return smooth_step(1.0 - (blink.since - blink_closing) / blink_opening);
}

/// The direction of a glance, -1..1: usually near the middle.
double aim(std::uint32_t seed, std::uint32_t channel, std::uint32_t block, std::uint32_t index) {
  const double u = 2.0 * uniform(seed, channel, block, index) - 1.0;
  return u * std::abs(u);
}

double glance_at(const IdleLife& idle, const Event& event, std::uint32_t channel) {
  const bool first = event.index == 0;
  const double now = aim(idle.seed, channel, event.block, event.index);
  const double before = first ? aim(idle.seed, channel, event.block - 1, events_per_block - 1)
                              : aim(idle.seed, channel, event.block, event.index - 1);
  return before + (now - before) * smooth_step(event.since / glance_jump);
}

/// Smooth noise, -1..1: random values at multiples of the period, interpolated with continuous second derivative.
double noise(std::uint32_t seed, std::uint32_t channel, double period, double ms) {
  const double cell = std::floor(ms / period);
  const double x = ms / period - cell;
  const auto number = static_cast<std::uint32_t>(std::fmod(cell, 4294967296.0));
  const double a = 2.0 * uniform(seed, channel, number, 0) - 1.0;
  const double b = 2.0 * uniform(seed, channel, number + 1, 0) - 1.0;
  return a + (b - a) * (x * x * x * (x * (x * 6.0 - 15.0) + 10.0));
}

double drift(const IdleLife& idle, std::uint32_t channel, double ms) {
  return 0.7 * noise(idle.seed, channel, 2900.0, ms) + 0.3 * noise(idle.seed, channel + 1, 1300.0, ms);
}

}  // namespace

IdleMotion idle_at(const IdleLife& idle, double ms) {
  ms = std::max(ms, 0.0);
  IdleMotion motion;
  motion.lid_closure = closure_at(idle, ms);
  if (idle.head > 0.0) {
    motion.head_pitch = idle.head * drift_pitch * drift(idle, first_drift, ms);
    motion.head_yaw = idle.head * drift_yaw * drift(idle, first_drift + 2, ms);
    motion.head_roll = idle.head * drift_roll * drift(idle, first_drift + 4, ms);
    motion.eye_pitch = -motion.head_pitch;
    motion.eye_yaw = -motion.head_yaw;
  }
  if (idle.eyes > 0.0) {
    const Event glance = newest_event(idle.seed, glance_gaps, glance_interval, ms);
    motion.eye_yaw += idle.eyes * glance_yaw * glance_at(idle, glance, glance_yaws);
    motion.eye_pitch += idle.eyes * glance_pitch * glance_at(idle, glance, glance_pitches);
  }
  return motion;
}

}  // namespace semblante
