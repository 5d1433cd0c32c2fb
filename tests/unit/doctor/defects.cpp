#include "tests/unit/doctor/defects.h"

#include <algorithm>
#include <array>

#include <glm/geometric.hpp>

#include "core/anatomy/part_roles.h"
#include "core/anatomy/pivots.h"
#include "core/tables/mpeg4.h"
#include "tests/support/meshes.h"
#include "tests/unit/doctor/spoil.h"

namespace semblante::testing {
namespace {

using Code = FindingCode;

std::vector<FeaturePointId> ids(std::initializer_list<std::string_view> names) {
  std::vector<FeaturePointId> list;
  for (const std::string_view name : names) list.push_back(fp(name));
  return list;
}

/// A triangle from one rim to the other, as a hole filler or a bridge tool leaves it.
void bridge(Head& head, std::string_view upper, std::string_view lower) {
  const std::uint32_t a = vertex(head, upper);
  add_triangle(head, {a, vertex(head, lower), neighbor(head, a)});
}

/// The two rims of the mouth, from point to point.
constexpr Leg mouth_rim[] = {{"2.4", "2.6"}, {"2.6", "2.2"}, {"2.2", "2.7"}, {"2.7", "2.5"},
                             {"2.5", "2.9"}, {"2.9", "2.3"}, {"2.3", "2.8"}, {"2.8", "2.4"}};
constexpr Leg left_eye_rim[] = {{"3.7", "3.1"}, {"3.1", "3.11"}, {"3.11", "3.3"}, {"3.3", "3.7"}};

/// Draws every vertex between two points into one of them: a rim of as many edges as points.
void coarsen(Head& head, std::span<const Leg> rim) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const auto& between : ways(head, rim))
    for (std::size_t i = 1; i + 1 < between.size(); ++i)
      pairs.emplace_back(i * 2 < between.size() ? between.front() : between.back(), between[i]);
  weld(head, pairs);
}

/// The part of the vertex that was added last.
PartId last_part(const Head& head) {
  const Surface surface = build_surface(head.model);
  return surface.part_of[surface.surface_of.back().value()];
}

std::vector<std::uint32_t> every_triangle(const Head& head) {
  std::vector<std::uint32_t> all(head.model.triangles.size());
  for (std::uint32_t t = 0; t < all.size(); ++t) all[t] = t;
  return all;
}

std::vector<Defect> make_defects() {
  std::vector<Defect> list;
  const auto add = [&](std::string name, Code code, std::function<std::optional<Expected>(Head&)> plant) {
    list.push_back({std::move(name), code, std::move(plant), false});
  };

  // ---- the way round
  add("upside_down", Code::upside_down, [](Head& h) {
    transform(h, turn(2, 180.0));
    return Expected{ids({"2.1", "3.5"}), {}, {}};
  });
  add("turned_backwards", Code::facing_away, [](Head& h) {
    transform(h, turn(1, 180.0));
    return Expected{ids({"2.1", "3.5"}), {}, {}};
  });
  add("lying_on_its_back", Code::not_upright, [](Head& h) {
    transform(h, turn(0, -90.0));
    return Expected{ids({"2.1", "3.5"}), {}, {}};
  });
  add("turned_aside", Code::not_upright, [](Head& h) {
    transform(h, turn(1, 50.0));
    return Expected{ids({"2.1", "3.5"}), {}, {}};
  });
  add("turned_a_little", Code::not_upright, [](Head& h) {
    transform(h, turn(1, 15.0));
    return Expected{ids({"2.1", "3.5"}), {}, {}, "turned by 15 degrees to its left"};
  });
  add("tilted_a_little", Code::not_upright, [](Head& h) {
    transform(h, turn(2, -12.0));
    return Expected{ids({"2.1", "3.5"}), {}, {}, "tilted by 12 degrees towards its left shoulder"};
  });
  add("mirrored", Code::left_right_swapped, [](Head& h) {
    transform(h, glm::dmat3(-1, 0, 0, 0, 1, 0, 0, 0, 1));
    flip(h, every_triangle(h));
    return Expected{ids({"8.3", "8.4", "3.5", "3.6"}), {}, {}};
  });
  add("all_pairs_exchanged", Code::left_right_swapped, [](Head& h) {
    const FeaturePointSet marked = h.points;
    for (const FeaturePoint& p : marked) {
      const std::uint8_t other = mpeg4::feature_points[p.id.value()].mirror;
      if (mpeg4::feature_points[p.id.value()].side == mpeg4::Side::left)
        exchange(h, to_string(p.id), to_string(FeaturePointId(other)));
    }
    return Expected{ids({"8.3", "8.4", "3.5", "3.6"}), {}, {}};
  });
  add("mouth_corners_exchanged", Code::left_right_swapped, [](Head& h) {
    exchange(h, "8.3", "8.4");
    return Expected{ids({"8.3", "8.4"}), place(h, "8.3"), {}};
  });

  // ---- points
  add("brow_off_its_mirror", Code::point_off_mirror, [](Head& h) {
    mark(h, "4.3", skin_vertex_near(h, place(h, "4.3") + unit(h) * glm::dvec3(0.0, 0.3, 0.0)));
    return Expected{ids({"4.3", "4.4"}), place(h, "4.3"), {}};
  });
  add("chin_off_the_middle", Code::point_off_mirror, [](Head& h) {
    mark(h, "2.10", skin_vertex_near(h, place(h, "2.10") + unit(h) * glm::dvec3(0.25, 0.0, 0.0)));
    return Expected{ids({"2.10"}), place(h, "2.10"), {}};
  });
  add("upper_lip_below_the_lower", Code::point_out_of_order, [](Head& h) {
    mark(h, "2.2", skin_vertex_near(h, 0.5 * (place(h, "8.2") + place(h, "2.10"))));
    return Expected{ids({"2.2"}), place(h, "2.2"), {}};
  });
  add("brow_under_the_eye", Code::point_out_of_order, [](Head& h) {
    mark(h, "4.1", skin_vertex_near(h, place(h, "3.9") - unit(h) * glm::dvec3(0.0, 0.1, 0.0)));
    return Expected{ids({"4.1"}), place(h, "4.1"), {}};
  });
  add("lips_exchanged", Code::point_out_of_order, [](Head& h) {
    exchange(h, "8.1", "8.2");
    return Expected{ids({"8.1"}), {}, {}};
  });
  add("two_points_on_one_vertex", Code::points_on_one_vertex, [](Head& h) {
    mark(h, "8.9", vertex(h, "8.1"));
    return Expected{ids({"8.1", "8.9"}), place(h, "8.1"), {}};
  });
  add("lip_point_on_an_eyeball", Code::point_on_wrong_part, [](Head& h) {
    Expected expected{ids({"8.1"}), {}, PartId(0)};
    mark(h, "8.1", vertex_of_role(h, {PartRole::left_eye}, &*expected.part));
    return expected;
  });
  add("lid_point_on_lash_or_hair", Code::point_on_wrong_part, [](Head& h) {
    Expected expected{ids({"3.9"}), {}, PartId(0)};
    mark(h, "3.9", vertex_of_role(h, {PartRole::attached, PartRole::rest}, &*expected.part));
    return expected;
  });
  add("pupil_on_the_skin", Code::point_on_wrong_part, [](Head& h) {
    mark(h, "3.5", neighbor(h, vertex(h, "3.3")));
    return Expected{ids({"3.5"}), place(h, "3.5"), {}};
  });
  add("point_on_a_loose_vertex", Code::point_on_no_surface, [](Head& h) {
    mark(h, "8.1", add_vertex(h, place(h, "8.1")));
    return Expected{ids({"8.1"}), place(h, "8.1"), {}};
  });
  add("point_on_an_inner_wall", Code::point_on_inside, [](Head& h) {
    const auto front = triangles_near(h, place(h, "5.1"), 0.2 * unit(h));
    std::vector<std::uint32_t> inner(h.model.positions.size(), 0);
    for (const std::uint32_t t : front) {
      Triangle wall = h.model.triangles[t];
      for (std::uint32_t& corner : wall) {
        std::uint32_t& copy = inner[corner];
        if (copy == 0) copy = add_vertex(h, glm::dvec3(h.model.positions[corner]) - unit(h) * glm::dvec3(0, 0, 0.05));
        corner = copy;
      }
      add_triangle(h, {wall[0], wall[2], wall[1]});
    }
    const Triangle edge = h.model.triangles[front.front()];
    add_triangle(h, {edge[0], edge[1], inner[edge[0]]});  // the wall is one with the skin
    mark(h, "5.1", inner[vertex(h, "5.1")]);
    return Expected{ids({"5.1"}), place(h, "5.1"), {}};
  });
  add("base_of_the_nose_missing", Code::missing_points, [](Head& h) {
    unmark(h, {"9.15"});
    return Expected{ids({"9.15"}), {}, {}};
  });
  add("inner_lips_missing", Code::missing_points, [](Head& h) {
    unmark(h, {"2.2", "2.3", "2.4", "2.5", "2.6", "2.7", "2.8", "2.9"});
    return Expected{ids({"2.2", "2.3", "2.4", "2.5", "2.6", "2.7", "2.8", "2.9"}), {}, {}};
  });
  add("no_point_at_all", Code::no_points, [](Head& h) {
    h.points.clear();
    return Expected{};
  });

  // ---- units
  add("upper_lids_on_the_lower", Code::point_on_other_rim, [](Head& h) {
    mark(h, "3.1", vertex(h, "3.3"));
    mark(h, "3.2", vertex(h, "3.4"));
    return Expected{ids({"3.1"}), place(h, "3.3"), {}};
  });
  add("base_of_the_nose_on_the_lip", Code::unit_implausible, [](Head& h) {
    mark(h, "9.15", skin_vertex_near(h, 0.5 * (place(h, "8.1") + place(h, "2.2"))));
    return Expected{ids({"9.15", "2.2"}), place(h, "9.15"), {}};
  });
  add("pupil_beside_the_eye", Code::unit_implausible, [](Head& h) {
    FeaturePoint& pupil = point(h, "3.5");
    pupil.vertex.reset();
    pupil.position.x += static_cast<float>(0.5 * unit(h));
    return Expected{ids({"3.5", "3.6"}), place(h, "3.5"), {}};
  });

  // ---- lips and lids
  add("lips_bridged_in_the_middle", Code::lips_joined, [](Head& h) {
    bridge(h, "2.2", "2.3");
    return Expected{ids({"2.2", "2.3"}), place(h, "2.2"), {}};
  });
  add("lips_bridged_at_the_side", Code::lips_joined, [](Head& h) {
    bridge(h, "2.7", "2.9");
    return Expected{ids({"2.7", "2.9"}), place(h, "2.7"), {}};
  });
  add("lips_welded_beside_the_points", Code::lips_joined, [](Head& h) {
    const auto rims = ways(h, std::array<Leg, 2>{{{"2.2", "2.6"}, {"2.3", "2.8"}}});
    weld(h, {{rims[0][rims[0].size() / 2], rims[1][rims[1].size() / 2]}});
    return Expected{{}, place(h, "2.6"), {}};
  });
  add("lips_fused", Code::lips_joined, [](Head& h) {
    weld(h, {{vertex(h, "2.2"), vertex(h, "2.3")}});
    mark(h, "2.3", vertex(h, "2.2"));
    return Expected{ids({"2.2", "2.3"}), place(h, "2.2"), {}};
  });
  add("left_lids_bridged", Code::lids_joined, [](Head& h) {
    bridge(h, "3.1", "3.3");
    return Expected{ids({"3.1", "3.3"}), place(h, "3.1"), {}};
  });
  add("right_lids_bridged", Code::lids_joined, [](Head& h) {
    bridge(h, "3.2", "3.4");
    return Expected{ids({"3.2", "3.4"}), place(h, "3.2"), {}};
  });
  add("lips_sewn_together", Code::lips_leak, [](Head& h) {
    for (const auto& [upper, lower] : {std::pair{"2.2", "2.3"}, std::pair{"2.6", "2.8"}, std::pair{"2.7", "2.9"}})
      bridge(h, upper, lower);
    return Expected{{}, place(h, "2.2"), {}};
  });
  list.back().needs_weights = true;
  add("mouth_open", Code::mouth_open, [](Head& h) {
    const std::uint32_t lip = vertex(h, "2.3");
    h.model.positions[lip].y -= static_cast<float>(0.08 * unit(h));
    mark(h, "2.3", lip);
    return Expected{ids({"2.2", "2.3"}), place(h, "2.3"), {}};
  });
  add("eye_closed", Code::eye_not_open, [](Head& h) {
    const std::uint32_t lid = vertex(h, "3.1");
    h.model.positions[lid].y = static_cast<float>(place(h, "3.3").y + 0.03 * unit(h));
    mark(h, "3.1", lid);
    return Expected{ids({"3.1", "3.3"}), place(h, "3.1"), {}};
  });
  add("mouth_coarse", Code::mouth_too_coarse, [](Head& h) {
    coarsen(h, mouth_rim);
    return Expected{ids({"2.2", "2.3"}), place(h, "2.2"), {}};
  });
  add("eye_coarse", Code::eye_too_coarse, [](Head& h) -> std::optional<Expected> {
    if (ways(h, left_eye_rim)[0].size() < 2) return std::nullopt;  // its upper lids are parts of their own
    coarsen(h, left_eye_rim);
    return Expected{ids({"3.1", "3.3"}), place(h, "3.1"), {}};
  });
  add("mouth_dense", Code::face_too_dense, [](Head& h) {
    std::vector<std::uint32_t> rim;
    for (const auto& vertices : ways(h, mouth_rim)) rim.insert(rim.end(), vertices.begin(), vertices.end());
    std::vector<std::uint32_t> around;
    for (std::uint32_t t = 0; t < h.model.triangles.size(); ++t) {
      const Triangle& corners = h.model.triangles[t];
      if (std::any_of(corners.begin(), corners.end(),
                      [&](std::uint32_t c) { return std::find(rim.begin(), rim.end(), c) != rim.end(); }))
        around.push_back(t);
    }
    subdivide(h, around, 4);
    return Expected{ids({"2.2", "2.3"}), place(h, "2.2"), {}};
  });

  // ---- far away
  add("lash_left_behind", Code::far_vertices, [](Head& h) {
    begin_primitive(h, "lash");
    const glm::dvec3 at = place(h, "3.1") + unit(h) * glm::dvec3(150.0, 0.0, 0.0);
    const std::uint32_t stray = add_vertex(h, at);
    const std::uint32_t near = vertex(h, "3.1");
    add_triangle(h, {near, neighbor(h, near), stray});
    return Expected{{}, at, {}, "left behind"};
  });
  add("far_from_the_origin", Code::coarse_coordinates, [](Head& h) {
    const auto by = glm::vec3(glm::dvec3(1e5 * unit(h), 0.0, 0.0));
    for (glm::vec3& position : h.model.positions) position += by;
    for (FeaturePoint& point : h.points) point.position += by;
    return Expected{{}, {}, {}, "far from the origin"};
  });

  // ---- parts and borders
  add("skin_cut_below_the_nose", Code::skin_in_pieces, [](Head& h) {
    const double level = 0.5 * (place(h, "9.15").y + place(h, "8.1").y);
    cut(h, [level](const glm::dvec3& at) { return at.y < level; }, {0.0, -1e-4 * unit(h), 0.0});
    return Expected{ids({"2.1"}), {}, {}};
  });
  add("seam_open_by_a_hair", Code::open_seam, [](Head& h) {
    const glm::dvec3 at = place(h, "5.1");
    const double radius = 0.2 * unit(h);
    cut(h, [=](const glm::dvec3& p) { return glm::distance(p, at) < radius; }, {0.0, 0.0, 1e-4 * unit(h)});
    return Expected{{}, at, {}};
  });
  add("hole_in_the_cheek", Code::hole_near_points, [](Head& h) {
    const auto at = glm::dvec3(h.model.positions[skin_vertex_near(h, 0.5 * (place(h, "5.1") + place(h, "5.3")))]);
    erase(h, triangles_near(h, at, 0.12 * unit(h)));
    return Expected{{}, at, {}};
  });
  add("second_skin", Code::second_skin, [](Head& h) {
    begin_primitive(h, "copy");
    copy_skin(h, glm::dmat3(0.98), {}, [](const glm::dvec3&) { return true; });
    return Expected{{}, {}, last_part(h), {}};
  });
  add("plate_over_the_chin", Code::idle_part, [](Head& h) {
    begin_primitive(h, "plate");
    const double top = place(h, "8.2").y;
    const double bottom = place(h, "2.1").y;
    const double back = place(h, "2.13").z;
    copy_skin(h, glm::dmat3(1.0), unit(h) * glm::dvec3(0.0, 0.0, 0.03),
              [=](const glm::dvec3& at) { return at.y < top && at.y > bottom && at.z > back; });
    return Expected{{}, {}, {}, "\"plate\""};
  });
  add("eyeball_too_large", Code::lids_in_eye, [](Head& h) -> std::optional<Expected> {
    const Surface surface = build_surface(h.model);
    const std::vector<Part> parts = describe_parts(h.model, surface, h.points);
    const auto ball = round_eyeball(surface, parts, PartRole::left_eye);
    if (!ball) return std::nullopt;
    for (std::size_t v = 0; v < h.model.positions.size(); ++v) {
      if (parts[surface.part_of[surface.surface_of[v].value()].value()].role != PartRole::left_eye) continue;
      glm::vec3& at = h.model.positions[v];
      at = glm::vec3(ball->center + 1.35 * (glm::dvec3(at) - ball->center));
    }
    return Expected{ids({"3.1"}), {}, {}, "left eye lies in the eyeball"};
  });
  add("eyeballs_missing", Code::eye_cannot_turn, [](Head& h) {
    erase_parts(h, {PartRole::left_eye});
    FeaturePoint& pupil = point(h, "3.5");
    pupil.vertex.reset();
    return Expected{ids({"3.5"}), place(h, "3.5"), {}};
  });

  // ---- triangles
  add("inside_out", Code::inside_out, [](Head& h) {
    flip(h, every_triangle(h));
    return Expected{};
  });
  add("patch_flipped", Code::inconsistent_winding, [](Head& h) {
    flip(h, triangles_near(h, place(h, "5.1"), 0.15 * unit(h)));
    return Expected{{}, place(h, "5.1"), {}};
  });
  add("fin_on_the_nose", Code::non_manifold_edges, [](Head& h) {
    const std::uint32_t tip = vertex(h, "9.3");
    add_triangle(h, {tip, neighbor(h, tip), add_vertex(h, place(h, "9.3") + unit(h) * glm::dvec3(0.1, 0.1, 0.1))});
    return Expected{{}, place(h, "9.3"), {}};
  });
  add("triangles_doubled", Code::duplicate_triangles, [](Head& h) {
    for (const std::uint32_t t : triangles_near(h, place(h, "9.3"), 0.15 * unit(h)))
      add_triangle(h, Triangle(h.model.triangles[t]));
    return Expected{{}, place(h, "9.3"), {}};
  });
  add("triangles_collapsed", Code::degenerate_triangles, [](Head& h) {
    const std::uint32_t at = vertex(h, "5.1");
    const std::uint32_t gone = neighbor(h, at);
    h.model.positions[gone] = h.model.positions[at];
    return Expected{{}, place(h, "5.1"), {}};
  });
  add("vertex_left_over", Code::unused_vertices, [](Head& h) {
    return Expected{
        {}, glm::dvec3(h.model.positions[add_vertex(h, place(h, "9.3") + glm::dvec3(0, 0, unit(h)))]), {}, {}};
  });
  return list;
}

}  // namespace

const std::vector<Defect>& defects() {
  static const std::vector<Defect> list = make_defects();
  return list;
}

}  // namespace semblante::testing
