#pragma once

#include <filesystem>
#include <string_view>

#include "core/types/result.h"
#include "server/store/blob_store.h"

namespace semblante::upkeep {

/// Copies the bytes that a file has now, over an earlier copy, and returns their hash and number. The copy is durable
/// after sync_file_system(). Errors: `missing`, `io` (`from` cannot be read; the message does not contain the path).
/// Throws store::StoreError when `to` cannot be written.
Result<store::Blob> copy_bytes(const std::filesystem::path& from, const std::filesystem::path& to);

/// Makes everything on the file system of this folder durable. Throws store::StoreError.
void sync_file_system(const std::filesystem::path& folder);

/// Writes a small file under a temporary name, and renames it: it is complete, or not there. Throws store::StoreError.
void write_durably(const std::filesystem::path& path, std::string_view text);

}  // namespace semblante::upkeep
