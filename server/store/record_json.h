#pragma once

#include <nlohmann/json_fwd.hpp>

#include "server/store/records.h"

namespace semblante::store {

// The store and the worker processes use the same JSON for the facts of a model. nlohmann::json finds these pairs by
// itself, also for vectors; the readers throw nlohmann::json::exception on another form.

void to_json(nlohmann::json& json, const PartRecord& part);
void from_json(const nlohmann::json& json, PartRecord& part);

void to_json(nlohmann::json& json, const MorphTargetRecord& target);
void from_json(const nlohmann::json& json, MorphTargetRecord& target);
void to_json(nlohmann::json& json, const FindingCounts& counts);
void from_json(const nlohmann::json& json, FindingCounts& counts);

void to_json(nlohmann::json& json, const ProposalRecord& proposal);
void from_json(const nlohmann::json& json, ProposalRecord& proposal);

void to_json(nlohmann::json& json, const FeaturePointRecord& point);
void from_json(const nlohmann::json& json, FeaturePointRecord& point);

void to_json(nlohmann::json& json, const LevelRecord& level);
void from_json(const nlohmann::json& json, LevelRecord& level);

}  // namespace semblante::store
