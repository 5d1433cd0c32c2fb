#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "core/import/limits.h"
#include "core/import/model_formats.h"
#include "core/types/model.h"
#include "core/types/result.h"

namespace semblante {

/// The format the bytes themselves show; where they show none (text that could be anything, an empty file), the one the
/// ending of `file_name` claims, so that its reader can say what is wrong. nullopt when neither says anything.
std::optional<ModelFormat> detect_format(std::span<const std::uint8_t> bytes, std::string_view file_name);

/// The same for a file whose format must be known. Error: `unsupported`, which names the formats there are.
Result<ModelFormat> format_of(std::span<const std::uint8_t> bytes, std::string_view file_name);

/// Reads a model. Never trusts the file: any bytes give a Model whose indices are in range and whose numbers are
/// finite, or an Error whose `where` is a line ("line 12"), a byte ("byte 80") or a JSON pointer
/// ("/accessors/3/count"). Touches neither the file system nor the network. README.md says how each format numbers its
/// vertices. Thread-safe.
Result<Model> import_model(std::span<const std::uint8_t> bytes, ModelFormat format, const ImportLimits& limits = {});

}  // namespace semblante
