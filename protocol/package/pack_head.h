#pragma once

#include "core/pipeline/levelled.h"
#include "protocol/package/package.h"

namespace semblante {

/// The last stage of core/pipeline: the packages of a head and of each of its levels. It is not in core, because the
/// formats of a package belong to the protocol. `options.warnings` is replaced by the head's warnings.
Result<std::vector<FacePackage>> pack_head(const LevelledHead& head, PackageOptions options,
                                           const Progress& progress = {});

}  // namespace semblante
