#include "server/api/vertex_positions.h"

#include <cmath>

namespace semblante::api {

VertexPositions::VertexPositions(Context& context, const store::ModelRecord& model) {
  for (std::size_t i = 0; i < 3; ++i) diagonal_ = std::hypot(diagonal_, model.box_max[i] - model.box_min[i]);
  const auto artefact = context.store.artefact(model.id, "positions");
  const auto path = artefact ? context.blobs.find(artefact->sha256) : std::nullopt;
  if (!path) return;
  file_ = std::make_unique<MappedFile>(*path);
  // The file is an array of float32 from a mapping, which begins at a page.
  xyz_ = {reinterpret_cast<const float*>(file_->bytes().data()), file_->bytes().size() / sizeof(float)};
}

std::optional<std::array<double, 3>> VertexPositions::of(std::uint32_t vertex) const {
  const std::size_t first = std::size_t{3} * vertex;
  if (first + 3 > xyz_.size()) return std::nullopt;
  return std::array<double, 3>{xyz_[first], xyz_[first + 1], xyz_[first + 2]};
}

std::optional<std::uint32_t> VertexPositions::nearest(const std::array<double, 3>& position, double share) const {
  std::optional<std::uint32_t> best;
  double least = diagonal_ * share * diagonal_ * share;
  for (std::size_t i = 0; i + 3 <= xyz_.size(); i += 3) {
    const double x = xyz_[i] - position[0];
    const double y = xyz_[i + 1] - position[1];
    const double z = xyz_[i + 2] - position[2];
    const double square = x * x + y * y + z * z;
    if (square > least || (best && square == least)) continue;
    least = square;
    best = static_cast<std::uint32_t>(i / 3);
  }
  return best;
}

}  // namespace semblante::api
