#include <cmath>

#include <nlohmann/json.hpp>

#include "core/tables/mpeg4.h"
#include "protocol/cpp/json_number.h"
#include "protocol/cpp/performance_document.h"

namespace semblante {
namespace {

using json = nlohmann::ordered_json;

json easing_of(const Easing& easing) {
  static constexpr auto names = std::to_array<const char*>({"linear", "ease_in", "ease_out", "ease_in_out", "step"});
  if (easing.kind == EasingKind::bezier) return json{easing.x1, easing.y1, easing.x2, easing.y2};
  return names[static_cast<std::size_t>(easing.kind)];
}

struct TargetWriter {
  json& out;
  void operator()(const FapTarget& t) const { out["fap"] = std::string(mpeg4::fap(t.fap).name); }
  void operator()(const VisemeTarget& t) const {
    if (t.other == 0) {
      out["viseme"] = std::string(mpeg4::visemes[t.viseme].name);
    } else {
      out["viseme"] = {std::string(mpeg4::visemes[t.viseme].name), std::string(mpeg4::visemes[t.other].name)};
    }
  }
  void operator()(const ExpressionTarget& t) const {
    out["expression"] = std::string(mpeg4::expressions[t.expression].name);
  }
  void operator()(const LookTarget& t) const {
    json look = {{"yaw", json_number<json>(t.yaw)}, {"pitch", json_number<json>(t.pitch)}};
    if (std::isfinite(t.distance)) look["distance"] = json_number<json>(t.distance);
    if (t.head_share != LookTarget{}.head_share) look["head_share"] = json_number<json>(t.head_share);
    out["look_at"] = std::move(look);
  }
  void operator()(const BlinkTarget& t) const { out["blink"] = t.left && t.right ? "both" : t.left ? "left" : "right"; }
  void operator()(const HeadTarget& t) const {
    out["head"] = {
        {"pitch", json_number<json>(t.pitch)}, {"yaw", json_number<json>(t.yaw)}, {"roll", json_number<json>(t.roll)}};
  }
};

json cue_of(const Cue& cue) {
  json out = {{"time", json_number<json>(cue.time)}};
  if (cue.duration) out["duration"] = json_number<json>(*cue.duration);
  std::visit(TargetWriter{out}, cue.target);
  if (!cue.keys.empty()) {
    json& keys = out["keys"] = json::array();
    for (const CueKey& key : cue.keys) keys.push_back({json_number<json>(key.time), json_number<json>(key.value)});
  } else if (std::holds_alternative<FapTarget>(cue.target) ||
             (cue.value != 1.0 && !std::holds_alternative<LookTarget>(cue.target) &&
              !std::holds_alternative<HeadTarget>(cue.target))) {
    out["value"] = json_number<json>(cue.value);
  }
  if (cue.attack) out["attack"] = json_number<json>(*cue.attack);
  if (cue.release) out["release"] = json_number<json>(*cue.release);
  if (!(cue.easing == Easing{})) out["easing"] = easing_of(cue.easing);
  return out;
}

}  // namespace

std::string write_performance(const PerformanceScript& script) {
  json head = {{"format", std::string(performance_format)}, {"version", performance_version}};
  if (!script.name.empty()) head["name"] = script.name;
  if (script.duration) head["duration"] = json_number<json>(*script.duration);
  if (script.idle) {
    head["idle"] = {{"seed", script.idle->seed},
                    {"blinks_per_minute", json_number<json>(script.idle->blinks_per_minute)},
                    {"head", json_number<json>(script.idle->head)},
                    {"eyes", json_number<json>(script.idle->eyes)}};
  }
  std::string text = head.dump();
  text.back() = ',';  // replaces the closing brace: the cues follow, one per line
  text += "\n \"cues\": [";
  for (std::size_t i = 0; i < script.cues.size(); ++i) {
    text += i == 0 ? "\n  " : ",\n  ";
    text += cue_of(script.cues[i]).dump();
  }
  return text + "\n ]}\n";
}

}  // namespace semblante
