#pragma once

#include <string>
#include <string_view>

#include "server/store/records.h"

namespace semblante::store {

/// The lists of a model that are always read whole (box, parts, warnings, findings) as one JSON text.
std::string write_facts(const ModelRecord& model);
/// The reverse, into `model`. A text that is not of this form (never written by us) leaves the lists empty.
void read_facts(std::string_view json, ModelRecord& model);

std::string write_proposal(const ProposalRecord& proposal);
/// The reverse; a text that is not of this form gives a proposal of which nothing is known.
ProposalRecord read_proposal(std::string_view json);

/// A list of its own column, likewise: the levels of a package.
std::string write_levels(const std::vector<LevelRecord>& levels);
std::vector<LevelRecord> read_levels(std::string_view json);

}  // namespace semblante::store
