#pragma once

#include "deploy/sample_head/sample_head.h"

namespace semblante::sample_head_detail {

/// Adds a skeleton with the joint names of common avatars (Hips, Spine, Neck, Head, LeftArm, ...) to a body, and binds
/// every vertex: the parts of the head to the head, neck and clothes to the two nearest bones.
void add_skeleton(SampleHead& body);

}  // namespace semblante::sample_head_detail
