#include "server/api/vertex_positions.h"

#include <cmath>

namespace semblante::api {

VertexPositions::VertexPositions(Context& context, const store::ModelRecord& model) {
  for (std::size_t i = 0; i < 3; ++i) diagonal_ = std::hypot(diagonal_, model.box_max[i] - model.box_min[i]);
  const auto artefact = context.store.artefact(model.id, "positions");
  if (!artefact) return;
  file_ = std::make_unique<MappedFile>(context.blobs.whole(artefact->sha256, artefact->bytes));
  // The mapping is page-aligned, so the array of float32 is aligned.
  xyz_ = {reinterpret_cast<const float*>(file_->bytes().data()), file_->bytes().size() / sizeof(float)};
}

std::optional<std::array<double, 3>> VertexPositions::of(std::uint32_t vertex) const {
  const std::size_t first = std::size_t{3} * vertex;
  if (first + 3 > xyz_.size()) return std::nullopt;
  return std::array<double, 3>{xyz_[first], xyz_[first + 1], xyz_[first + 2]};
}

double VertexPositions::square_of_way(std::size_t first, const std::array<double, 3>& position) const {
  const double x = xyz_[first] - position[0];
  const double y = xyz_[first + 1] - position[1];
  const double z = xyz_[first + 2] - position[2];
  return x * x + y * y + z * z;
}

std::optional<std::uint32_t> VertexPositions::only_one_at(const std::array<double, 3>& position) const {
  const double most = diagonal_ * at_place * diagonal_ * at_place;
  std::optional<std::uint32_t> found;
  for (std::size_t i = 0; i + 3 <= xyz_.size(); i += 3) {
    if (square_of_way(i, position) > most) continue;
    if (found) return std::nullopt;
    found = static_cast<std::uint32_t>(i / 3);
  }
  return found;
}

std::optional<std::uint32_t> VertexPositions::nearest(const std::array<double, 3>& position, double share) const {
  std::optional<std::uint32_t> best;
  double least = diagonal_ * share * diagonal_ * share;
  for (std::size_t i = 0; i + 3 <= xyz_.size(); i += 3) {
    const double square = square_of_way(i, position);
    if (square > least || (best && square == least)) continue;
    least = square;
    best = static_cast<std::uint32_t>(i / 3);
  }
  return best;
}

}  // namespace semblante::api
