#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

/// The tables of MPEG-4 facial animation as constants. The entries are generated from core/tables/data.
namespace semblante::mpeg4 {

enum class FapKind : std::uint8_t { high_level, translation, rotation, scale };
/// The first five in the order of semblante::FapuUnit. A high-level FAP has none.
enum class Unit : std::uint8_t { irisd, es, ens, mns, mw, au, none };
inline constexpr std::array<std::string_view, 7> unit_names = {"IRISD", "ES", "ENS", "MNS", "MW", "AU", ""};
enum class Side : std::uint8_t { center, left, right };

inline constexpr std::int8_t no_axis = -1;
inline constexpr double radians_per_au = 1e-5;

struct FapGroup {
  std::uint8_t number;
  std::string_view name;
  std::uint8_t first_fap;
  std::uint8_t last_fap;
};

struct Fap {
  std::uint8_t number;  ///< 1..68
  std::string_view name;
  std::uint8_t group;
  FapKind kind;
  Unit unit;
  bool bidirectional;
  std::int8_t axis;  ///< 0 x, 1 y, 2 z: of the displacement or of the rotation; no_axis for the pupils and FAP 47
  std::int8_t sign;  ///< displacement (or angle) = sign * value * unit along (or about) the axis
  std::array<std::uint8_t, 2> feature_points;  ///< dense indices 0..83
  std::uint8_t feature_point_count;
  std::uint8_t mirror;      ///< to mirror a frame: new[mirror] = mirror_sign * old[number]; 0 for FAPs 1 and 2
  std::int8_t mirror_sign;  ///< 1 or -1; 0 for FAPs 1 and 2
  std::int32_t quantizer_step;
  std::int32_t min_level, max_level;  ///< of quantized values, in an intra frame
  std::int32_t usual_min, usual_max;  ///< what a face does, FAP units: for sliders

  [[nodiscard]] constexpr std::int32_t min() const { return min_level * quantizer_step; }  ///< FAP units
  [[nodiscard]] constexpr std::int32_t max() const { return max_level * quantizer_step; }  ///< FAP units
};

struct FeaturePointInfo {
  std::string_view id;  ///< "2.1"
  std::string_view name;
  Side side;
  std::uint8_t mirror;  ///< dense index of the point on the other side; itself in the middle
};

/// FAPU zero value = coordinate `axis` of `to` minus that of `from`, on the neutral face.
struct Measure {
  std::uint8_t from, to;
  std::uint8_t axis;
};

struct FapuInfo {
  std::string_view name;
  std::string_view meaning;
  std::array<Measure, 2> measures;
  std::uint8_t measure_count;  ///< 2: left and right eye
};

struct VisemeInfo {
  std::string_view name;
  std::string_view phonemes;  ///< IPA, space between
  std::string_view examples;
};

struct ExpressionInfo {
  std::string_view name;
};

/// A feature point that follows another one.
struct Companion {
  std::uint8_t point, leader;  ///< dense indices
  double share;                ///< of the leader's displacement
  bool is_choice;              ///< the lower lip with the jaw: only if a player chooses so
};

}  // namespace semblante::mpeg4

#include "core/tables/generated/mpeg4_entries.h"

namespace semblante::mpeg4 {

inline constexpr std::size_t fap_count = faps.size();
inline constexpr std::size_t viseme_count = visemes.size();
inline constexpr std::size_t expression_count = expressions.size();  ///< entry 0 is "none"

/// FAP by its number, 1..68.
constexpr const Fap& fap(std::size_t number) { return faps[number - 1]; }

/// The translation FAP that moves a feature point (dense index) along an axis; null when none does.
constexpr const Fap* fap_that_moves(std::uint8_t feature_point, int axis) {
  for (const Fap& f : faps) {
    if (f.kind == FapKind::translation && f.feature_points[0] == feature_point && f.axis == axis) return &f;
  }
  return nullptr;
}

}  // namespace semblante::mpeg4
