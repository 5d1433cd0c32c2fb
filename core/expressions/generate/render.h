#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "core/codegen/generator.h"
#include "core/types/feature_point_id.h"

namespace semblante::expressions {

using Vec3 = std::array<double, 3>;

/// A set as authored, resolved: actions summed, sides mirrored. FAPU units.
struct AuthoredSet {
  std::string name;
  std::map<FeaturePointId, Vec3> displacements;
  bool meets_upper_teeth = false;
  double jaw_open = 0.0;  ///< amount of the action `jaw_open` in a viseme, which `articulation` multiplies
};

struct Sets {
  AuthoredSet jaw_open;  ///< the action
  std::vector<AuthoredSet> visemes;
  std::vector<AuthoredSet> expressions;  ///< entry 0 is "none"
};

/// Reads actions.json, visemes.json and expressions.json. Throws std::exception naming file and entry on any fault:
/// this runs at development time only.
Sets read_sets(const std::string& data_folder);

/// core/expressions/generated/displacement_sets.h
std::string render_header(const Sets& sets);

/// All of them, from core/expressions/data.
std::vector<codegen::GeneratedFile> generated_files(const std::string& source_folder);

}  // namespace semblante::expressions
