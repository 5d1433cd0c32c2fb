#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/surface.h"
#include "core/types/model.h"
#include "core/types/result.h"
#include "core/types/rig.h"
#include "server/hash/sha256.h"

namespace semblante {

struct PackageOptions {
  std::string name;      ///< of the model, for people
  int weight_bits = 12;  ///< 8..16, of each normalized weight in `weights`
};

/// One artefact and its content address.
struct Artefact {
  std::vector<std::uint8_t> bytes;
  Sha256 sha256{};
};

/// What a client fetches to animate one face (protocol/SPEC.md). `weights` names the mesh it belongs to by hash;
/// `rig_json` names both.
struct FacePackage {
  Artefact mesh_drc;
  Artefact weights;
  Artefact rig_json;
  Artefact face_glb;
  std::vector<Artefact> images;  ///< the model's images, as rig.json names them by hash
};

/// Encodes the mesh once, decodes it back, checks that every triangle survived and every position is within a quantum,
/// and lays the weight table out in the decoded order. `rig` is over the file vertices of `model`.
Result<FacePackage> build_package(const Model& model, const Surface& surface, const Rig& rig,
                                  const PackageOptions& options);

/// preview.glb: the model as imported, to look at and to mark feature points on; every vertex knows its number in the
/// file and its part. `parts` (by PartId) may be empty.
Result<std::vector<std::uint8_t>> build_preview(const Model& model, const Surface& surface,
                                                std::span<const Part> parts);

}  // namespace semblante
