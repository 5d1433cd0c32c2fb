#include "server/store/facts_json.h"

#include <utility>

#include <nlohmann/json.hpp>

#include "core/json/read_json.h"
#include "server/store/frame_json.h"
#include "server/store/record_json.h"

namespace semblante::store {
namespace {

/// Reads `T` from a text; a default-constructed one when the text has another form.
template <class T>
T read_as(std::string_view text) {
  const auto document = read_json(text);
  if (!document) return {};
  try {
    return document->get<T>();
  } catch (const nlohmann::json::exception&) {
    return {};
  }
}

/// Older stores kept every part, in order and without an index.
std::vector<PartRecord> parts_from(const nlohmann::json& json) {
  auto parts = json.get<std::vector<PartRecord>>();
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (!json[i].contains("index")) parts[i].index = static_cast<std::uint32_t>(i);
  return largest_parts(std::move(parts), max_part_records);
}

}  // namespace

std::string write_facts(const ModelRecord& model) {
  nlohmann::json json;
  json["min"] = model.box_min;
  json["max"] = model.box_max;
  json["warnings"] = model.warnings;
  json["part_count"] = model.part_count;
  json["parts"] = model.parts;
  if (model.findings) json["findings"] = *model.findings;
  if (model.frame) json["frame"] = frame_to_json(*model.frame, model.frame_wish);
  if (model.frame_wish != FrameWish{}) json["frame_wish"] = wish_to_json(model.frame_wish);
  json["morph_targets"] = model.morph_targets;
  if (!model.fapu.empty()) json["fapu"] = model.fapu;
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void read_facts(std::string_view text, ModelRecord& model) {
  const nlohmann::json json = read_as<nlohmann::json>(text);
  try {
    model.box_min = json.at("min");
    model.box_max = json.at("max");
    model.warnings = json.at("warnings").get<std::vector<std::string>>();
    model.findings.reset();
    // Stores from before the doctor existed have no findings.
    if (json.contains("findings")) model.findings = json["findings"].get<FindingCounts>();
    model.parts = parts_from(json.at("parts"));
    model.part_count = json.value("part_count", static_cast<std::uint32_t>(json["parts"].size()));
    if (json.contains("frame")) model.frame = frame_from_json(json["frame"]);  // absent in older stores
    if (json.contains("frame_wish")) model.frame_wish = wish_from_json(json["frame_wish"]);
    if (json.contains("morph_targets")) json["morph_targets"].get_to(model.morph_targets);
    if (json.contains("fapu")) json["fapu"].get_to(model.fapu);
  } catch (const nlohmann::json::exception&) {
    model.parts.clear();
    model.part_count = 0;
    model.findings.reset();
    model.frame.reset();
    model.frame_wish = {};
    model.morph_targets.clear();
    model.fapu.clear();
    model.warnings.clear();
  }
}

std::string write_proposal(const ProposalRecord& proposal) { return nlohmann::json(proposal).dump(); }

ProposalRecord read_proposal(std::string_view text) { return read_as<ProposalRecord>(text); }

std::string write_levels(const std::vector<LevelRecord>& levels) { return nlohmann::json(levels).dump(); }

std::vector<LevelRecord> read_levels(std::string_view text) { return read_as<std::vector<LevelRecord>>(text); }

}  // namespace semblante::store
