#include "core/bridges/oculus.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/bridges/axis_displacements.h"
#include "core/bridges/generated/arkit_tables.h"
#include "core/tables/mpeg4.h"
#include "core/types/letter_case.h"

namespace semblante {
namespace {

constexpr std::array<std::string_view, oculus_count> names = {"sil", "PP", "FF", "TH", "DD", "kk", "CH", "SS",
                                                              "nn",  "RR", "aa", "E",  "ih", "oh", "ou"};
using Weights = std::array<double, oculus_count>;

void use_nearest_pair(const Weights& weight, semblante_frame& frame) {
  std::size_t first = 0;
  std::size_t second = 0;
  for (std::size_t v = 1; v < oculus_count; ++v) {
    if (first == 0 || weight[v] > weight[first]) {
      second = first;
      first = v;
    } else if (second == 0 || weight[v] > weight[second]) {
      second = v;
    }
  }
  const double lack = 1.0 - weight[first] - weight[second];
  const bool pair = lack * lack < 2.0 * weight[second] * weight[second];
  const double share = pair ? std::min((1.0 + weight[first] - weight[second]) / 2.0, 1.0) : weight[first];
  const long blend = std::lround(share * SEMBLANTE_BLEND_MAX);
  if (blend == 0) return;
  frame.viseme1 = static_cast<std::uint8_t>(first);
  frame.viseme2 = static_cast<std::uint8_t>(pair ? second : 0);
  frame.viseme_blend = static_cast<std::uint8_t>(blend);
}

bool is_of_mouth(const mpeg4::Fap& fap) {
  return fap.kind == mpeg4::FapKind::translation && (fap.group == 2 || fap.group == 6 || fap.group == 8);
}

std::array<double, SEMBLANTE_FAP_COUNT + 1> displacements_of(std::size_t viseme) {
  semblante_frame frame{};
  frame.viseme1 = static_cast<std::uint8_t>(viseme);
  frame.viseme_blend = SEMBLANTE_BLEND_MAX;
  return axis_displacements(frame);
}

/// The effect of each viseme along the axes of the mouth's FAPs, FAP units.
struct MouthOfVisemes {
  MouthOfVisemes() {
    for (const mpeg4::Fap& fap : mpeg4::faps) {
      if (!is_of_mouth(fap)) continue;
      faps.push_back(fap.number);
      // FAP 18 (chin boss) has less weight: its range ends long before the jaw's.
      millimetres.push_back(generated::arkit_millimetres[static_cast<std::size_t>(fap.unit)] / 1024.0 *
                            (fap.number == 18 ? 0.3 : 1.0));
    }
    for (std::size_t v = 0; v < oculus_count; ++v) {
      const auto moved = displacements_of(v);
      for (const std::size_t n : faps) units[v].push_back(moved[n]);
    }
    for (std::size_t a = 0; a < oculus_count; ++a) {
      for (std::size_t b = 0; b < oculus_count; ++b) {
        for (std::size_t i = 0; i < faps.size(); ++i) {
          gram[a][b] += units[a][i] * units[b][i] * millimetres[i] * millimetres[i];
        }
      }
    }
  }
  std::vector<std::size_t> faps;
  std::vector<double> millimetres;  ///< #faps: of a FAP unit on a usual head
  std::array<std::vector<double>, oculus_count> units;
  std::array<Weights, oculus_count> gram{};
};

const MouthOfVisemes& mouth_of_visemes() {
  static const MouthOfVisemes mouth;
  return mouth;
}

void use_all(const Weights& weight, semblante_frame& frame) {
  const MouthOfVisemes& mouth = mouth_of_visemes();
  for (std::size_t i = 0; i < mouth.faps.size(); ++i) {
    double sum = 0.0;
    for (std::size_t v = 1; v < oculus_count; ++v) sum += weight[v] * mouth.units[v][i];
    const mpeg4::Fap& fap = mpeg4::fap(mouth.faps[i]);
    frame.fap[fap.number] =
        static_cast<float>(std::clamp(sum, static_cast<double>(fap.min()), static_cast<double>(fap.max())));
  }
}

/// Regularization towards the weights of FAP 1, square millimetres.
constexpr double trust_in_fap1 = 4.0;
/// Cost of any change from the weights of FAP 1, square millimetres, so that few visemes explain a mouth.
constexpr double cost_of_change = 5.0;
constexpr std::size_t sweeps = 60;

}  // namespace

std::string_view oculus_name(std::size_t index) { return names.at(index); }

std::optional<std::size_t> find_oculus(std::string_view name) {
  for (std::size_t v = 0; v < oculus_count; ++v) {
    if (equal_ignoring_case(name, names[v])) return v;
  }
  return std::nullopt;
}

Result<FrameFromOculus> frame_from_oculus(std::span<const float, oculus_count> weights, OculusBlend blend) {
  FrameFromOculus result{};
  Weights w{};
  double sum = 0.0;
  for (std::size_t v = 0; v < oculus_count; ++v) {
    if (!std::isfinite(weights[v])) {
      return Error{ErrorCode::not_finite, std::string(names[v]), "is not a finite number"};
    }
    if (weights[v] < 0.0F || weights[v] > 1.0F) ++result.clamped;
    w[v] = std::clamp(static_cast<double>(weights[v]), 0.0, 1.0);
    if (v > 0) sum += w[v];
  }
  if (sum > 1.0) {
    for (double& value : w) value /= sum;
  }
  use_nearest_pair(w, result.frame);
  if (blend == OculusBlend::all_visemes) use_all(w, result.frame);
  return result;
}

OculusWeights oculus_from_frame(const semblante_frame& frame) {
  const MouthOfVisemes& mouth = mouth_of_visemes();
  Weights of_fap1{};
  const double share = std::min<int>(frame.viseme_blend, SEMBLANTE_BLEND_MAX) / 63.0;
  if (frame.viseme1 < oculus_count) of_fap1[frame.viseme1] += share;
  if (frame.viseme2 < oculus_count) of_fap1[frame.viseme2] += 1.0 - share;
  of_fap1[0] = 0.0;

  semblante_frame without_expressions = frame;
  without_expressions.intensity1 = without_expressions.intensity2 = 0;
  const auto displacement = axis_displacements(without_expressions);
  std::vector<double> left;  // mm: residual of FAP 1
  for (std::size_t i = 0; i < mouth.faps.size(); ++i) {
    double units = displacement[mouth.faps[i]];
    for (std::size_t v = 1; v < oculus_count; ++v) units -= of_fap1[v] * mouth.units[v][i];
    left.push_back(units * mouth.millimetres[i]);
  }
  Weights slope{};
  for (std::size_t v = 1; v < oculus_count; ++v) {
    for (std::size_t i = 0; i < left.size(); ++i) slope[v] -= mouth.units[v][i] * mouth.millimetres[i] * left[i];
  }
  Weights w = of_fap1;
  for (std::size_t sweep = 0; sweep < sweeps; ++sweep) {
    for (std::size_t v = 1; v < oculus_count; ++v) {
      // A soft threshold: the weight leaves FAP 1's only if the gain exceeds the cost.
      const double stiff = mouth.gram[v][v] + trust_in_fap1;
      const double change = (mouth.gram[v][v] * (w[v] - of_fap1[v]) - slope[v]) / stiff;
      const double worth = std::max(std::abs(change) - cost_of_change / stiff, 0.0);
      const double wanted = of_fap1[v] + std::copysign(worth, change);
      const double step = std::clamp(wanted, 0.0, 1.0) - w[v];
      w[v] += step;
      for (std::size_t k = 1; k < oculus_count; ++k) slope[k] += step * mouth.gram[v][k];
    }
  }
  double sum = 0.0;
  for (std::size_t v = 1; v < oculus_count; ++v) sum += w[v];
  const double scale = sum > 1.0 ? 1.0 / sum : 1.0;
  OculusWeights result{};
  for (std::size_t v = 1; v < oculus_count; ++v) result[v] = static_cast<float>(w[v] * scale);
  result[0] = static_cast<float>(std::max(1.0 - sum, 0.0));
  return result;
}

}  // namespace semblante
