#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/bench/weights/expression_study.h"

namespace semblante::bench {

/// A head that teaches: its expressions and how much it counts. Each expression counts alike, whatever its size.
struct TrainingHead {
  std::string name;
  ExpressionStudy study;
  double weight = 1.0;
};

/// The shapes of a head kept as `shapes.json` and int16 arrays beside `neutral.obj` (see the README of the real heads).
struct ShapeFile {
  std::vector<std::string> names;
  std::size_t vertex_count = 0;
  double scale = 1.0;
  std::vector<std::int16_t> values;  ///< #names x #vertices x 3

  [[nodiscard]] glm::dvec3 at(std::size_t shape, std::uint32_t vertex) const;
};
/// `kind`: "expressions" or "identities". Throws where the files cannot be read.
ShapeFile read_shapes(const std::filesystem::path& folder, const std::string& kind);

/// The head with all of the shapes of `expressions.npy` whose names `wanted` accepts, as person `identity` of its own
/// identity modes: 0 is the neutral one.
ExpressionStudy read_ict_shapes(const std::filesystem::path& folder, std::uint32_t identity,
                                const std::function<bool(const std::string&)>& wanted);

/// Whether one of the 14 expressions of the folder `expressions` is made of this shape, or of its left or right half.
bool is_measured(const std::string& shape);

}  // namespace semblante::bench
