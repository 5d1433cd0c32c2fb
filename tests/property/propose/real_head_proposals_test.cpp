// Proposals against points placed with care on heads made by others, none measured against its own proportions.

#include <gtest/gtest.h>

#include "core/anatomy/point_lookup.h"
#include "core/propose/quick_set.h"
#include "tests/bench/propose/proposal_study.h"
#include "tests/oracle/real_heads.h"
#include "tests/support/sample_head_model.h"

namespace semblante::bench {
namespace {

TEST(RealHeadProposals, FromTheQuickSetAreWithinTheirBounds) {
  const auto faces = oracle::faces_folder();
  if (!faces) GTEST_SKIP() << "no folder of real heads";
  std::vector<ProposalError> all;
  for (const ProposalStudy& study : read_proposal_studies(*faces)) {
    const auto errors = errors_from(study, {quick_set.begin(), quick_set.end()});
    EXPECT_GE(errors.size(), 40U) << study.name;
    EXPECT_LE(share_within(errors, 0.5), 0.05) << study.name;
    EXPECT_LE(share_within(errors, 0.9), 0.15) << study.name;
    EXPECT_LE(share_within(errors, 1.0), 0.5) << study.name;
    all.insert(all.end(), errors.begin(), errors.end());
  }
  EXPECT_LE(share_within(all, 0.5), 0.05);
  EXPECT_LE(share_within(all, 0.9), 0.15);
}

TEST(RealHeadProposals, NineInTenAreWithinTheRadiusTheyClaim) {
  std::vector<ProposalStudy> heads = make_sample_studies();
  if (const auto faces = oracle::faces_folder()) {
    for (ProposalStudy& study : read_proposal_studies(*faces)) heads.push_back(std::move(study));
  }
  std::vector<ProposalError> all;
  for (const ProposalStudy& study : heads) {
    const auto errors = errors_from(study, {quick_set.begin(), quick_set.end()});
    // The scan of our own head is marked on one skin that shows neither lids nor hair.
    const double least = study.family != "sample-head" ? 0.9 : study.name == "scan" ? 0.7 : 0.9;
    EXPECT_GE(share_within_claim(errors), least) << study.name;
    // The variants of our own head are not independent: one of them stands for all.
    if (study.family != "sample-head" || study.name == "sample") all.insert(all.end(), errors.begin(), errors.end());
  }
  EXPECT_GE(share_within_claim(all), 0.9);
}

/// The factor of all claims from the other families alone: the greatest that one of them asks for.
TEST(RealHeadProposals, NineInTenAreWithinTheirClaimsByTheFactorOfOtherFamilies) {
  const auto faces = oracle::faces_folder();
  if (!faces) GTEST_SKIP() << "no folder of real heads";
  std::vector<ProposalStudy> heads = make_sample_studies();
  for (ProposalStudy& study : read_proposal_studies(*faces)) heads.push_back(std::move(study));
  std::map<std::string, std::vector<ProposalError>> of_families;
  for (const ProposalStudy& study : heads) {
    std::vector<ProposalError>& errors = of_families[study.family];
    const auto add = [&](const std::vector<std::string_view>& names) {
      const auto more = errors_from(study, names);
      errors.insert(errors.end(), more.begin(), more.end());
    };
    add({quick_set.begin(), quick_set.end()});
    std::mt19937 random(3);
    for (int draw = 0; draw < 6; ++draw) add(random_names(study, 15 + random() % 26, random));
  }
  for (const auto& [left_out, errors] : of_families) {
    double factor = 0.0;
    for (const auto& [family, others] : of_families) {
      if (family != left_out) factor = std::max(factor, factor_for_nine_in_ten(others));
    }
    std::vector<ProposalError> claims = errors;
    for (ProposalError& e : claims) e.claimed *= factor;
    // Our own heads' proportions are no person's.
    EXPECT_GE(share_within_claim(claims), left_out == "sample-head" ? 0.8 : 0.9) << left_out << ", factor " << factor;
  }
}

TEST(RealHeadProposals, FromRandomSetsAreNeverAbsurdUnlessTheySaySo) {
  const auto faces = oracle::faces_folder();
  if (!faces) GTEST_SKIP() << "no folder of real heads";
  for (const ProposalStudy& study : read_proposal_studies(*faces)) {
    std::mt19937 random(2);
    for (int draw = 0; draw < 30; ++draw) {
      for (const ProposalError& e : errors_from(study, random_names(study, 15 + random() % 26, random))) {
        if (e.confidence == Confidence::low) continue;
        EXPECT_LT(e.error, e.confidence == Confidence::high ? 0.25 : 0.5) << study.name << " " << to_string(e.id);
      }
    }
  }
}

/// Persons of our own, with open and closed eyes, held against the proportions of others.
std::vector<ProposalStudy> family_studies() {
  std::vector<ProposalStudy> studies;
  for (const testing::FamilyMember& member : testing::sample_family()) {
    if (member.traits.form != SampleHeadForm::bust || member.traits.pressed_lips) continue;
    ProposalStudy study;
    study.name = member.name;
    study.model = testing::sample_head_model(member.traits);
    study.surface = build_surface(study.model);
    study.placed = testing::sample_head_points(member.traits);
    for (const FeaturePoint& point : study.placed) study.placed_confidence[point.id.value()] = Confidence::high;
    study.eye_separation = find_point(study.placed, "3.5")->position.x - find_point(study.placed, "3.6")->position.x;
    for (const ReferenceHead& head : reference_heads()) {
      if (head.name != "sample-head") study.other_heads.push_back(head);
    }
    studies.push_back(std::move(study));
  }
  return studies;
}

TEST(FamilyProposals, FromTheQuickSetAreWithinTheirBounds) {
  for (const ProposalStudy& study : family_studies()) {
    const auto errors = errors_from(study, {quick_set.begin(), quick_set.end()});
    EXPECT_GE(errors.size(), 40U) << study.name;
    EXPECT_LE(share_within(errors, 0.5), 0.05) << study.name;
    EXPECT_LE(share_within(errors, 0.9), 0.22) << study.name;
    EXPECT_LE(share_within(errors, 1.0), 0.55) << study.name;
  }
}

// The lids' roots, 3.13 and 3.14, are behind the fold of these heads, where no other head has them.
TEST(FamilyProposals, FromRandomSetsAreHardlyEverAbsurdUnlessTheySaySo) {
  for (const ProposalStudy& study : family_studies()) {
    std::mt19937 random(2);
    int sure = 0;
    int absurd = 0;
    for (int draw = 0; draw < 15; ++draw) {
      for (const ProposalError& e : errors_from(study, random_names(study, 15 + random() % 26, random))) {
        if (e.confidence == Confidence::low) continue;
        ++sure;
        absurd += e.error < (e.confidence == Confidence::high ? 0.25 : 0.5) ? 0 : 1;
      }
    }
    EXPECT_GT(sure, 200) << study.name;
    EXPECT_LE(absurd, sure * 3 / 100) << study.name;
  }
}

}  // namespace
}  // namespace semblante::bench
