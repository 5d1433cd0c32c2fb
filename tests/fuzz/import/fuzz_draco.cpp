// Draco bytes: of a primitive, past the JSON that a fuzzer seldom leaves valid, and of a face package.
#include "core/draco/draco_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto mesh = semblante::DracoMesh::decode({data, size}, {100'000, 100'000});
  if (!mesh) return 0;
  for (const semblante::Triangle& triangle : mesh->triangles()) {
    for (const std::uint32_t corner : triangle) {
      if (corner >= mesh->point_count()) __builtin_trap();
    }
  }
  for (std::uint32_t id = 0; id < 4; ++id) {
    for (const std::size_t components : {2U, 3U}) (void)mesh->floats(id, components, id % 2 == 0);
    (void)mesh->bytes(id);
    (void)mesh->numbers(id);
  }
  return 0;
}
