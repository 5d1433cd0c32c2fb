#include "core/expressions/library.h"

#include <cassert>
#include <optional>

#include "core/expressions/generated/displacement_sets.h"
#include "core/tables/mpeg4.h"

namespace semblante {
namespace {

static_assert(static_cast<int>(mpeg4::Unit::mw) == static_cast<int>(FapuUnit::mw), "units in one order");

/// The generated constants as sets over one array of displacements.
struct Library {
  std::vector<Displacement> displacements;
  std::vector<DisplacementSet> sets;
};

template <std::size_t N>
Library build(const std::array<generated::Set, N>& source) {
  Library library;
  library.displacements.reserve(2 * generated::displacements.size());
  for (const generated::Set& set : source) {
    const std::size_t first = library.displacements.size();
    for (std::size_t i = set.first; i < set.first + set.count; ++i) {
      const generated::Entry& entry = generated::displacements[i];
      const glm::vec3 by(entry.x, entry.y, entry.z);
      library.displacements.push_back({FeaturePointId(entry.point), by});
      if (!entry.with_mirror) continue;
      const glm::vec3 mirrored(-entry.x, entry.y, entry.z);  // of the whole number: 0 has no sign
      library.displacements.push_back({FeaturePointId(static_cast<std::uint8_t>(entry.point + 1)), mirrored});
    }
    // Reserved above, so the array does not move and the spans stay valid.
    library.sets.push_back({set.name, std::span<const Displacement>(library.displacements).subspan(first),
                            set.meets_upper_teeth, set.jaw_open, true});
  }
  return library;
}

FapuUnit fapu_of_region(FeaturePointId point, int axis) {
  const int group = group_of(point);
  const int number = number_of(point);
  const bool teeth = group == 9 && number >= 8 && number <= 11;
  if (group == 2 || group == 6 || group == 8 || teeth) return axis == 0 ? FapuUnit::mw : FapuUnit::mns;
  if (group == 3) return axis == 1 ? FapuUnit::irisd : FapuUnit::es;
  return axis == 0 ? FapuUnit::es : FapuUnit::ens;  // brows, nose, cheeks and the rest
}

}  // namespace

std::span<const DisplacementSet> viseme_library() {
  static const Library library = build(generated::visemes);
  return library.sets;
}

std::span<const DisplacementSet> expression_library() {
  static const Library library = build(generated::expressions);
  return library.sets;
}

const DisplacementSet& jaw_open_action() {
  static const Library library = build(generated::jaw_open);
  return library.sets.front();
}

FapuUnit fapu_of(FeaturePointId point, int axis) {
  assert(axis >= 0 && axis < 3);
  const mpeg4::Fap* const fap = mpeg4::fap_that_moves(point.value(), axis);
  return fap != nullptr ? static_cast<FapuUnit>(fap->unit) : fapu_of_region(point, axis);
}

ModelDisplacements to_model_units(const DisplacementSet& set, const Fapu& fapu) {
  ModelDisplacements result;
  for (const Displacement& displacement : set.displacements) {
    glm::vec3 moved(0.0F);
    std::optional<FapuUnit> missing;
    for (int axis = 0; axis < 3; ++axis) {
      const float amount = displacement.value[axis];
      if (amount == 0.0F) continue;
      const FapuUnit unit = fapu_of(displacement.point, axis);
      const std::optional<double> length = fapu[unit];
      if (!length && !missing) missing = unit;
      moved[axis] = static_cast<float>(static_cast<double>(amount) * length.value_or(0.0));
    }
    if (missing) {
      result.skipped.push_back({displacement.point, *missing});
    } else {
      result.displacements.push_back({displacement.point, moved});
    }
  }
  return result;
}

std::array<float, feature_point_count * 3> to_dense(std::span<const Displacement> displacements) {
  std::array<float, feature_point_count * 3> dense{};
  for (const Displacement& displacement : displacements) {
    const std::size_t first = std::size_t{displacement.point.value()} * 3;
    dense[first] = displacement.value.x;
    dense[first + 1] = displacement.value.y;
    dense[first + 2] = displacement.value.z;
  }
  return dense;
}

}  // namespace semblante
