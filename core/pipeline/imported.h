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

/// Stage 1: the content of the file, in the file's own axes, with triangles that face outwards.
struct ImportedHead {
  Model model;
  HeadWarnings warnings;
};

struct ImportRequest {
  std::string file_name;              ///< the name of the uploaded file: a hint of the format
  std::optional<ModelFormat> format;  ///< set by the user; if empty, detected by content and name
  ImportLimits limits;
  import::ResourceReader resources = {};  ///< the model's other files; if empty, the file must be complete alone
};

/// Errors: those of import_model; `unsupported` for an unknown file format; `cancelled`.
Result<ImportedHead> import_head(std::span<const std::uint8_t> bytes, const ImportRequest& request,
                                 const Progress& progress = {});

}  // namespace semblante
