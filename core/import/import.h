#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "core/import/limits.h"
#include "core/import/model_formats.h"
#include "core/import/resource_reader.h"
#include "core/types/model.h"
#include "core/types/result.h"

namespace semblante {

/// The format by content; if that is ambiguous (plain text, an empty file), by the extension of `file_name`, so that
/// the format's reader reports the error. nullopt when both are unknown.
std::optional<ModelFormat> detect_format(std::span<const std::uint8_t> bytes, std::string_view file_name);

/// Like detect_format, but an unknown format is the error `unsupported`, which lists the supported formats.
Result<ModelFormat> format_of(std::span<const std::uint8_t> bytes, std::string_view file_name);

/// Reads a model from untrusted bytes: the result is a Model with indices in range and finite numbers, or an Error
/// whose `where` is a line ("line 12"), a byte ("byte 80") or a JSON pointer ("/accessors/3/count"). Other files of
/// a glTF, GLB or OBJ are read only through `resources`; without it, a needed one is an error and a material file a
/// warning. Accesses neither the file system nor the network itself. README.md defines the vertex numbers of each
/// format. Thread-safe.
Result<Model> import_model(std::span<const std::uint8_t> bytes, ModelFormat format, const ImportLimits& limits = {},
                           const import::ResourceReader& resources = {});

}  // namespace semblante
