#include "tests/golden/kernel/golden_face.h"

#include <algorithm>
#include <cmath>

#include "core/tables/mpeg4.h"

namespace semblante::testing {
namespace {

/// The same numbers on every machine (the standard's distributions are not).
class Numbers {
 public:
  std::uint32_t below(std::uint32_t end) {
    state_ = state_ * 1664525U + 1013904223U;
    return (state_ >> 8U) % end;
  }

 private:
  std::uint32_t state_ = 2026;
};

/// To a multiple of 1/1024: exact in a float, short in decimals, and the same whatever libm computed.
float round_off(double value) { return static_cast<float>(std::nearbyint(value * 1024.0) / 1024.0); }

struct Builder {
  GoldenFace& face;
  Numbers numbers;
  std::uint8_t turn = SEMBLANTE_TURN_FULL;  ///< of the vertices to come

  std::uint32_t vertex(double x, double y, double z, std::array<double, 3> normal, std::uint8_t part) {
    for (const double value : {x, y, z}) face.rest.push_back(round_off(value));
    for (const double value : normal) face.normals.push_back(round_off(value));
    face.rigid.push_back(part);
    face.turn.push_back(turn);
    return static_cast<std::uint32_t>(face.rigid.size() - 1);
  }

  /// A row with `count` influences of the 84; neighbours get neighbouring points, as on a real face.
  void row(std::uint32_t count, std::uint32_t from) {
    std::vector<std::uint8_t> chosen;
    for (std::uint32_t i = 0; i < count; ++i)
      chosen.push_back(static_cast<std::uint8_t>((from + numbers.below(24)) % 84));
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    std::vector<double> shares;
    double sum = 0.0;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      shares.push_back(1.0 + numbers.below(99));
      sum += shares.back();
    }
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      face.points.push_back(chosen[i]);
      face.weights.push_back(static_cast<float>(shares[i] / sum));
    }
    face.offsets.push_back(static_cast<std::uint32_t>(face.points.size()));
  }

  void grid(std::uint32_t first, std::uint32_t columns, std::uint32_t rows) {
    for (std::uint32_t r = 0; r + 1 < rows; ++r) {
      for (std::uint32_t c = 0; c + 1 < columns; ++c) {
        const std::uint32_t a = first + r * columns + c;
        face.triangles.push_back({a, a + 1, a + columns + 1});
        face.triangles.push_back({a, a + columns + 1, a + columns});
      }
    }
  }

  /// Two bulged sheets side by side. At x = 0 they meet in vertices of the same place: with one normal for both sheets
  /// in the upper half (a UV seam), with two below (a hard edge).
  void skin() {
    for (int side = 0; side < 2; ++side) {
      const auto first = static_cast<std::uint32_t>(face.rigid.size());
      for (int r = 0; r < 8; ++r) {
        turn = static_cast<std::uint8_t>(std::min(255, r * 73));  // the lower rows are the neck, the lowest stays
        for (int c = 0; c < 6; ++c) {
          const double x = (side == 0 ? c - 5 : c) * 0.2;
          const double y = r * 0.25 - 0.9;
          const bool hard = c == (side == 0 ? 5 : 0) && r < 4;
          vertex(x, y, 0.9 - 0.4 * x * x - 0.3 * y * y + 0.05 * (r % 3),
                 {hard ? (side == 0 ? -0.5 : 0.5) : 0.0, 0.0, 1.0}, SEMBLANTE_RIGID_NONE);
          row(r == 7 && side == 0 ? 0 : numbers.below(9), static_cast<std::uint32_t>(r * 10 + c));
        }
      }
      grid(first, 6, 8);
    }
  }

  /// A cap of an eyeball about its pivot: the pupil's middle, its rim, the rim of the iris, white.
  void eye(int which) {
    const double x = face.rig.eye_pivot[which][0];
    const double y = face.rig.eye_pivot[which][1];
    const double z = face.rig.eye_pivot[which][2];
    const auto white = static_cast<std::uint8_t>(which == 0 ? SEMBLANTE_RIGID_LEFT_EYE : SEMBLANTE_RIGID_RIGHT_EYE);
    const auto iris = static_cast<std::uint8_t>(which == 0 ? SEMBLANTE_RIGID_LEFT_IRIS : SEMBLANTE_RIGID_RIGHT_IRIS);
    const std::uint32_t middle = vertex(x, y, z + 0.2, {0, 0, 1}, iris);
    row(0, 0);
    std::uint32_t before = middle;
    for (const double radius : {0.03, 0.06, 0.09, 0.14}) {
      const auto ring = static_cast<std::uint32_t>(face.rigid.size());
      for (int k = 0; k < 6; ++k) {
        const double angle = k * 1.0471975511965976;
        const double depth = std::sqrt(0.04 - radius * radius);
        vertex(x + radius * std::cos(angle), y + radius * std::sin(angle), z + depth,
               {radius * 5 * std::cos(angle), radius * 5 * std::sin(angle), depth * 5}, radius < 0.1 ? iris : white);
        row(0, 0);
      }
      for (std::uint32_t k = 0; k < 6; ++k) {
        const std::uint32_t next = (k + 1) % 6;
        if (before == middle) {
          face.triangles.push_back({middle, ring + k, ring + next});
        } else {
          face.triangles.push_back({before + k, ring + k, ring + next});
          face.triangles.push_back({before + k, ring + next, before + next});
        }
      }
      before = ring;
    }
  }

  /// A sheet in front of an eye, bent about its pivot and partly under the surface of the ball: its rows follow the
  /// lids' points with shares that fall off upwards and downwards, and other points as well.
  void lids(int eye) {
    const auto first = static_cast<std::uint32_t>(face.rigid.size());
    const float* const pivot = face.rig.eye_pivot[eye];
    for (int r = 0; r < 6; ++r) {
      for (int c = 0; c < 6; ++c) {
        const double angle = 0.25 * r - 0.6;
        const double radius = 0.19 + 0.008 * ((r + c) % 4);
        vertex(pivot[0] + 0.06 * (c - 2.5), pivot[1] + radius * std::sin(angle), pivot[2] + radius * std::cos(angle),
               {0, std::sin(angle), std::cos(angle)},
               static_cast<std::uint8_t>(eye == 0 ? SEMBLANTE_RIGID_LEFT_LIDS : SEMBLANTE_RIGID_RIGHT_LIDS));
        const double share = 1.0 - 0.25 * (r < 3 ? 2 - r : r - 3);
        face.points.push_back(static_cast<std::uint8_t>((r < 3 ? 16 : 14) + eye));
        face.weights.push_back(static_cast<float>(share));
        if (share < 1.0) {
          face.points.push_back(static_cast<std::uint8_t>(28 + eye));
          face.weights.push_back(static_cast<float>(1.0 - share));
        }
        face.offsets.push_back(static_cast<std::uint32_t>(face.points.size()));
      }
    }
    grid(first, 6, 6);
  }

  void tongue() {
    const auto first = static_cast<std::uint32_t>(face.rigid.size());
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 5; ++c) {
        vertex((c - 2) * 0.1, -0.5, 0.2 + (2 - r) * 0.15, {0, 1, 0},
               static_cast<std::uint8_t>(r == 2   ? 255
                                         : r == 1 ? 200
                                                  : SEMBLANTE_RIGID_TONGUE));
        row(static_cast<std::uint32_t>(r), 44);
      }
    }
    grid(first, 5, 3);
  }
};

void fill_sets(std::vector<float>& table, std::size_t count, std::size_t first, Numbers& numbers) {
  for (std::size_t s = first; s < count; ++s) {
    for (std::size_t fp = numbers.below(5); fp < 84; fp += 1 + numbers.below(7)) {
      for (std::size_t i = 0; i < 3; ++i) {
        table[(s * 84 + fp) * 3 + i] = round_off((static_cast<double>(numbers.below(400)) - 200.0) / 1000.0);
      }
    }
  }
}

}  // namespace

GoldenFace::GoldenFace() {
  const float fapu[5] = {0.125F / 1024, 0.625F / 1024, 0.5F / 1024, 0.25F / 1024, 0.5F / 1024};
  std::copy(std::begin(fapu), std::end(fapu), rig.fapu);
  for (int eye = 0; eye < 2; ++eye) {
    const float pivot[3] = {eye == 0 ? 0.375F : -0.375F, 0.25F, 0.5F};
    std::copy(std::begin(pivot), std::end(pivot), rig.eye_pivot[eye]);
    rig.iris[eye] = {{0.0F, 0.0F, 1.0F}, 0.03125F, 0.09375F, -2.5F};
    semblante_lids& lids = rig.lids[eye];
    lids = {{0.0F, 0.0F, 1.0F}, 0.625F, 0.125F, {0.75F, 0.25F}, {}, 0.0F};
    // A cornea.
    for (int k = 0; k < SEMBLANTE_BALL_PLACES; ++k) lids.ball[k] = k < 2 ? 0.20703125F : 0.19921875F;
  }
  rig.head_pivot[1] = -0.75F;
  rig.head_pivot[2] = -0.25F;
  rig.viseme_share = 0.85F;
  rig.tongue = {{0.0F, -0.5F, 0.375F}, {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}, 0.1875F, 1.25F};
  Builder builder{*this, {}};
  fill_sets(visemes, 15, 1, builder.numbers);
  fill_sets(expressions, 7, 1, builder.numbers);
  builder.skin();
  builder.eye(0);
  builder.eye(1);
  builder.lids(0);
  builder.lids(1);
  builder.tongue();
  companions = {{9, 0, 0, 0, 0.96875F}, {34, 0, 0, 0, 0.25F},  {34, 45, 0, 0, 0.5F},  {26, 14, 0, 0, 0.4375F},
                {45, 3, 0, 0, 1.0F},    {2, 0, 1, 0, 0.9375F}, {45, 0, 1, 0, 0.4375F}};
  rig.companion = companions.data();
  rig.companion_count = static_cast<std::uint32_t>(companions.size());
  rig.viseme = visemes.data();
  rig.expression = expressions.data();
}

semblante_face GoldenFace::view() const {
  return {static_cast<std::uint32_t>(rigid.size()),
          rest.data(),
          offsets.data(),
          points.data(),
          weights.data(),
          rigid.data(),
          turn.data()};
}

std::vector<GoldenFrame> golden_frames() {
  std::vector<GoldenFrame> frames{{"neutral", {}}};
  const auto add = [&frames](std::string name) -> semblante_frame& {
    return frames.emplace_back(GoldenFrame{std::move(name), {}}).frame;
  };
  // Not the ends of their ranges, and no two alike.
  const auto set = [](semblante_frame& frame, int number) {
    const mpeg4::Fap& fap = mpeg4::fap(static_cast<std::size_t>(number));
    const int end = number % 2 == 0 ? fap.usual_max : fap.usual_min != 0 ? fap.usual_min : fap.usual_max;
    frame.fap[number] = static_cast<float>(end * (3 + number % 4) / 8);
  };
  for (int group = 2; group <= 10; ++group) {
    semblante_frame& frame = add("FAPs of group " + std::to_string(group));
    for (int n = 3; n <= 68; ++n) {
      if (mpeg4::fap(static_cast<std::size_t>(n)).group == group) set(frame, n);
    }
  }
  const auto high = [&add](std::string name, std::array<int, 3> viseme, std::array<int, 4> expression) -> auto& {
    semblante_frame& frame = add(std::move(name));
    frame.viseme1 = static_cast<std::uint8_t>(viseme[0]);
    frame.viseme2 = static_cast<std::uint8_t>(viseme[1]);
    frame.viseme_blend = static_cast<std::uint8_t>(viseme[2]);
    frame.expression1 = static_cast<std::uint8_t>(expression[0]);
    frame.intensity1 = static_cast<std::uint8_t>(expression[1]);
    frame.expression2 = static_cast<std::uint8_t>(expression[2]);
    frame.intensity2 = static_cast<std::uint8_t>(expression[3]);
    return frame;
  };
  high("a viseme", {10, 0, 63}, {0, 0, 0, 0});
  high("two visemes blended", {3, 14, 20}, {0, 0, 0, 0});
  high("an expression", {0, 0, 0}, {1, 63, 0, 0});
  high("two expressions, one faint", {0, 0, 0}, {2, 50, 6, 11});
  high("viseme and expression (Eq. 5)", {1, 0, 63}, {4, 63, 0, 0});
  high("two of each (Eq. 5)", {5, 12, 40}, {3, 30, 5, 33});
  semblante_frame& over = high("low-level FAPs over both, each on its own axis", {7, 11, 31}, {6, 45, 1, 18});
  for (const int n : {3, 6, 7, 19, 31, 39, 51, 52, 53, 54, 61}) set(over, n);
  const auto parts = [&add](std::string name, const std::vector<std::pair<int, float>>& faps) {
    semblante_frame& frame = add(std::move(name));
    for (const auto& [n, value] : faps) frame.fap[n] = value;
  };
  parts("gaze", {{23, 20000}, {24, 15000}, {25, -12000}, {26, 9000}});
  parts("eyes thrust", {{27, 300}, {28, -200}});
  parts("pupils wide and narrow", {{29, 350}, {30, -300}});
  parts("pupils in turned eyes", {{23, -15000}, {26, 10000}, {29, 200}, {30, 400}});
  parts("tongue rolled", {{47, 60000}});
  parts("tongue rolled downwards and out", {{47, -80000}, {43, 300}, {44, 500}});
  parts("a blink, the other eye half", {{19, 1024}, {20, 512}});
  parts("lids meet half way and do not cross", {{19, 700}, {20, 400}, {21, 500}, {22, 800}});
  parts("lids wide, and looking up", {{19, -500}, {20, -1080}, {21, -200}, {25, -30000}, {26, -40000}});
  parts("looking down through half closed lids", {{19, 512}, {25, 40000}, {26, 40000}, {28, 300}});
  parts("jaw alone, with its companions", {{3, 600}});
  parts("jaw, with companions that go their own way", {{3, 600}, {18, 100}, {39, 200}, {53, 300}});
  parts("jaw that takes the lower lip along", {{3, 600}, {16, 200}});
  frames.back().jaw_takes_lip = true;
  high("jaw over a viseme that has its companions", {7, 0, 63}, {0, 0, 0, 0}).fap[3] = 500;
  parts("inner corner of the lips alone: the outer one and the cheek follow", {{6, 200}, {12, 300}});
  parts("both corners of the lips, each by its own FAPs", {{6, 200}, {12, 300}, {53, 100}, {59, -200}});
  parts("inner corner of the lips, and a jaw that takes the lip along", {{3, 400}, {6, 200}, {59, 100}});
  frames.back().jaw_takes_lip = true;
  high("inner corner over a viseme that has the corners", {7, 0, 63}, {0, 0, 0, 0}).fap[12] = 250;
  parts("head", {{48, 20000}, {49, -30000}, {50, 15000}});
  semblante_frame& all = high("everything at once", {2, 9, 25}, {5, 60, 2, 20});
  for (int n = 3; n <= 68; ++n) set(all, n);
  return frames;
}

std::vector<std::array<std::string, 2>> golden_middles() {
  return {{"neutral", "a viseme"},
          {"two expressions, one faint", "low-level FAPs over both, each on its own axis"},
          {"gaze", "head"},
          {"pupils in turned eyes", "everything at once"}};
}

}  // namespace semblante::testing
