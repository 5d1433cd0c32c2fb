#include <cmath>

#include <nlohmann/json.hpp>

#include "core/tables/mpeg4.h"
#include "protocol/cpp/performance_document.h"

namespace semblante {
namespace {

using json = nlohmann::ordered_json;

json easing_of(const Easing& easing) {
  static constexpr auto names = std::to_array<const char*>({"linear", "ease_in", "ease_out", "ease_in_out", "step"});
  if (easing.kind == EasingKind::bezier) return json{easing.x1, easing.y1, easing.x2, easing.y2};
  return names[static_cast<std::size_t>(easing.kind)];
}

/// Writes integers as 40 instead of 40.0.
json number(double value) {
  if (value == std::floor(value) && std::abs(value) < 1e15) return static_cast<std::int64_t>(value);
  return value;
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
    json look = {{"yaw", number(t.yaw)}, {"pitch", number(t.pitch)}};
    if (std::isfinite(t.distance)) look["distance"] = number(t.distance);
    if (t.head_share != LookTarget{}.head_share) look["head_share"] = number(t.head_share);
    out["look_at"] = std::move(look);
  }
  void operator()(const BlinkTarget& t) const { out["blink"] = t.left && t.right ? "both" : t.left ? "left" : "right"; }
  void operator()(const HeadTarget& t) const {
    out["head"] = {{"pitch", number(t.pitch)}, {"yaw", number(t.yaw)}, {"roll", number(t.roll)}};
  }
};

json cue_of(const Cue& cue) {
  json out = {{"time", number(cue.time)}};
  if (cue.duration) out["duration"] = number(*cue.duration);
  std::visit(TargetWriter{out}, cue.target);
  if (!cue.keys.empty()) {
    json& keys = out["keys"] = json::array();
    for (const CueKey& key : cue.keys) keys.push_back({number(key.time), number(key.value)});
  } else if (std::holds_alternative<FapTarget>(cue.target) ||
             (cue.value != 1.0 && !std::holds_alternative<LookTarget>(cue.target) &&
              !std::holds_alternative<HeadTarget>(cue.target))) {
    out["value"] = number(cue.value);
  }
  if (cue.attack) out["attack"] = number(*cue.attack);
  if (cue.release) out["release"] = number(*cue.release);
  if (!(cue.easing == Easing{})) out["easing"] = easing_of(cue.easing);
  return out;
}

}  // namespace

std::string write_performance(const PerformanceScript& script) {
  json head = {{"format", std::string(performance_format)}, {"version", performance_version}};
  if (!script.name.empty()) head["name"] = script.name;
  if (script.duration) head["duration"] = number(*script.duration);
  if (script.idle) {
    head["idle"] = {{"seed", script.idle->seed},
                    {"blinks_per_minute", number(script.idle->blinks_per_minute)},
                    {"head", number(script.idle->head)},
                    {"eyes", number(script.idle->eyes)}};
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
