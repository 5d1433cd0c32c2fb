#pragma once

#include "core/expressions/kernel_rig.h"
#include "protocol/cpp/rig_document.h"

namespace semblante {

/// Converts rig.json for the kernel. A missing FAPU or moving part becomes a value without effect.
KernelRig to_kernel_rig(const RigDocument& document);

}  // namespace semblante
