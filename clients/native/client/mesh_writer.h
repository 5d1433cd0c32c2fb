#pragma once

#include <span>
#include <string>

#include <glm/vec3.hpp>

#include "core/types/model.h"

namespace semblante::client {

/// Wavefront OBJ: `v` lines in vertex order, `vt` if the model has UVs, one group per primitive. Numbers are the
/// shortest decimals that parse to the same float32.
std::string write_obj(const Model& model, std::span<const glm::vec3> positions);

/// Binary little-endian PLY with float x, y, z and uchar-counted uint triangles.
std::string write_ply(const Model& model, std::span<const glm::vec3> positions);

/// "vertex,x,y,z" and one line per vertex.
std::string write_table(std::span<const glm::vec3> positions);

}  // namespace semblante::client
