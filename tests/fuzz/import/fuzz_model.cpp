// One libFuzzer target a format: SEMBLANTE_FUZZ_FORMAT is an enumerator of ModelFormat.
#include <cstdlib>

#include "core/import/import.h"

namespace {

/// What every reader promises; a broken promise is a crash the fuzzer can see.
void check(const semblante::Model& model) {
  if (model.triangles.empty()) std::abort();
  const auto in_range = [](const std::vector<semblante::Triangle>& triangles, std::size_t count, bool may_lack) {
    for (const semblante::Triangle& triangle : triangles) {
      for (const std::uint32_t index : triangle) {
        if (index >= count && !(may_lack && index == semblante::Model::no_index)) std::abort();
      }
    }
  };
  in_range(model.triangles, model.positions.size(), false);
  in_range(model.uv_triangles, model.uvs.size(), true);
  in_range(model.normal_triangles, model.normals.size(), true);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // Small limits: the fuzzer is after wrong reads, not after large models that are right.
  semblante::ImportLimits limits;
  limits.max_file_bytes = std::size_t{16} << 20;
  limits.max_vertices = 100'000;
  limits.max_triangles = 100'000;
  const auto model = semblante::import_model({data, size}, semblante::ModelFormat::SEMBLANTE_FUZZ_FORMAT, limits);
  if (model) check(*model);
  return 0;
}
