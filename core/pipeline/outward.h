#pragma once

#include "core/types/model.h"

namespace semblante {

/// Reverses the winding of all triangles of a model that is certainly inside out, as one that was mirrored without it:
/// its largest part is (enclosed_volume.h), and no other part of some size is clearly the right way out. Normals that
/// point inwards too are reversed. Returns whether it did.
bool turn_outward(Model& model);

}  // namespace semblante
