#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "core/bridges/arkit.h"
#include "core/extract/named_set.h"
#include "core/types/model.h"

namespace semblante {

/// A face as a sum of the model's shapes, each with its share.
using ShapeSum = std::vector<std::pair<const Example*, float>>;

/// The model's shapes by what they show. The model must outlive it.
class NamedShapes {
 public:
  explicit NamedShapes(const Model& model);

  /// The shape that is named for a viseme of FAP 1 or an expression of FAP 2; else the sum of ARKit's shapes that
  /// arkit_from_frame gives for it, if the model has most of them; else empty.
  [[nodiscard]] ShapeSum find(SetKind kind, std::size_t number) const;

 private:
  [[nodiscard]] ShapeSum from_arkit(SetKind kind, std::size_t number) const;

  std::map<std::pair<SetKind, std::size_t>, const Example*> named_;
  std::array<const Example*, arkit_count> arkit_{};
};

/// "viseme_aa", or "5 ARKit shapes".
std::string source_of(const ShapeSum& sum);

/// The displacement of a file vertex.
glm::vec3 displacement_of(const ShapeSum& sum, std::uint32_t vertex);

}  // namespace semblante
