#pragma once

#include "core/propose/draft.h"

namespace semblante {

/// Moves proposed points of lids about an eye that is modelled in the skin to the edges of the lids as they are seen:
/// mirror images and proportions come to lie on the eye, or beside the lids. Known points stay.
void correct_modelled_rims(Draft& draft);

}  // namespace semblante
