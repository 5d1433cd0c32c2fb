// From a microphone's sound to a mouth, without what a page adds: how long the listener waits for sound, in samples,
// and how long it works for a block, in the sizes that Web Audio gives.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "core/listen/live_mouth.h"

namespace {

using semblante::LiveMouth;
using semblante::VisemeListener;
using Clock = std::chrono::steady_clock;

constexpr std::uint32_t rate = 48'000;
constexpr std::size_t block = 128;
constexpr double seconds = 60.0;

/// Syllables of noise, three a second: what is heard costs the same as speech.
std::vector<float> syllables() {
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0.0F, 0.1F);
  std::vector<float> sound(static_cast<std::size_t>(seconds * rate));
  for (std::size_t n = 0; n < sound.size(); ++n)
    sound[n] = noise(random) * std::max(0.0F, std::sin(6.0F * 3.14159F * static_cast<float>(n) / rate));
  return sound;
}

}  // namespace

int main() {
  const auto sound = syllables();
  VisemeListener listener(rate);
  LiveMouth mouth;
  std::vector<double> work, delays;
  double total = 0.0;
  float rest = 0.0F;
  for (std::size_t first = 0; first + block <= sound.size(); first += block) {
    const auto begin = Clock::now();
    for (std::size_t at = first, taken = 0;; at += taken) {
      const auto heard = listener.push(std::span(sound).subspan(at, first + block - at), taken);
      if (!heard) break;
      rest += mouth.follow(*heard)[0];
      delays.push_back(1000.0 * static_cast<double>(first + block) / rate - heard->time);
    }
    work.push_back(std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
    total += work.back();
  }
  std::sort(work.begin(), work.end());
  std::sort(delays.begin(), delays.end());
  const auto at = [](const std::vector<double>& of, double share) {
    return of[static_cast<std::size_t>(std::lround(share * static_cast<double>(of.size() - 1)))];
  };
  std::printf(
      "waits for %.0f samples of %u Hz after the moment, %.1f ms; from the moment to the end of the block with which "
      "it is\n"
      "heard, ms: least %.1f, median %.1f, most %.1f; opening follows %.1f ms later, closing lips at once\n",
      VisemeListener::delay_ms * rate / 1000.0, rate, VisemeListener::delay_ms, at(delays, 0.0), at(delays, 0.5),
      at(delays, 1.0), LiveMouth::delay_ms);
  std::printf(
      "work for a block of %zu samples (%.2f ms), ms: median %.4f, 95 in 100 %.4f, 99 in 100 %.4f, most %.4f; %.2f %% "
      "of the\n"
      "time of the sound (mouth at rest for %.0f %%)\n",
      block, 1000.0 * block / rate, at(work, 0.5), at(work, 0.95), at(work, 0.99), at(work, 1.0), 0.1 * total / seconds,
      100.0 * static_cast<double>(rest) / static_cast<double>(delays.size()));
}
