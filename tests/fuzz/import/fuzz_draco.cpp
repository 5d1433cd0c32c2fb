// The Draco bytes of a primitive, past the JSON that a fuzzer seldom leaves valid.
#include "core/import/gltf_draco.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  semblante::ImportLimits limits;
  limits.max_vertices = 100'000;
  limits.max_triangles = 100'000;
  const auto mesh = semblante::import::DracoMesh::decode({data, size}, limits);
  if (!mesh) return 0;
  for (const std::uint32_t index : mesh->indices()) {
    if (index >= mesh->point_count()) __builtin_trap();
  }
  for (std::uint32_t id = 0; id < 4; ++id) {
    for (const std::size_t components : {2U, 3U}) (void)mesh->floats(id, components, id % 2 == 0);
  }
  return 0;
}
