#pragma once

#include <string>
#include <vector>

#include "clients/runtime/codegen/c_structs.h"
#include "core/codegen/generator.h"

namespace semblante::codegen {

/// The structs of semblante.h and of the kernel's header in other languages.
std::vector<GeneratedFile> declaration_files(const std::string& source_folder);

/// clients/js/generated/layouts.ts: offsets of members and sizes in bytes, with the 4-byte pointers of WebAssembly.
std::string render_layouts(const std::vector<CStruct>& structs);
/// clients/python/semblante/_structs.py: a class for each struct.
std::string render_structs(const std::vector<CStruct>& structs);

}  // namespace semblante::codegen
