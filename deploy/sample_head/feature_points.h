#pragma once

#include <map>
#include <string>

#include "deploy/sample_head/skin.h"

namespace semblante::sample_head_detail {

/// Adds to skin.marks the FPs of the middle and the left side that lie on open skin. If a place is given exactly (by a
/// relation of the standard, or an end of a brow), the nearest vertex is moved there along the sculpt, by less than
/// half an edge, so that no face degenerates.
void mark_skin_points(Skin& skin);

/// The partner of an FP of the left side or the middle on the other side; an FP of the middle is its own partner.
std::string mirror_of(const std::string& id);

/// Centre of head rotation, between the ear lobes and a little behind the ear canals. Inside the head, not at a vertex.
inline const Vec3 head_pivot{0.0, -2.8, -1.1};

}  // namespace semblante::sample_head_detail
