#pragma once

#include "deploy/sample_head/sample_head.h"

namespace semblante::sample_head_detail {

/// An eyeball with rings about the line of sight, and the number of its vertex at the pupil.
struct Eyeball {
  SampleHeadMesh mesh;
  std::uint32_t pupil = 0;
};

Eyeball make_eyeball(bool right, std::size_t material);

}  // namespace semblante::sample_head_detail
