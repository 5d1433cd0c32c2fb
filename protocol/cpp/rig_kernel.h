#pragma once

#include "core/expressions/kernel_rig.h"
#include "protocol/cpp/rig_document.h"

namespace semblante {

/// What rig.json tells the kernel. A unit or a moving part that the document does not have becomes what moves nothing.
KernelRig to_kernel_rig(const RigDocument& document);

}  // namespace semblante
