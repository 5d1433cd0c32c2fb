#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/mat3x3.hpp>

#include "core/geometry/surface.h"
#include "tests/unit/doctor/heads.h"

// What defects are planted with: small changes of a head, each in the way a program or a person makes them.
namespace semblante::testing {

FeaturePoint& point(Head& head, std::string_view name);
std::uint32_t vertex(Head& head, std::string_view name);
glm::dvec3 place(Head& head, std::string_view name);
/// ES0.
double unit(Head& head);

/// The vertex of the face's skin that is nearest to a place.
std::uint32_t skin_vertex_near(Head& head, const glm::dvec3& to);
/// A vertex that shares an edge with one.
std::uint32_t neighbor(const Head& head, std::uint32_t of);
/// Any vertex of the first part with one of these roles; the part's number in `part`.
std::uint32_t vertex_of_role(Head& head, std::vector<PartRole> roles, PartId* part);

void mark(Head& head, std::string_view name, std::uint32_t at);
void unmark(Head& head, std::vector<std::string_view> names);
/// Exchanges the points of a pair.
void exchange(Head& head, std::string_view a, std::string_view b);

/// About an axis (0 is x); positive angles turn the next axis towards the one after it.
glm::dmat3 turn(int axis, double degrees);
/// Of the model and the points on it.
void transform(Head& head, const glm::dmat3& by);
/// The triangles whose middle is within `radius` of a place.
std::vector<std::uint32_t> triangles_near(const Head& head, const glm::dvec3& at, double radius);
void flip(Head& head, const std::vector<std::uint32_t>& triangles);
void erase(Head& head, const std::vector<std::uint32_t>& triangles);
/// The triangles of the parts with one of these roles.
void erase_parts(Head& head, std::vector<PartRole> roles);
/// Triangles added from here on have this name.
void begin_primitive(Head& head, const std::string& name);
/// Adds, as a part of its own, those of the skin's triangles whose middle is wanted: scaled about the origin, then
/// moved.
void copy_skin(Head& head, const glm::dmat3& scale, const glm::dvec3& by,
               const std::function<bool(const glm::dvec3&)>& wanted);
/// Adds a triangle to the last primitive.
void add_triangle(Head& head, const Triangle& triangle);
std::uint32_t add_vertex(Head& head, const glm::dvec3& at);
/// Makes vertices of the surface one: the second of each pair disappears into the first.
void weld(Head& head, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs);
/// Cuts the surface where `beyond` changes from false to true and moves what is beyond by `by`.
void cut(Head& head, const std::function<bool(const glm::dvec3&)>& beyond, const glm::dvec3& by);
/// Quarters triangles, and their pieces, so many times.
void subdivide(Head& head, std::vector<std::uint32_t> triangles, int times);
/// From one point to another.
using Leg = std::pair<std::string_view, std::string_view>;
/// The vertices on the way along the surface, from the second point of each leg back to the first, both included.
std::vector<std::vector<std::uint32_t>> ways(Head& head, std::span<const Leg> legs);

}  // namespace semblante::testing
