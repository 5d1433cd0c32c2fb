#include "clients/runtime/speaker_life.h"

#include <algorithm>

namespace semblante::runtime {
namespace {

constexpr std::uint8_t first_vowel = 10;  ///< visemes 10 to 14
constexpr double phrase_pause = 150.0;    ///< a shorter one does not end a phrase
constexpr double nod_lead = 120.0, nod = 420.0, nod_degrees = 2.6, small_nod_degrees = 1.1;
constexpr double brow_lead = 140.0, brow_stay = 80.0, brow_fall = 200.0, brow_units = 90.0;  // ENS
constexpr double breath = 420.0, breath_degrees = 1.2, least_breath_pause = 200.0;
constexpr double glance_ramp = 100.0, glance_stay = 450.0, least_phrase_for_glance = 1500.0;
constexpr double turn = 700.0;
constexpr std::uint32_t long_word = 210;     ///< ms
constexpr double smoothing = 40.0;           ///< ms, in which a face that was waiting or far away comes near its place
constexpr double units_per_degree = 1745.3;  ///< 1e-5 rad
constexpr double least_degrees = 0.05, least_brow_units = 2.0;  ///< less is not seen, and is none

bool is_vowel(const SpeechScore::Step& step) { return step.viseme >= first_vowel; }

double smooth(double share) { return share * share * (3.0 - 2.0 * share); }

}  // namespace

double SpeakerLife::Gesture::at(double position) const {
  const double since = position - begin, left = rise + stay + fall - since;
  if (since <= 0.0 || left <= 0.0) return 0.0;
  return size * smooth(std::min({since / rise, left / fall, 1.0}));
}

std::vector<SpeakerLife::Phrase> SpeakerLife::phrases_of(const SpeechScore& score) {
  std::vector<Phrase> phrases;
  double silent = 0.0;
  bool goes_on = false;
  for (std::size_t i = 0; i < score.steps.size(); ++i) {
    const auto& step = score.steps[i];
    if (step.viseme == 0) {
      silent += static_cast<double>(step.end) - step.begin;
      continue;
    }
    goes_on = goes_on && silent < phrase_pause;
    if (!goes_on) phrases.push_back({i, i, silent});
    phrases.back().past = i + 1;
    goes_on = true;
    silent = 0.0;
  }
  return phrases;
}

void SpeakerLife::add(double begin, double rise, double stay, double fall, Channel channel, double size) {
  gestures_.push_back({begin, rise, stay, fall, channel, size});
}

void SpeakerLife::begin(const SpeechScore& score) {
  gestures_.clear();
  phrase_ends_.clear();
  for (const Phrase& phrase : phrases_of(score)) {
    live(score, phrase);
    phrase_ends_.push_back(score.steps[phrase.past - 1].end);
  }
}

void SpeakerLife::live(const SpeechScore& score, const Phrase& phrase) {
  const double begin = score.steps[phrase.first].begin, end = score.steps[phrase.past - 1].end;
  if (phrase.pause >= least_breath_pause) {
    const double length = std::min(breath, phrase.pause);
    add(begin - length, 0.4 * length, 0.0, 0.6 * length, pitch, -breath_degrees);
    if (random_.next() < 0.4) {
      add(begin - phrase.pause, 0.4 * turn, 0.0, 0.6 * turn, yaw, random_.between(-2.0, 2.0));
      add(begin - phrase.pause, 0.4 * turn, 0.0, 0.6 * turn, roll, random_.between(-1.5, 1.5));
    }
  }
  // Words with their longest vowels; of equals the later one, because stress falls late in phrases.
  struct Word {
    std::uint32_t begin, end;
    const SpeechScore::Step* vowel;
  };
  std::vector<Word> words;
  const SpeechScore::Step* stressed = nullptr;
  const auto is_longer = [](const SpeechScore::Step& step, const SpeechScore::Step* than) {
    return than == nullptr || step.end - step.begin >= than->end - than->begin;
  };
  for (std::size_t i = phrase.first; i < phrase.past; ++i) {
    const auto& step = score.steps[i];
    if (words.empty() || step.begins_word) words.push_back({step.begin, step.end, nullptr});
    words.back().end = step.end;
    if (!is_vowel(step)) continue;
    if (is_longer(step, words.back().vowel)) words.back().vowel = &step;
    if (is_longer(step, stressed)) stressed = &step;
  }
  double last = -2.0 * nod;
  for (const Word& word : words) {
    if (word.vowel == nullptr) continue;
    const double at = word.vowel->begin;
    if (word.vowel == stressed) {
      const double size = random_.between(0.8, 1.2);
      add(at - nod_lead, 0.4 * nod, 0.0, 0.6 * nod, pitch, size * nod_degrees);
      add(at - brow_lead, brow_lead, brow_stay, brow_fall, brow, size * brow_units);
    } else if (word.end - word.begin >= long_word && at - last >= nod && random_.next() < 0.6) {
      add(at - nod_lead, 0.4 * nod, 0.0, 0.6 * nod, pitch, random_.between(0.6, 1.2) * small_nod_degrees);
    } else {
      continue;
    }
    last = at;
  }
  if (end - begin < least_phrase_for_glance) return;
  const double from = begin + random_.between(100.0, 500.0);
  add(from, glance_ramp, glance_stay, glance_ramp, eye_yaw,
      (random_.next() < 0.5 ? -1.0 : 1.0) * random_.between(4.0, 9.0));
  add(from, glance_ramp, glance_stay, glance_ramp, eye_pitch, random_.between(-4.0, 5.0));
}

void SpeakerLife::move(double position, double elapsed) {
  std::array<double, channels> wanted{};
  for (const Gesture& gesture : gestures_) wanted[gesture.channel] += gesture.at(position);
  // A first-order low-pass filter; the series stands for the exponential function, which the runtime does without.
  const double steps = elapsed / smoothing;
  const double share = 1.0 - 1.0 / (1.0 + steps * (1.0 + steps * (0.5 + steps / 6.0)));
  for (std::size_t i = 0; i < channels; ++i) {
    now_[i] += share * (wanted[i] - now_[i]);
    const double least = i == brow ? least_brow_units : least_degrees;
    if (wanted[i] == 0.0 && now_[i] < least && now_[i] > -least) now_[i] = 0.0;
  }
}

bool SpeakerLife::phrase_ends(double from, double to) const {
  return std::any_of(phrase_ends_.begin(), phrase_ends_.end(), [&](double end) { return from < end && end <= to; });
}

bool SpeakerLife::is_at_rest() const {
  return std::all_of(now_.begin(), now_.end(), [](double value) { return value == 0.0; });
}

void SpeakerLife::show(semblante_frame& frame, double brows) const {
  const auto turn_by = [&](std::size_t fap, Channel channel) {
    frame.fap[fap] += static_cast<float>(units_per_degree * now_[channel]);
  };
  turn_by(48, pitch);
  turn_by(49, yaw);
  turn_by(50, roll);
  for (const std::size_t fap : {23U, 24U}) turn_by(fap, eye_yaw);
  for (const std::size_t fap : {25U, 26U}) turn_by(fap, eye_pitch);
  for (std::size_t fap = 31; fap <= 36; ++fap) frame.fap[fap] += static_cast<float>(brows * now_[brow]);
}

}  // namespace semblante::runtime
