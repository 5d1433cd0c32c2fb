#pragma once

#include <string>
#include <vector>

#include "core/frame/frame_guess.h"
#include "core/types/model.h"

namespace semblante::test {

/// A head in MPEG-4's frame with its points where they are known.
struct Head {
  std::string name;
  Model model;
  std::vector<PlacedPoint> points;
};

/// The project's own head, and the real heads that are there.
std::vector<Head> upright_heads();

/// Copies as a file would hold them whose head stands along these axes.
Model turned(Model model, const Axes& axes);
std::vector<PlacedPoint> turned(std::vector<PlacedPoint> points, const Axes& axes);

}  // namespace semblante::test
