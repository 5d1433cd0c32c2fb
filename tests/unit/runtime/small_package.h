#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "clients/runtime/semblante.h"
#include "protocol/cpp/rig_document.h"
#include "protocol/cpp/weights_format.h"
#include "protocol/hash/sha256.h"

namespace semblante::testing {

/// Four vertices whose frames can be worked out by hand:
///   0 is FP 2.1 itself, 1 follows it by half (8.1 has the other half), 2 is of the left eye, 3 is still.
/// MNS is 0.01 model units, the left eye's pivot is (1, 1, 0), the head's (0, 0, 0).
struct SmallPackage {
  std::vector<float> positions = {0, 0, 0, 0, 1, 0, 1, 1, 1, 5, 5, 5};
  InfluenceTable table;
  RigDocument rig;
  std::vector<std::uint8_t> weights;
  std::string rig_json;

  SmallPackage() {
    const FeaturePointId chin = *parse_feature_point("2.1");
    const FeaturePointId lip = *parse_feature_point("8.1");
    table.vertex_count = 4;
    table.mesh_sha256.fill(0x5A);
    table.rows.push(chin, 1.0F);
    table.rows.end_row();
    table.rows.push(chin, 0.5F);
    table.rows.push(lip, 0.5F);
    table.rows.end_row();
    table.rows.end_row();
    table.rows.end_row();
    table.rigid = {0, 0, 1, 0};
    rig.name = "small";
    rig.mesh.sha256 = table.mesh_sha256;
    rig.mesh.vertices = 4;
    rig.mesh.triangles = 1;
    rig.mesh.attributes.position = 0;
    rig.fapu.value[static_cast<std::size_t>(FapuUnit::mns)] = 0.01;
    rig.eye_pivots = {glm::vec3(1, 1, 0), glm::vec3(-1, 1, 0)};
    rig.materials.emplace_back();
    for (std::size_t i = 0; i < rig.visemes.size(); ++i) {
      rig.visemes[i].name = std::to_string(i);
    }
    for (std::size_t i = 0; i < rig.expressions.size(); ++i) {
      rig.expressions[i].name = std::to_string(i);
    }
    rig.expressions[1].displacements.push_back({lip, glm::vec3(0, 0.4F, 0)});
    seal();
  }

  /// To be called after a change of `table` or `rig`.
  void seal() {
    weights = encode_weights(table, {.bits = 16});
    rig.weights.sha256 = sha256(weights);
    rig_json = write_rig(rig);
  }

  [[nodiscard]] semblante_package view() const {
    semblante_package package{};
    package.size = sizeof(package);
    package.positions = positions.data();
    package.vertex_count = static_cast<std::uint32_t>(positions.size() / 3);
    package.mesh_sha256 = table.mesh_sha256.data();
    package.weights = weights.data();
    package.weights_size = weights.size();
    package.rig_json = rig_json.data();
    package.rig_json_size = rig_json.size();
    return package;
  }
};

}  // namespace semblante::testing
