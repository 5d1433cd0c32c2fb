#pragma once

#include <ostream>
#include <span>
#include <string>

#include "core/types/feature_points.h"
#include "core/types/model.h"
#include "deploy/sample_head/sample_head.h"

namespace semblante::testing {

/// Heads of our own for tests that want several: variants of the sample head by traits of its generator.
struct FamilyMember {
  const char* name;
  SampleHeadTraits traits;

  friend std::ostream& operator<<(std::ostream& out, const FamilyMember& member) { return out << member.name; }
};

/// The sample head itself, two other persons, the sample head with pressed lips and with closed eyes, its body, and a
/// scan of it.
std::span<const FamilyMember> sample_family();

/// Its name as the suffix of a test: `INSTANTIATE_TEST_SUITE_P(..., member_name)`.
inline constexpr auto member_name = [](const auto& info) {
  std::string name = info.param.name;
  std::erase(name, ' ');
  return name;
};

/// A head of ours as import would give it, without materials.
Model sample_head_model(const SampleHeadTraits& traits = {});

/// All 84 points of it.
FeaturePointSet sample_head_points(const SampleHeadTraits& traits = {});

}  // namespace semblante::testing
