#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/import/import.h"
#include "core/pipeline/warnings.h"
#include "core/types/model.h"
#include "core/types/progress.h"
#include "core/types/result.h"

namespace semblante {

/// Stage 1: what the file holds, as it lies in the file.
struct ImportedHead {
  Model model;
  HeadWarnings warnings;
};

struct ImportRequest {
  std::string file_name;              ///< as the user knows it: a hint of the format
  std::optional<ModelFormat> format;  ///< said by the user; otherwise by content and name
  ImportLimits limits;
};

/// Errors: those of import_model; `unsupported` for a file of no format that is read; `cancelled`.
Result<ImportedHead> import_head(std::span<const std::uint8_t> bytes, const ImportRequest& request,
                                 const Progress& progress = {});

}  // namespace semblante
