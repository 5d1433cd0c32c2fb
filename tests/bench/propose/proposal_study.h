#pragma once

#include <filesystem>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "core/geometry/surface.h"
#include "core/propose/propose.h"
#include "core/types/feature_points.h"
#include "core/types/model.h"

namespace semblante::bench {

/// A real head with points that somebody placed on it, to hold proposals against.
struct ProposalStudy {
  std::string name;
  std::string family;  ///< of the head, by its own proportions; heads of one family are not independent
  Model model;
  Surface surface;
  FeaturePointSet placed;
  std::map<std::uint8_t, Confidence> placed_confidence;  ///< how sure the placed points are, by id
  double eye_separation = 1.0;                           ///< ES0, model units
  std::vector<ReferenceHead> other_heads;                ///< the proportions of all heads but this one

  [[nodiscard]] std::vector<Part> parts_from(const FeaturePointSet& known) const;
};

/// The three heads, and another person on the mesh of the first.
std::vector<ProposalStudy> read_proposal_studies(const std::filesystem::path& faces);

struct ProposalError {
  FeaturePointId id;
  double error = 0.0;  ///< distance of the proposed from the placed point, in ES0
  ProposalMethod method = ProposalMethod::proportion;
  Confidence confidence = Confidence::low;
  double claimed = 0.0;  ///< expected_error of the proposal
  Confidence placed = Confidence::low;
};

/// The family of our own sample head; none is measured against the sample head's.
std::vector<ProposalStudy> make_sample_studies();

/// The share of proposals that lie within what they claim: their expected_error.
double share_within_claim(const std::vector<ProposalError>& errors);

/// The factor for all claims with which nine in ten of the proposals lie within theirs.
double factor_for_nine_in_ten(const std::vector<ProposalError>& errors);

/// The placed points of those names, as far as the head has them.
FeaturePointSet some_points(const ProposalStudy& study, const std::vector<std::string_view>& names);

/// Proposes from those points and compares with the others. Points that nobody placed are not counted.
std::vector<ProposalError> errors_from(const ProposalStudy& study, const std::vector<std::string_view>& names);

/// Compares with the placed points. Points that nobody placed are not counted.
std::vector<ProposalError> errors_of(const ProposalStudy& study, const Proposals& proposals);

/// `count` different points of the head.
std::vector<std::string_view> random_names(const ProposalStudy& study, std::size_t count, std::mt19937& random);

/// The least distance that this share of them (0.5: the median) stays within.
double share_within(std::vector<ProposalError> errors, double share);

}  // namespace semblante::bench
