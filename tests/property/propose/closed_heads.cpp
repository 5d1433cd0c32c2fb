#include "tests/property/propose/closed_heads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "core/anatomy/part_roles.h"
#include "core/anatomy/point_lookup.h"
#include "tests/oracle/real_heads.h"

namespace semblante::bench {
namespace {

void move_points_along(Head& head) {
  head.surface = build_surface(head.model);
  for (FeaturePoint& point : head.points) {
    if (point.vertex) point.position = head.model.positions[point.vertex->value()];
  }
}

/// identities.npy: a text header, then int16 of #modes x #V x 3.
Head other_person(Head head, const std::filesystem::path& ict, const std::vector<float>& coefficients) {
  constexpr float scale = 0.00011652006591998047F;
  std::ifstream in(ict / "identities.npy", std::ios::binary);
  std::array<char, 10> start{};
  in.read(start.data(), start.size());
  const auto header = static_cast<std::uint8_t>(start[8]) + 256 * static_cast<std::uint8_t>(start[9]);
  in.seekg(10 + header);
  std::vector<std::int16_t> mode(3 * head.model.positions.size());
  for (const float coefficient : coefficients) {
    in.read(reinterpret_cast<char*>(mode.data()), static_cast<std::streamsize>(mode.size() * sizeof(std::int16_t)));
    if (!in) throw std::runtime_error("identities.npy is of another model");
    for (std::size_t v = 0; v < head.model.positions.size(); ++v) {
      for (int axis = 0; axis < 3; ++axis) {
        head.model.positions[v][axis] += coefficient * scale * mode[3 * v + static_cast<std::size_t>(axis)];
      }
    }
  }
  move_points_along(head);
  return head;
}

}  // namespace

std::vector<ClosableHead> closable_heads() {
  std::vector<ClosableHead> closable;
  for (Head& head : known_heads()) {
    const std::string proportions = head.name == "sample head" ? "sample-head" : head.name;
    closable.push_back({std::move(head), proportions, proportions == "mediapipe-canonical"});
  }
  const auto faces = oracle::faces_folder();
  if (!faces) return closable;
  const auto ict = std::find_if(closable.begin(), closable.end(),
                                [](const ClosableHead& c) { return c.proportions == "ict-facekit"; });
  const Head generic = ict->head;
  const std::array<std::vector<float>, 2> people = {std::vector<float>{1.5F, -1.0F, 0.5F, 1.5F, -2.0F, 1.0F},
                                                    std::vector<float>{-1.5F, 1.5F, -1.0F, -0.5F, 1.5F, 2.0F}};
  for (std::size_t i = 0; i < people.size(); ++i) {
    Head head = other_person(generic, *faces / "ict-facekit", people[i]);
    head.name += ", person " + std::to_string(i + 1);
    closable.push_back({std::move(head), "ict-facekit", false});
  }
  return closable;
}

Head closed(const Head& head, double share) {
  const PosedFace face(head, WeightMethod::smooth);
  const double mns = face.rig().fapu[FapuUnit::mns].value();  // of one FAP unit
  LipGaps gaps{};
  if (face.rig().lip_gaps) gaps = *face.rig().lip_gaps;
  for (std::size_t i = 0; i < facing_lips.size(); ++i) {
    const double apart = find_point(head.points, facing_lips[i].upper)->position.y -
                         find_point(head.points, facing_lips[i].lower)->position.y;
    gaps.closing[i] = std::max({gaps.closing[i], apart, 20.0 * mns});
  }
  semblante_frame frame{};
  constexpr std::array<std::array<int, 2>, 3> lips = {{{4, 5}, {8, 10}, {9, 11}}};
  for (std::size_t i = 0; i < lips.size(); ++i) {
    for (const int fap : lips[i]) frame.fap[fap] = static_cast<float>(share * 0.5 * gaps.closing[i] / mns);
  }
  for (const int fap : {19, 20}) frame.fap[fap] = static_cast<float>(0.8 * share * 1024.0);
  for (const int fap : {21, 22}) frame.fap[fap] = static_cast<float>(0.2 * share * 1024.0);
  Head result = head;
  result.model.positions = face.pose(frame);
  move_points_along(result);
  return result;
}

Head lopsided(const Head& head) {
  Head result = head;
  for (glm::vec3& p : result.model.positions) p.y += 0.05F * p.x;
  move_points_along(result);
  return result;
}

Head with_positions_of(const Head& head, const std::string& file) {
  Head result = head;
  oracle::replace_positions(result.model, file);
  move_points_along(result);
  return result;
}

FeaturePointSet some_of(const FeaturePointSet& points, const std::vector<std::string_view>& names) {
  FeaturePointSet some;
  for (const FeaturePoint& point : points) {
    if (std::find(names.begin(), names.end(), to_string(point.id)) != names.end()) some.push_back(point);
  }
  return some;
}

Proposals propose_on(const ClosableHead& closable, const Head& head, const FeaturePointSet& known) {
  std::vector<ReferenceHead> others;
  for (const ReferenceHead& reference : reference_heads()) {
    if (reference.name != closable.proportions) others.push_back(reference);
  }
  auto proposals = propose_feature_points(head.surface, describe_parts(head.model, head.surface, known), known, others);
  if (!proposals) throw std::runtime_error(head.name + ": " + proposals.error().message);
  return *std::move(proposals);
}

}  // namespace semblante::bench
