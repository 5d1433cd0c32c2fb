// Speech on heads, measured on the mesh against the sound: closures, and the mouth in step with the voice. Prints the
// figures.
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "tests/bench/speech/speech_figures.h"

namespace semblante::bench {
namespace {

TEST(SpeechOnHeads, EveryBilabialCloses_WithinAFrame_AtSpeedAndInJoy) {
  for (const Speaker& speaker : speakers()) {
    for (const Pangram& pangram : pangrams()) {
      for (const auto& [rate, joy] : {std::pair{1.0, false}, std::pair{1.0, true}, std::pair{1.8, false}}) {
        const Utterance said = say(SEMBLANTE_VOICE_ESPEAK, pangram, rate);
        std::vector<EmotionSpan> emotions;
        if (joy) emotions.push_back({1, 1.0, {0, 1000}});
        const Closures closed =
            closures(speaker, said, pangram.language, face_of(said, pangram.language, emotions), 10.0);
        EXPECT_GE(closed.count, 6);
        EXPECT_LE(closed.worst, 0.1) << speaker.face.head().name << ", " << pangram.language << " at "
                                     << closed.worst_at << " ms";
        EXPECT_GE(closed.shortest, 30.0) << speaker.face.head().name << ", " << pangram.language << ", rate " << rate;
        std::printf("%-14s %-6s rate %.1f %-4s %2d closures, the worst open by %.1f %% of \"a\"\n",
                    speaker.face.head().name.c_str(), pangram.language, rate, joy ? "joy" : "", closed.count,
                    100.0 * closed.worst);
      }
    }
  }
}

TEST(SpeechOnHeads, TheMouthOpensWithTheSound) {
  for (const Speaker& speaker : speakers()) {
    for (const Pangram& pangram : pangrams()) {
      const Utterance said = say(SEMBLANTE_VOICE_ESPEAK, pangram);
      const Step step = in_step(speaker, said, pangram.language, face_of(said, pangram.language));
      std::printf("%-14s %-6s lag %+.0f ms, correlation %.2f\n", speaker.face.head().name.c_str(), pangram.language,
                  step.lag, step.correlation);
      EXPECT_LE(std::abs(step.lag), 40.0) << speaker.face.head().name << ", " << pangram.language;
      EXPECT_GE(step.correlation, 0.5) << speaker.face.head().name << ", " << pangram.language;
      EXPECT_GT(step.vowels, 0.0) << "louder vowels open wider";
    }
  }
}

}  // namespace
}  // namespace semblante::bench
