#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/doctor/examine.h"
#include "core/types/feature_points.h"
#include "core/types/model.h"
#include "tests/support/sample_head_model.h"

namespace semblante::testing {

/// A head to examine, or to spoil first.
struct Head {
  std::string name;
  Model model;
  FeaturePointSet points;
};

/// Our own head or one of its family, always there.
Head sample_head(const SampleHeadTraits& traits = {});
/// "ict-facekit", "ict-facekit identity", "makehuman", "makehuman glb", "mediapipe-canonical"; empty where the folder
/// of real heads is not there.
std::optional<Head> real_head(std::string_view name);
/// Either of these by name: our own have those of sample_family().
std::optional<Head> head_named(std::string_view name);

/// The report on a head with all its weights.
Report examine_with_weights(const Head& head, WeightMethod method);
/// The same without the checks of weights, which are most of the time.
Report examine_without_weights(const Head& head);

}  // namespace semblante::testing
