#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "core/import/gltf_document.h"
#include "core/import/gltf_vertex_transform.h"
#include "core/import/model_builder.h"

namespace semblante::import {

/// Keeps the morph targets of all primitives aside as Model::examples. Targets of one name belong to one example: tools
/// split a head into meshes and primitives, and give each its share of a shape.
class MorphTargets {
 public:
  MorphTargets(GltfDocument& document, ModelBuilder& builder)
      : document_(document), builder_(builder), rows_left_(builder.limits().max_example_rows) {}

  /// The targets of one primitive, whose `count` file vertices begin at `first`, moved as its positions are. To be
  /// called in the order of file vertices.
  void read(const JsonCursor& mesh, const JsonCursor& primitive, std::size_t first, std::size_t count,
            const VertexTransform& transform);

 private:
  Example& example(const std::string& name);
  /// The first names only: a thousand primitives of one mesh may each have a target, and their mesh a million names.
  static std::vector<std::string> names_of(const JsonCursor& mesh, const JsonCursor& primitive, std::size_t most);

  GltfDocument& document_;
  ModelBuilder& builder_;
  std::size_t rows_left_;
  bool has_warned_ = false;
  std::map<std::string, std::size_t> by_name_;  ///< index into Model::examples
};

}  // namespace semblante::import
