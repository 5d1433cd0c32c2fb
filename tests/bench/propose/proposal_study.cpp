#include "tests/bench/propose/proposal_study.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "core/anatomy/part_roles.h"
#include "core/anatomy/point_lookup.h"
#include "core/parametrize/place_feature_points.h"
#include "core/tables/mpeg4.h"
#include "tests/oracle/real_heads.h"
#include "tests/support/sample_head_model.h"

namespace semblante::bench {
namespace {

ProposalStudy read_study(std::string name, const std::string& own_proportions, const std::filesystem::path& obj,
                         const std::filesystem::path& points, const std::filesystem::path& other_positions = {}) {
  ProposalStudy study;
  study.name = std::move(name);
  study.family = own_proportions;
  study.model = oracle::import_head(obj);
  std::vector<MarkedPoint> marked = oracle::read_trusted_points(points);
  if (!other_positions.empty()) {
    oracle::replace_positions(study.model, other_positions);
    std::erase_if(marked, [](const MarkedPoint& m) { return !m.vertex; });
    for (MarkedPoint& m : marked) m.position.reset();
  }
  study.surface = build_surface(study.model);
  auto placed = place_feature_points(study.model, study.surface, marked, nullptr);
  if (!placed) throw std::runtime_error(placed.error().message);
  study.placed = std::move(*placed);

  const auto json = nlohmann::json::parse(std::ifstream(points));
  for (const auto& [id, point] : json.at("points").items()) {
    const std::string sure = point.at("confidence");
    const auto found = std::find(confidence_names.begin(), confidence_names.end(), sure);
    study.placed_confidence[parse_feature_point(id)->value()] =
        static_cast<Confidence>(found - confidence_names.begin());
  }
  study.eye_separation =
      std::abs(find_point(study.placed, "3.5")->position.x - find_point(study.placed, "3.6")->position.x);
  for (const ReferenceHead& head : reference_heads()) {
    if (head.name != own_proportions) study.other_heads.push_back(head);
  }
  return study;
}

}  // namespace

std::vector<Part> ProposalStudy::parts_from(const FeaturePointSet& known) const {
  return describe_parts(model, surface, known);
}

std::vector<ProposalStudy> read_proposal_studies(const std::filesystem::path& faces) {
  const auto ict = faces / "ict-facekit";
  const auto makehuman = faces / "makehuman";
  const auto mask = faces / "mediapipe-canonical";
  std::vector<ProposalStudy> studies;
  studies.push_back(read_study("ict-facekit", "ict-facekit", ict / "neutral.obj", ict / "ict-facekit.fps.json"));
  studies.push_back(read_study("makehuman", "makehuman", makehuman / "head.obj", makehuman / "makehuman.fps.json"));
  studies.push_back(read_study("mediapipe-canonical", "mediapipe-canonical", mask / "face_model_with_iris.obj",
                               mask / "mediapipe-canonical.fps.json"));
  studies.push_back(read_study("ict-facekit, other person", "ict-facekit", ict / "neutral.obj",
                               ict / "ict-facekit.fps.json", ict / "identity-sample.obj"));
  return studies;
}

std::vector<ProposalStudy> make_sample_studies() {
  std::vector<ProposalStudy> studies;
  for (const testing::FamilyMember& member : testing::sample_family()) {
    ProposalStudy study;
    study.name = member.name;
    study.family = "sample-head";
    study.model = testing::sample_head_model(member.traits);
    study.surface = build_surface(study.model);
    study.placed = testing::sample_head_points(member.traits);
    for (const FeaturePoint& point : study.placed) study.placed_confidence[point.id.value()] = Confidence::high;
    study.eye_separation =
        std::abs(find_point(study.placed, "3.5")->position.x - find_point(study.placed, "3.6")->position.x);
    for (const ReferenceHead& head : reference_heads()) {
      if (head.name != "sample-head") study.other_heads.push_back(head);
    }
    studies.push_back(std::move(study));
  }
  return studies;
}

double share_within_claim(const std::vector<ProposalError>& errors) {
  const auto within =
      std::count_if(errors.begin(), errors.end(), [](const ProposalError& e) { return e.error <= e.claimed; });
  return errors.empty() ? 0.0 : static_cast<double>(within) / static_cast<double>(errors.size());
}

double factor_for_nine_in_ten(const std::vector<ProposalError>& errors) {
  std::vector<double> factors;
  for (const ProposalError& e : errors) factors.push_back(e.error / e.claimed);
  std::sort(factors.begin(), factors.end());
  return factors.empty() ? 0.0 : factors[(factors.size() * 9 + 9) / 10 - 1];
}

FeaturePointSet some_points(const ProposalStudy& study, const std::vector<std::string_view>& names) {
  FeaturePointSet some;
  for (const std::string_view name : names) {
    if (const FeaturePoint* const point = find_point(study.placed, name)) some.push_back(*point);
  }
  return some;
}

std::vector<ProposalError> errors_from(const ProposalStudy& study, const std::vector<std::string_view>& names) {
  const FeaturePointSet known = some_points(study, names);
  const auto proposals = propose_feature_points(study.surface, study.parts_from(known), known, study.other_heads, {},
                                                study.model.triangles);
  if (!proposals) throw std::runtime_error(study.name + ": " + proposals.error().message);
  return errors_of(study, *proposals);
}

std::vector<ProposalError> errors_of(const ProposalStudy& study, const Proposals& proposals) {
  std::vector<ProposalError> errors;
  for (const Proposal& proposal : proposals.points) {
    const FeaturePoint* const placed = find_point(study.placed, to_string(proposal.point.id));
    if (placed == nullptr) continue;
    const double off = glm::distance(glm::dvec3(proposal.point.position), glm::dvec3(placed->position));
    errors.push_back({proposal.point.id, off / study.eye_separation, proposal.method, proposal.confidence,
                      proposal.expected_error, study.placed_confidence.at(proposal.point.id.value())});
  }
  return errors;
}

std::vector<std::string_view> random_names(const ProposalStudy& study, std::size_t count, std::mt19937& random) {
  std::vector<std::string_view> names;
  for (const FeaturePoint& point : study.placed) names.push_back(mpeg4::feature_points[point.id.value()].id);
  // Not std::shuffle: the same draw with every standard library.
  for (std::size_t i = 0; i + 1 < names.size(); ++i) std::swap(names[i], names[i + random() % (names.size() - i)]);
  names.resize(std::min(count, names.size()));
  return names;
}

double share_within(std::vector<ProposalError> errors, double share) {
  if (errors.empty()) return 0.0;
  std::sort(errors.begin(), errors.end(),
            [](const ProposalError& a, const ProposalError& b) { return a.error < b.error; });
  const auto at = static_cast<std::size_t>(std::ceil(share * static_cast<double>(errors.size())));
  return errors[std::max<std::size_t>(at, 1) - 1].error;
}

}  // namespace semblante::bench
