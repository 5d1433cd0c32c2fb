#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "core/import/gltf_document.h"
#include "core/import/gltf_vertex_transform.h"
#include "core/import/model_builder.h"

namespace semblante::import {

/// Collects the morph targets of all primitives as Model::examples. Targets with equal names form one example, because
/// tools split a head into meshes and primitives, each with a part of the shape.
class MorphTargets {
 public:
  MorphTargets(GltfDocument& document, ModelBuilder& builder)
      : document_(document), builder_(builder), rows_left_(builder.limits().max_example_rows) {}

  /// Reads the targets of one primitive, whose `count` file vertices begin at `first`, with the transform of its
  /// positions. Call in the order of file vertices.
  void read(const JsonCursor& mesh, const JsonCursor& primitive, std::size_t first, std::size_t count,
            const VertexTransform& transform);

  /// Warns if viewers of the file show a target that the head is read without: a face that was shaped by targets, or
  /// saved within an expression.
  void warn_of_shown();

 private:
  Example& example(const std::string& name);
  /// Only the first `most` names, because a hostile mesh may have a million names for each of a thousand primitives.
  static std::vector<std::string> names_of(const JsonCursor& mesh, const JsonCursor& primitive, std::size_t most);

  static std::string name_of(const std::vector<std::string>& names, std::size_t target);

  GltfDocument& document_;
  ModelBuilder& builder_;
  std::size_t rows_left_;
  bool has_warned_ = false;
  std::map<std::string, std::size_t> by_name_;  ///< index into Model::examples
};

}  // namespace semblante::import
