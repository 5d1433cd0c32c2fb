#pragma once

#include <string>
#include <string_view>

#include "server/store/records.h"

namespace semblante::store {

/// The lists of a model that are always read completely (box, parts, warnings, findings) as one JSON text.
std::string write_facts(const ModelRecord& model);
/// The reverse, into `model`. A text of another form (never written by the server) leaves the lists empty.
void read_facts(std::string_view json, ModelRecord& model);

std::string write_proposal(const ProposalRecord& proposal);
/// The reverse; a text of another form gives a proposal whose members are all unknown.
ProposalRecord read_proposal(std::string_view json);

/// The same for the levels of a package, which have their own column.
std::string write_levels(const std::vector<LevelRecord>& levels);
std::vector<LevelRecord> read_levels(std::string_view json);

}  // namespace semblante::store
