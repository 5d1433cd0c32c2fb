#include "core/speech/alignment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "core/speech/cepstra.h"

namespace semblante {
namespace {

constexpr double step = Cepstra::step_ms;
constexpr double below_loudest_db = 38.0, above_floor_db = 8.0, least_range_db = 6.0, silent_db = -70.0;
constexpr double kept_of_pause_ms = 30.0;  ///< at each of its ends, so that closures and hisses beside it align
constexpr double longest_click_ms = 50.0;  ///< between pauses; what is shorter is no speech
constexpr double most_stretch = 4.0;
constexpr double highest_hz = 6'500.0;
constexpr std::size_t coarse = 4;               ///< frames in one of the first pass
constexpr std::size_t most_cells = 50'000'000;  ///< of the first pass, a byte each
constexpr std::size_t radius = 25;              ///< frames around the coarse path
constexpr float off_diagonal = 0.5F;            ///< what a step costs in which one of the sounds stands still

/// Frames of coefficients and their changes, each with mean 0 and variance 1 over the sound.
constexpr std::size_t dimensions = 2 * Cepstra::coefficients;
using Features = std::vector<std::array<float, dimensions>>;

double percentile(std::vector<float> values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Runs of frames below the level of speech, first and one past the last.
std::vector<std::pair<std::size_t, std::size_t>> quiet_runs(const std::vector<float>& levels) {
  if (levels.empty()) return {};
  const double loudest = percentile(levels, 0.95), floor = percentile(levels, 0.02);
  const bool silent = loudest < silent_db || loudest - floor < least_range_db;
  double threshold = std::max(loudest - below_loudest_db, std::min(floor + above_floor_db, loudest - least_range_db));
  // A steady sound is all speech when it is loud, all silence when it is not.
  if (silent) threshold = loudest < silent_db ? std::numeric_limits<double>::max() : silent_db;
  const auto least = static_cast<std::size_t>(least_pause_ms / step);
  const auto click = static_cast<std::size_t>(longest_click_ms / step);
  const auto is_long = [least](const auto& run) { return run.second - run.first >= least; };
  // The ends count as runs, so that a click between an end and a pause is no speech either.
  std::vector<std::pair<std::size_t, std::size_t>> runs = {{0, 0}};
  const auto add = [&](std::size_t first, std::size_t end) {
    auto& last = runs.back();
    if (first - last.second <= click && (is_long(last) || end - first >= least))
      last.second = end;
    else
      runs.emplace_back(first, end);
  };
  for (std::size_t at = 0; at < levels.size();) {
    std::size_t end = at;
    while (end < levels.size() && levels[end] < threshold) ++end;
    if (end > at) add(at, end);
    at = end + 1;
  }
  add(levels.size(), levels.size());
  std::erase_if(runs, [&](const auto& run) {
    const bool at_end = run.first == 0 || run.second == levels.size();
    return run.first == run.second || (!is_long(run) && !at_end);
  });
  return runs;
}

/// A sound without the middle of its pauses.
struct Squeezed {
  Features features;
  std::vector<std::size_t> frame_of;  ///< frame of the sound, of each row
  std::vector<Interval> pauses;       ///< of the sound, ms

  /// The row of a time in the sound, ms: within a cut pause the row after it.
  [[nodiscard]] double row_of(double ms) const {
    const double frame = ms / step;
    const auto at = std::lower_bound(frame_of.begin(), frame_of.end(), static_cast<std::size_t>(std::max(0.0, frame)));
    const double row = static_cast<double>(at - frame_of.begin());
    const bool inside = at != frame_of.end() && static_cast<double>(*at) <= frame;
    return inside ? row + (frame - std::floor(frame)) : row;
  }
  [[nodiscard]] double ms_of(double row) const {
    if (frame_of.empty()) return 0.0;
    const auto at = std::min(frame_of.size() - 1, static_cast<std::size_t>(std::max(0.0, row)));
    return step * (static_cast<double>(frame_of[at]) + std::clamp(row - static_cast<double>(at), 0.0, 1.0));
  }
};

void normalize(Features& features) {
  for (std::size_t c = 0; c < dimensions; ++c) {
    double sum = 0.0, squares = 0.0;
    for (const auto& row : features) {
      sum += row[c];
      squares += double{row[c]} * row[c];
    }
    const auto count = static_cast<double>(features.size());
    const double mean = sum / count;
    const double deviation = std::sqrt(std::max(1e-6, squares / count - mean * mean));
    for (auto& row : features) row[c] = static_cast<float>((row[c] - mean) / deviation);
  }
}

Squeezed squeeze(std::span<const std::int16_t> samples, std::uint32_t rate, double highest) {
  const Cepstra cepstra(samples, rate, highest);
  Squeezed squeezed;
  const auto& frames = cepstra.frames();
  const auto kept = static_cast<std::size_t>(kept_of_pause_ms / step);
  std::size_t next = 0;
  const auto keep_until = [&](std::size_t end) {
    for (; next < end; ++next) squeezed.frame_of.push_back(next);
  };
  const auto runs = quiet_runs(cepstra.levels());
  if (runs.size() == 1 && runs[0].first == 0 && runs[0].second == frames.size()) next = frames.size();
  for (const auto& [first, end] : runs) {
    squeezed.pauses.push_back({step * static_cast<double>(first), step * static_cast<double>(end)});
    if (next == frames.size()) break;
    keep_until(first == 0 ? 0 : std::min(end, first + kept));
    next = std::max(next, end == frames.size() ? end : end - std::min(kept, end - first));
  }
  keep_until(frames.size());
  squeezed.features.resize(squeezed.frame_of.size());
  constexpr std::size_t reach = 2;  // of the changes, frames
  for (std::size_t row = 0; row < squeezed.features.size(); ++row) {
    const std::size_t at = squeezed.frame_of[row];
    const auto& before = frames[at - std::min(reach, at)];
    const auto& after = frames[std::min(frames.size() - 1, at + reach)];
    for (std::size_t c = 0; c < Cepstra::coefficients; ++c) {
      squeezed.features[row][c] = frames[at][c];
      squeezed.features[row][Cepstra::coefficients + c] = after[c] - before[c];
    }
  }
  if (!squeezed.features.empty()) normalize(squeezed.features);
  return squeezed;
}

float distance(const std::array<float, dimensions>& a, const std::array<float, dimensions>& b) {
  float sum = 0.0F;
  for (std::size_t c = 0; c < dimensions; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return std::sqrt(sum / static_cast<float>(dimensions));
}

/// The columns of a row that a path may pass: first and one past the last. They do not decrease from row to row.
struct Band {
  std::size_t first = 0, last = 0;
};

struct Path {
  std::vector<double> columns;  ///< of each row, the middle of its columns
  double distance = 0.0;        ///< mean
};

/// The cheapest path from the first cells to the last ones within the bands; a diagonal step counts twice, so that the
/// number of steps does not matter (the symmetric form).
Path cheapest_path(const Features& rows, const Features& columns, const std::vector<Band>& bands) {
  constexpr std::uint8_t diagonal = 0, row_alone = 1, column_alone = 2;
  constexpr float never = std::numeric_limits<float>::max() / 4;
  std::vector<std::size_t> offsets(rows.size() + 1, 0);
  for (std::size_t i = 0; i < rows.size(); ++i) offsets[i + 1] = offsets[i] + (bands[i].last - bands[i].first);
  std::vector<std::uint8_t> steps(offsets.back());
  std::vector<float> before, now;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Band band = bands[i];
    now.assign(band.last - band.first, never);
    const auto above = [&](std::size_t j) {
      return i > 0 && j >= bands[i - 1].first && j < bands[i - 1].last ? before[j - bands[i - 1].first] : never;
    };
    for (std::size_t j = band.first; j < band.last; ++j) {
      const float here = distance(rows[i], columns[j]);
      float best = i == 0 && j == 0 ? 0.0F : j > 0 ? above(j - 1) + 2.0F * here : never;
      std::uint8_t how = diagonal;
      if (const float cost = above(j) + here + off_diagonal; cost < best) {
        best = cost;
        how = row_alone;
      }
      if (const float cost = j > band.first ? now[j - 1 - band.first] + here + off_diagonal : never; cost < best) {
        best = cost;
        how = column_alone;
      }
      now[j - band.first] = std::min(best, never);
      steps[offsets[i] + (j - band.first)] = how;
    }
    std::swap(before, now);
  }
  Path path;
  path.columns.resize(rows.size());
  path.distance = before.back() / static_cast<double>(rows.size() + columns.size());
  std::size_t i = rows.size() - 1, j = columns.size() - 1, last = j;
  while (true) {
    const auto how = i == 0 && j == 0 ? diagonal : steps[offsets[i] + (j - bands[i].first)];
    if (how != column_alone) {
      path.columns[i] = 0.5 * static_cast<double>(j + last);
      if (i == 0) break;
      --i;
    }
    if (how != row_alone) --j;
    if (how != column_alone) last = j;
  }
  return path;
}

/// Means of `coarse` frames.
Features thinned(const Features& features) {
  Features thin((features.size() + coarse - 1) / coarse);
  for (std::size_t row = 0; row < thin.size(); ++row) {
    const std::size_t first = row * coarse, last = std::min(features.size(), first + coarse);
    for (std::size_t c = 0; c < dimensions; ++c) {
      float sum = 0.0F;
      for (std::size_t i = first; i < last; ++i) sum += features[i][c];
      thin[row][c] = sum / static_cast<float>(last - first);
    }
  }
  normalize(thin);
  return thin;
}

/// Bands of so many columns on each side of the centres. They reach from the first column to the last one, and each
/// overlaps the next, so that there is a path.
std::vector<Band> bands_around(const std::vector<double>& centres, std::size_t columns, std::size_t half) {
  std::vector<Band> bands(centres.size());
  for (std::size_t i = 0; i < bands.size(); ++i) {
    const auto centre = std::min(columns - 1, static_cast<std::size_t>(std::max(0.0, centres[i])));
    bands[i] = {centre - std::min(half, centre), std::min(columns, centre + half + 1)};
    if (i > 0) bands[i].first = std::max(std::min(bands[i].first, bands[i - 1].last - 1), bands[i - 1].first);
  }
  bands.front().first = 0;
  bands.back().last = columns;
  return bands;
}

Path aligned(const Features& rows, const Features& columns) {
  const Features few_rows = thinned(rows), few_columns = thinned(columns);
  const double slope = static_cast<double>(few_columns.size()) / static_cast<double>(few_rows.size());
  std::vector<double> centres(few_rows.size());
  for (std::size_t i = 0; i < centres.size(); ++i) centres[i] = slope * static_cast<double>(i);
  const std::size_t half = std::max<std::size_t>(static_cast<std::size_t>(slope) + 1, most_cells / few_rows.size() / 2);
  const Path rough = cheapest_path(few_rows, few_columns, bands_around(centres, few_columns.size(), half));
  centres.resize(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    // The middle of a coarse row is that of its frames.
    const double at =
        std::clamp((static_cast<double>(i) + 0.5) / coarse - 0.5, 0.0, static_cast<double>(rough.columns.size() - 1));
    const auto below = static_cast<std::size_t>(at);
    const std::size_t next = std::min(rough.columns.size() - 1, below + 1);
    const double share = at - static_cast<double>(below);
    centres[i] = coarse * ((1.0 - share) * rough.columns[below] + share * rough.columns[next] + 0.5);
  }
  return cheapest_path(rows, columns, bands_around(centres, columns.size(), radius));
}

/// Begins of what is said, and the recording's pauses between them.
std::vector<SpokenPhoneme> with_pauses(std::vector<SpokenPhoneme> phonemes, const std::vector<Interval>& pauses) {
  std::vector<SpokenPhoneme> all;
  std::size_t next = 0;
  for (const Interval& pause : pauses) {
    while (next < phonemes.size() && phonemes[next].time < pause.begin) all.push_back(phonemes[next++]);
    // One that begins before the pause and is mostly after it begins after it.
    if (next > 0 && !all.empty() && !all.back().symbol.empty()) {
      const double end = next < phonemes.size() ? phonemes[next].time : pause.end;
      if (end - pause.end > pause.begin - all.back().time) {
        --next;
        all.pop_back();
      }
    }
    all.push_back({pause.begin, "", Stress::none});
    for (std::size_t i = next; i < phonemes.size() && phonemes[i].time < pause.end; ++i) phonemes[i].time = pause.end;
  }
  all.insert(all.end(), phonemes.begin() + static_cast<std::ptrdiff_t>(next), phonemes.end());
  return all;
}

}  // namespace

std::vector<Interval> pauses_of(const Recording& sound) {
  return squeeze(sound.samples, sound.sample_rate, highest_hz).pauses;
}

Result<Alignment> align(const Utterance& model, const Recording& sound) {
  const double highest = std::min({highest_hz, model.sample_rate / 2.0, sound.sample_rate / 2.0});
  const Squeezed from = squeeze(model.samples, model.sample_rate, highest);
  const Squeezed to = squeeze(sound.samples, sound.sample_rate, highest);
  if (to.features.empty()) return Error{ErrorCode::empty, "", "there is no speech in the sound"};
  if (from.features.empty()) return Error{ErrorCode::empty, "", "the text has nothing to say"};
  const double ratio = static_cast<double>(to.features.size()) / static_cast<double>(from.features.size());
  if (ratio > most_stretch || ratio < 1.0 / most_stretch)
    return Error{ErrorCode::mismatch, "",
                 "the text does not belong to the sound: it would be said " +
                     std::string(ratio > 1.0 ? "four times slower" : "four times faster") + " than usual"};
  const Path path = aligned(from.features, to.features);
  const auto carried = [&](double ms) {
    const double row = std::clamp(from.row_of(ms) - 0.5, 0.0, static_cast<double>(path.columns.size() - 1));
    const auto below = static_cast<std::size_t>(row);
    const std::size_t next = std::min(path.columns.size() - 1, below + 1);
    const double share = row - static_cast<double>(below);
    return to.ms_of((1.0 - share) * path.columns[below] + share * path.columns[next] + 0.5);
  };
  Alignment alignment;
  alignment.distance = path.distance;
  Utterance& said = alignment.utterance;
  said = {model.voice, sound.sample_rate, sound.samples, {}, model.words, model.sentences, model.marks, 0.0};
  said.duration = 1000.0 * static_cast<double>(sound.samples.size()) / sound.sample_rate;
  for (const SpokenPhoneme& phoneme : model.phonemes)
    if (!phoneme.symbol.empty()) said.phonemes.push_back({carried(phoneme.time), phoneme.symbol, phoneme.stress});
  said.phonemes = with_pauses(std::move(said.phonemes), to.pauses);
  for (auto& word : said.words) word.time = carried(word.time);
  for (auto& sentence : said.sentences) sentence.time = carried(sentence.time);
  for (auto& mark : said.marks) mark.time = carried(mark.time);
  return alignment;
}

}  // namespace semblante
