// What a voice said, carried over to a recording of the same sounds at other times.
#include "core/speech/alignment.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace semblante {
namespace {

/// A sound with two resonances in noise, or silence (no resonances), of so many ms.
struct Piece {
  double first_hz, second_hz, ms;
};

struct Made {
  std::vector<std::int16_t> samples;
  std::vector<double> begins;  ///< ms, of each piece
};

Made made(const std::vector<Piece>& pieces, std::uint32_t rate, double gain, unsigned seed) {
  using std::numbers::pi;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> noise(-1.0, 1.0);
  Made made;
  for (const Piece& piece : pieces) {
    made.begins.push_back(1000.0 * static_cast<double>(made.samples.size()) / rate);
    const auto count = static_cast<std::size_t>(piece.ms * rate / 1000.0);
    for (std::size_t i = 0; i < count; ++i) {
      const double t = static_cast<double>(i) / rate;
      double value = 0.0;
      if (piece.first_hz > 0.0)
        for (int k = 1; k < 30; ++k) {  // a voice at 120 Hz, its harmonics near the resonances stronger
          const double hz = 120.0 * k;
          const auto near = [hz](double resonance) { return 1.0 / (1.0 + std::pow((hz - resonance) / 120.0, 2.0)); };
          value += 0.15 * (near(piece.first_hz) + near(piece.second_hz)) * std::sin(2.0 * pi * hz * t);
        }
      made.samples.push_back(static_cast<std::int16_t>(gain * 32767.0 * (value + 0.002 * noise(random))));
    }
  }
  return made;
}

const std::vector<Piece> spoken = {{0, 0, 150},      {700, 1100, 110}, {300, 2300, 90},  {450, 900, 140},
                                   {600, 1700, 100}, {300, 800, 120},  {0, 0, 260},      {500, 1900, 90},
                                   {750, 1300, 130}, {320, 2000, 80},  {400, 1000, 150}, {0, 0, 200}};

Utterance model_of(const Made& voice, std::uint32_t rate) {
  Utterance model;
  model.sample_rate = rate;
  model.samples = voice.samples;
  for (std::size_t i = 0; i < spoken.size(); ++i)
    model.phonemes.push_back(
        {voice.begins[i], spoken[i].first_hz > 0.0 ? std::to_string(i) : std::string(), Stress::none});
  model.words = {{voice.begins[1], {0, 2}}, {voice.begins[7], {3, 2}}};
  model.sentences = {{voice.begins[1], 0}};
  return model;
}

TEST(Alignment, FollowsARecordingThatIsSlowerAndPausesElsewhere) {
  auto slower = spoken;
  for (std::size_t i = 0; i < slower.size(); ++i) slower[i].ms *= i % 3 == 0 ? 1.7 : 1.25;
  slower[0].ms = 900.0;
  slower[6].ms = 40.0;                             // no pause where the voice has one
  slower.insert(slower.begin() + 4, {0, 0, 500});  // one where the voice has none
  const Made voice = made(spoken, 22'050, 0.7, 1), person = made(slower, 16'000, 0.2, 2);
  const auto aligned = align(model_of(voice, 22'050), {16'000, person.samples});
  ASSERT_TRUE(aligned) << aligned.error().message;
  const Utterance& said = aligned->utterance;
  EXPECT_EQ(said.samples, person.samples);
  std::size_t found = 0, pauses = 0;
  for (std::size_t i = 0; i < said.phonemes.size(); ++i) {
    if (i > 0) {
      EXPECT_GE(said.phonemes[i].time, said.phonemes[i - 1].time);
    }
    if (said.phonemes[i].symbol.empty()) {
      ++pauses;
      continue;
    }
    const std::size_t piece = std::stoul(said.phonemes[i].symbol);
    EXPECT_NEAR(said.phonemes[i].time, person.begins[piece < 4 ? piece : piece + 1], 25.0) << piece;
    ++found;
  }
  EXPECT_EQ(found, 9U);
  EXPECT_EQ(pauses, 3U);  // before it, within it, after it
  EXPECT_NEAR(said.words[1].time, person.begins[8], 25.0);
}

TEST(Alignment, FindsThePauses) {
  const Made voice = made(spoken, 16'000, 0.5, 3);
  const auto pauses = pauses_of({16'000, voice.samples});
  ASSERT_EQ(pauses.size(), 3U);
  EXPECT_NEAR(pauses[1].begin, voice.begins[6], 20.0);
  EXPECT_NEAR(pauses[1].end, voice.begins[7], 20.0);
}

TEST(Alignment, ASoundThatCannotBeTheText_IsAnError) {
  const Made voice = made(spoken, 16'000, 0.5, 4);
  const Utterance model = model_of(voice, 16'000);
  for (const std::vector<std::int16_t>& silent :
       {std::vector<std::int16_t>{}, std::vector<std::int16_t>(10, 9), std::vector<std::int16_t>(32'000, 0)})
    EXPECT_EQ(align(model, {16'000, silent}).error().code, ErrorCode::empty) << silent.size();
  Made person = made(spoken, 16'000, 0.5, 4);
  for (int i = 0; i < 5; ++i) person.samples.insert(person.samples.end(), voice.samples.begin(), voice.samples.end());
  EXPECT_EQ(align(model, {16'000, person.samples}).error().code, ErrorCode::mismatch);
}

}  // namespace
}  // namespace semblante
