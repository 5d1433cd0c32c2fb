#pragma once

#include <string>
#include <vector>

#include "core/extract/named_set.h"
#include "core/types/feature_points.h"
#include "core/types/model.h"
#include "core/types/result.h"

namespace semblante {

/// The visemes and expressions of a head that its own shapes (morph targets) show.
struct OwnSets {
  std::vector<NamedSet> sets;      ///< named and ordered as in the library: visemes, then expressions
  std::vector<std::string> words;  ///< what they were taken from, which are missing and why
};

/// Looks for each viseme of FAP 1 and each expression of FAP 2 among the model's shapes (named_shapes.h).
///
/// `points`, `fapu`: of the neutral head. Errors: `missing` at "/expressions" for a model without any of them.
Result<OwnSets> own_sets(const Model& model, const FeaturePointSet& points, const Fapu& fapu);

/// Adds the sets whose names are not among `worn` yet: what a user chose by hand stays.
void wear_own(std::vector<NamedSet>& worn, std::vector<NamedSet> own);

}  // namespace semblante
