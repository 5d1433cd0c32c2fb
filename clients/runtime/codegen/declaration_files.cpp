#include "clients/runtime/codegen/declaration_files.h"

namespace semblante::codegen {

std::vector<GeneratedFile> declaration_files(const std::string& source_folder) {
  const std::string kernel = read_text(source_folder + "/core/kernel/semblante_kernel.h");
  std::vector<CStruct> structs = read_c_structs(kernel);
  for (const char* header : {"/core/kernel/semblante_normals.h", "/clients/runtime/semblante.h"}) {
    for (CStruct& more : read_c_structs(read_text(source_folder + header), kernel)) structs.push_back(std::move(more));
  }
  return {{"clients/js/generated/layouts.ts", render_layouts(structs)},
          {"clients/python/semblante/_structs.py", render_structs(structs)}};
}

}  // namespace semblante::codegen
