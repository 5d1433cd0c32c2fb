#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/propose/propose.h"
#include "tests/support/posed_face.h"

namespace semblante::bench {

/// A head with its placed points, to be deformed until its lips and lids touch.
struct ClosableHead {
  Head head;
  std::string proportions;  ///< the reference head it must not be measured against
  bool has_membranes;       ///< lips and lids are joined: which vertex is on which side is a matter of opinion
};

/// Our own head, and where their folder is the real ones, with other people on the mesh of the first.
std::vector<ClosableHead> closable_heads();

/// The same head with lips and lids closed by `share` of their gaps, by FAPs and smooth weights. A share of 0 changes
/// nothing, with 1 the rims touch, with more they pass each other.
Head closed(const Head& head, double share);

/// One side higher than the other, so that mirror images of lips lie on the other lip.
Head lopsided(const Head& head);

/// The head's own expression file (`v` lines alone) in place of its positions.
Head with_positions_of(const Head& head, const std::string& file);

FeaturePointSet some_of(const FeaturePointSet& points, const std::vector<std::string_view>& names);

/// From `known`, by the proportions of other heads.
Proposals propose_on(const ClosableHead& closable, const Head& head, const FeaturePointSet& known);

}  // namespace semblante::bench
