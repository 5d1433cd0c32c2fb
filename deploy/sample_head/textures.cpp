#include "deploy/sample_head/textures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/types/moving_parts.h"
#include "deploy/sample_head/emit.h"
#include "deploy/sample_head/hair.h"
#include "deploy/sample_head/sculpt.h"

namespace semblante::sample_head_detail {
namespace {

using std::numbers::pi;
using Colour = Vec3;  ///< sRGB, 0..1

constexpr int skin_size = 512;
constexpr int eye_size = 256;

std::size_t texel(int x, int y, int width) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
}

/// Repeatable noise in [0, 1) of a grid point.
double hash_noise(int x, int y) {
  auto h = static_cast<std::uint32_t>(x) * 374761393U + static_cast<std::uint32_t>(y) * 668265263U;
  h = (h ^ (h >> 13U)) * 1274126177U;
  return static_cast<double>((h ^ (h >> 16U)) & 0xFFFFU) / 65536.0;
}

double spot(const Vec3& p, const Vec3& centre, const Vec3& size) {
  const Vec3 q = (Vec3(std::abs(p.x), p.y, p.z) - centre) / size;
  return std::exp(-glm::dot(q, q));
}

/// The brow's line in short steps, made once: every texel of the forehead looks at all of them.
struct BrowStep {
  double along;
  Vec2 at;
  double half_height;
};
std::span<const BrowStep> brow_steps() {
  static const auto steps = [] {
    std::array<BrowStep, 61> made{};
    for (std::size_t i = 0; i < made.size(); ++i) {
      const double t = static_cast<double>(i) / static_cast<double>(made.size() - 1);
      made[i] = {t, brow_line(t), brow_half_height(t)};
    }
    return made;
  }();
  return steps;
}

/// Coverage of the skin by the brow at (x, y): full along its line, frayed by slanted hairs at its edges.
double brow_cover(const Vec2& p) {
  double best = 1e9;
  double at = 0.0;
  for (const BrowStep& step : brow_steps()) {
    const double away = glm::length(p - step.at) / step.half_height;
    if (away < best) {
      best = away;
      at = step.along;
    }
  }
  // Hairs are slanted outwards; three waves without a common period look irregular.
  const double lean = p.x - 0.9 * p.y;
  const double hair =
      0.5 + 0.17 * std::sin(31.0 * lean) + 0.17 * std::sin(53.0 * lean + 1.0) + 0.16 * std::sin(19.0 * lean + 2.0);
  const double ends = glm::smoothstep(-0.03, 0.24, at);
  return (1.0 - glm::smoothstep(0.55 + 0.25 * hair, 1.15 + 0.15 * hair, best)) * (0.72 + 0.2 * hair) *
         (0.06 + 0.94 * ends);
}

Colour skin_colour(const Vec3& p, const Paint& paint) {
  const Colour base(0.905, 0.735, 0.640);
  const Colour warm(0.885, 0.560, 0.490);
  const Colour shade(0.780, 0.590, 0.500);
  Colour c = base;
  const double cheek = spot(p, {4.1, -2.7, 7.0}, {2.2, 1.6, 3.0});
  const double nose = spot(p, {0.4, -3.7, 11.0}, {1.3, 0.9, 1.6});
  const double chin = spot(p, {0.0, -9.8, 9.4}, {1.6, 1.0, 1.5});
  const double lid = spot(p, eye_centre + Vec3(0.0, 0.9, 1.5), {1.7, 0.55, 1.0});
  c = glm::mix(c, warm, std::min(0.42 * cheek + 0.36 * nose + 0.14 * chin + 0.45 * paint.flush, 0.8));
  c = glm::mix(c, shade, 0.30 * lid);
  if (p.z > 3.0) c = glm::mix(c, Colour(0.27, 0.17, 0.12), brow_cover({std::abs(p.x), p.y}));
  const Vec3 from_centre = p - hair_centre;
  const double azimuth = std::atan2(std::abs(from_centre.x), from_centre.z);
  const double elevation = std::atan2(from_centre.y, std::hypot(from_centre.x, from_centre.z));
  const double over = elevation - hairline(azimuth);
  // The roots of the hair begin before its shell, some strands farther out than others.
  const double strand = 0.5 + 0.2 * std::sin(47.0 * azimuth) + 0.17 * std::sin(83.0 * azimuth + 1.0) +
                        0.13 * std::sin(29.0 * azimuth + 2.0);
  const double roots = 0.85 * glm::smoothstep(-0.08 - 0.025 * strand, 0.06, over);
  c = glm::mix(c, Colour(0.24, 0.15, 0.11), roots * (paint.flush > 0.0 ? 0.0 : 1.0));
  c = glm::mix(c, Colour(0.760, 0.455, 0.420), 0.85 * glm::smoothstep(0.2, 0.8, paint.lip));
  c = glm::mix(c, Colour(0.72, 0.46, 0.42), 0.8 * paint.lid);
  return glm::mix(c, Colour(0.13, 0.08, 0.06), glm::smoothstep(0.55, 0.9, paint.lash));
}

Colour lining_colour(int kind, double depth) {
  if (kind == 3) {  // the upper lid, from its lashes to its root
    // Where it comes out from under the fold it is the skin there, or it would show as a crescent above the eye.
    const Colour fold(0.868, 0.692, 0.598);
    const Colour skin = glm::mix(Colour(0.835, 0.635, 0.550), fold, glm::smoothstep(0.15, 0.6, depth));
    return glm::mix(Colour(0.13, 0.08, 0.06), skin, glm::smoothstep(0.10, 0.17, depth));
  }
  constexpr double soft[3] = {0.28, 0.5, 0.4};
  const Colour rim[3] = {{0.74, 0.36, 0.34}, {0.80, 0.52, 0.48}, {0.60, 0.36, 0.31}};
  const Colour deep[3] = {{0.40, 0.13, 0.13}, {0.40, 0.18, 0.17}, {0.16, 0.07, 0.06}};
  return glm::mix(rim[kind], deep[kind], glm::smoothstep(0.0, soft[kind] * 2.0, depth));
}

void put(SampleHeadImage& image, int x, int y, const Colour& c) {
  for (std::size_t k = 0; k < 3; ++k) {
    image.rgb[3 * texel(x, y, image.width) + k] =
        static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(c[static_cast<int>(k)], 0.0, 1.0)));
  }
}

SampleHeadImage blank(const char* name, int width, int height) {
  return {name, width, height,
          std::vector<std::uint8_t>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3, 0)};
}

/// The right half of the image, which is the left half of the face: for each texel its colour, and in `reach` the
/// distance of the painted surface from the head's axis. The farthest surface is kept: an ear covers the scalp behind
/// it.
struct Canvas {
  std::vector<Colour> colour;
  std::vector<double> reach;
};

void paint_triangle(Canvas& canvas, const std::array<Vec2, 3>& uv, const std::array<Vec3, 3>& p,
                    const std::array<Paint, 3>& about) {
  const auto cross = [](const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; };
  const double area = cross(uv[1] - uv[0], uv[2] - uv[0]);
  if (std::abs(area) < 1e-12) return;
  const auto range = [&](int axis) {
    const auto [lo, hi] = std::minmax({uv[0][axis], uv[1][axis], uv[2][axis]});
    return std::pair(std::max(static_cast<int>(lo * skin_size) - 1, 0),
                     std::min(static_cast<int>(hi * skin_size) + 1, skin_size - 1));
  };
  const auto [x0, x1] = range(0);
  const auto [y0, y1] = range(1);
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const Vec2 at((x + 0.5) / skin_size, (y + 0.5) / skin_size);
      const double a = cross(uv[1] - at, uv[2] - at) / area;
      const double b = cross(uv[2] - at, uv[0] - at) / area;
      const double c = 1.0 - a - b;
      if (std::min({a, b, c}) < -1e-9) continue;
      const Vec3 place = p[0] * a + p[1] * b + p[2] * c;
      const double reach = glm::length(Vec2(place.x, place.z + 1.0));
      const auto i = texel(x, y, skin_size);
      if (reach <= canvas.reach[i]) continue;
      canvas.reach[i] = reach;
      Paint mixed;
      mixed.lip = about[0].lip * a + about[1].lip * b + about[2].lip * c;
      mixed.lid = about[0].lid * a + about[1].lid * b + about[2].lid * c;
      mixed.lash = about[0].lash * a + about[1].lash * b + about[2].lash * c;
      mixed.flush = about[0].flush * a + about[1].flush * b + about[2].flush * c;
      canvas.colour[i] = skin_colour(place, mixed);
    }
  }
}

/// Fills texels that no triangle covers from painted neighbours, so that filtering causes no black rims.
void bleed(Canvas& canvas) {
  for (int round = 0; round < 12; ++round) {
    const Canvas before = canvas;
    for (int y = 0; y < skin_size; ++y) {
      for (int x = skin_size / 2; x < skin_size; ++x) {
        const auto i = texel(x, y, skin_size);
        if (before.reach[i] >= 0.0) continue;
        Colour sum(0.0);
        int count = 0;
        for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)}) {
          const int nx = x + dx;
          const int ny = y + dy;
          if (nx < skin_size / 2 || ny < 0 || nx >= skin_size || ny >= skin_size) continue;
          const auto j = texel(nx, ny, skin_size);
          if (before.reach[j] < 0.0) continue;
          sum += before.colour[j];
          ++count;
        }
        if (count == 0) continue;
        canvas.colour[i] = sum / static_cast<double>(count);
        canvas.reach[i] = 0.0;
      }
    }
  }
}

}  // namespace

SampleHeadImage paint_skin(const HalfMesh& skin) {
  constexpr std::size_t texels = static_cast<std::size_t>(skin_size) * skin_size;
  Canvas canvas{std::vector<Colour>(texels, Colour(0.905, 0.735, 0.640)), std::vector<double>(texels, -1.0)};
  for (const auto& face : skin.faces) {
    if (face.chart != Chart::outer) continue;
    const std::size_t triangles = face.corner[3] < 0 ? 1 : 2;
    for (std::size_t t = 0; t < triangles; ++t) {
      std::array<Vec2, 3> uv;
      std::array<Vec3, 3> p;
      std::array<Paint, 3> about;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto v = static_cast<std::size_t>(face.corner[i == 0 ? 0 : i + t]);
        p[i] = skin.positions[v];
        uv[i] = outer_uv(p[i]);
        about[i] = skin.paint[v];
      }
      paint_triangle(canvas, uv, p, about);
    }
  }
  bleed(canvas);
  SampleHeadImage image = blank("skin", skin_size, skin_size);
  for (int y = 0; y < skin_size; ++y) {
    for (int x = skin_size / 2; x < skin_size; ++x) {
      Colour c = canvas.colour[texel(x, y, skin_size)];
      const double v = (y + 0.5) / skin_size;
      const double grain = 0.012 * (hash_noise(x, y) - 0.5);
      c += Colour(grain);
      put(image, x, y, c);
      put(image, skin_size - 1 - x, y, c);
      if (v < 0.95) continue;
      // The strip of the lining is not mirrored: four gradients from the opening inwards, side by side.
      for (const int column : {x, skin_size - 1 - x}) {
        const double u = 4.0 * (column + 0.5) / skin_size;
        const int kind = std::min(static_cast<int>(u), 3);
        put(image, column, y, lining_colour(kind, (u - kind - 0.04) / 0.92));
      }
    }
  }
  return image;
}

SampleHeadImage paint_eye() {
  SampleHeadImage image = blank("eye", eye_size, eye_size);
  const double iris = std::asin(iris_radius / eye_radius) / pi;  // as a share of the image's half width
  for (int y = 0; y < eye_size; ++y) {
    for (int x = 0; x < eye_size; ++x) {
      const Vec2 q((x + 0.5) / eye_size * 2.0 - 1.0, (y + 0.5) / eye_size * 2.0 - 1.0);
      const double r = glm::length(q) / iris;  // 1 at the rim of the iris
      const double angle = std::atan2(q.y, q.x);
      Colour c = glm::mix(Colour(0.93, 0.915, 0.90), Colour(0.80, 0.62, 0.58), glm::smoothstep(1.2, 3.2, r));
      // Fibres: a few sine waves whose sum looks irregular, the same on left and right.
      const double a = std::abs(std::abs(angle) - 0.5 * pi);
      const double fibre =
          0.5 + 0.2 * std::sin(23.0 * a) + 0.18 * std::sin(41.0 * a + 1.0) + 0.12 * std::sin(67.0 * a + 2.0);
      Colour blue = glm::mix(Colour(0.20, 0.36, 0.44), Colour(0.45, 0.62, 0.66), fibre * glm::smoothstep(1.0, 0.45, r));
      blue = glm::mix(blue, Colour(0.62, 0.52, 0.34), 0.55 * glm::smoothstep(0.62, 0.36, r) * (0.5 + fibre * 0.5));
      blue = glm::mix(blue, Colour(0.08, 0.14, 0.18), glm::smoothstep(0.80, 0.98, r));
      // The shadow of the lid on the upper part.
      blue *= 1.0 - 0.30 * glm::smoothstep(0.1, -0.9, q.y / iris);
      c *= 1.0 - 0.22 * glm::smoothstep(0.3, -1.0, q.y / iris);
      c = glm::mix(blue, c, glm::smoothstep(0.96, 1.06, r));
      c = glm::mix(Colour(0.02, 0.02, 0.025), c, glm::smoothstep(pupil_of_iris - 0.03, pupil_of_iris + 0.03, r));
      // A painted glint makes the eye look alive under any light.
      const Vec2 glint = q / iris - Vec2(0.0, -0.42);
      c = glm::mix(Colour(1.0), c, glm::smoothstep(0.09, 0.16, glm::length(glint)));
      put(image, x, y, c);
    }
  }
  return image;
}

SampleHeadImage paint_hair() {
  SampleHeadImage image = blank("hair", 256, 64);
  for (int x = 0; x < 256; ++x) {
    for (int y = 0; y < 64; ++y) {
      // Strands run down the image, each with a small sideways variation.
      const double u = x / 256.0 + 0.004 * std::sin(0.35 * y + 0.7 * x);
      double tone = 0.0;
      double size = 0.5;
      for (const double waves : {9.0, 23.0, 57.0, 101.0}) {
        tone += size * std::sin(2.0 * pi * waves * u + 1.7 * waves + 0.02 * waves * std::sin(0.11 * y));
        size *= 0.8;
      }
      tone += 0.5 * (hash_noise(x, y / 9) - 0.5);
      const double light = std::clamp(0.5 + 0.25 * tone, 0.0, 1.0);
      put(image, x, y, glm::mix(Colour(0.205, 0.125, 0.085), Colour(0.405, 0.270, 0.185), light));
    }
  }
  return image;
}

SampleHeadImage paint_teeth() {
  SampleHeadImage image = blank("teeth", 8, 32);
  for (int y = 0; y < 32; ++y) {
    const double t = (y + 0.5) / 32.0;
    const Colour c = glm::mix(Colour(0.80, 0.45, 0.44), Colour(0.955, 0.945, 0.91), glm::smoothstep(0.42, 0.58, t));
    for (int x = 0; x < 8; ++x) put(image, x, y, c);
  }
  return image;
}

}  // namespace semblante::sample_head_detail
