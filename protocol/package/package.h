#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/extract/named_set.h"
#include "core/geometry/surface.h"
#include "core/lod/decimate.h"
#include "core/materials/materials.h"
#include "core/types/model.h"
#include "core/types/result.h"
#include "core/types/rig.h"
#include "protocol/hash/sha256.h"

namespace semblante {

struct PackageOptions {
  std::string name;                        ///< of the model, for display
  int weight_bits = 12;                    ///< 8..16, of each normalized weight in `weights`
  std::vector<NamedSet> worn = {};         ///< replace the library's sets of the same names
  std::vector<std::string> warnings = {};  ///< for rig.json; those in the model and the rig are not used
};

/// One artefact and its content address.
struct Artefact {
  std::vector<std::uint8_t> bytes;
  Sha256 sha256{};
};

/// An image of the model as the import gives it (PNG or JPEG), with its type ("image/png").
struct ImageArtefact : Artefact {
  std::string mime_type;
};

/// The files that a client fetches to animate one face (protocol/SPEC.md). `weights` names the mesh it belongs to by
/// hash; `rig_json` names both.
struct FacePackage {
  std::uint32_t vertices = 0;   ///< as mesh.drc decodes
  std::uint32_t triangles = 0;  ///< likewise
  Artefact mesh_drc;
  Artefact weights;
  Artefact rig_json;
  Artefact face_glb;
  std::vector<ImageArtefact> images;  ///< the model's images, as rig.json names them by hash
};

/// Encodes the mesh once, decodes it back, checks that every triangle survived and every position is within a quantum,
/// and writes the weight table in the decoded order. `rig` is over the file vertices of `model`.
Result<FacePackage> build_package(const Model& model, const Surface& surface, const Rig& rig,
                                  const PackageOptions& options);

/// The same of the model (first) and of each of its levels; their rig.json name one another. Images are with the first.
/// `materials`: as the levels were made with them.
Result<std::vector<FacePackage>> build_packages(const Model& model, const Surface& surface, const Rig& rig,
                                                const MaterialAssignment& materials,
                                                std::span<const LevelOfDetail> levels, const PackageOptions& options);

/// preview.glb: the imported model for display and for marking feature points; every vertex has its number in the file
/// and its part. `parts` (by PartId) may be empty.
Result<std::vector<std::uint8_t>> build_preview(const Model& model, const Surface& surface,
                                                std::span<const Part> parts);

}  // namespace semblante
