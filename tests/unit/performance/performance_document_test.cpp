#include "protocol/cpp/performance_document.h"

#include <gtest/gtest.h>

#include "core/performance/performance.h"

namespace semblante {
namespace {

std::string document(const std::string& cues, const std::string& more = "") {
  return R"({"format":"semblante.performance","version":1,)" + more + R"("cues":[)" + cues + "]}";
}

Error refused_document(const std::string& text) {
  auto script = read_performance(text);
  if (!script) return script.error();
  const auto made = Performance::compile(*script);
  EXPECT_FALSE(made) << text;
  return made ? Error{} : made.error();
}

TEST(PerformanceDocument, EveryTarget_IsRead) {
  const auto script = read_performance(document(
      R"({"time":0,"duration":500,"fap":"open_jaw","value":200,"attack":50,"release":60,"easing":[0.1,0.2,0.3,1.4]},
         {"time":0,"duration":500,"fap":48,"keys":[[0,1],[10,2]],"easing":"linear"},
         {"time":0,"duration":100,"viseme":"a"}, {"time":0,"duration":100,"viseme":["e",10],"value":0.5},
         {"time":0,"duration":100,"expression":"joy","value":0.8,"note":"brightly"},
         {"time":0,"duration":100,"look_at":{"yaw":10,"pitch":-5,"head_share":0.4}},
         {"time":0,"duration":100,"look_at":{"point":[0,-3,4]}},
         {"time":0,"blink":"right"}, {"time":5.5,"duration":100,"head":{"roll":4}})",
      R"("name":"All","duration":900,"idle":{"seed":9,"head":0},)"));
  ASSERT_TRUE(script) << script.error().where << " " << script.error().message;
  EXPECT_EQ(script->name, "All");
  EXPECT_EQ(script->duration, 900.0);
  EXPECT_EQ(script->idle, (IdleLife{9, 15.0, 0.0, 0.5}));
  ASSERT_EQ(script->cues.size(), 9U);
  EXPECT_EQ(std::get<FapTarget>(script->cues[0].target).fap, 3);
  EXPECT_EQ(script->cues[0].easing, (Easing{EasingKind::bezier, 0.1, 0.2, 0.3, 1.4}));
  EXPECT_EQ(script->cues[1].keys, (std::vector<CueKey>{{0, 1}, {10, 2}}));
  EXPECT_EQ(std::get<VisemeTarget>(script->cues[3].target).viseme, 11);
  EXPECT_EQ(std::get<VisemeTarget>(script->cues[3].target).other, 10);
  EXPECT_EQ(std::get<ExpressionTarget>(script->cues[4].target).expression, 1);
  const auto look = std::get<LookTarget>(script->cues[6].target);
  EXPECT_NEAR(look.pitch, 36.8699, 1e-4);
  EXPECT_NEAR(look.distance, 5.0, 1e-12);
  EXPECT_FALSE(std::get<BlinkTarget>(script->cues[7].target).left);
  EXPECT_EQ(script->cues[8].time, 5.5);
  EXPECT_TRUE(Performance::compile(*script));
}

TEST(PerformanceDocument, Written_ReadsBackTheSame) {
  const auto script = read_performance(document(
      R"({"time":0,"duration":500,"fap":3,"value":200,"attack":50,"easing":[0.1,0.2,0.3,1.4]},
         {"time":0.125,"fap":48,"keys":[[0,1.5],[10,2]],"easing":"linear"},
         {"time":1,"duration":100,"viseme":["e","a"],"value":0.5},{"time":1,"duration":100,"expression":3},
         {"time":2,"duration":100,"look_at":{"yaw":10,"pitch":-5,"distance":4,"head_share":0.4}},
         {"time":3,"blink":"both","value":0.5},{"time":3,"duration":10,"head":{"yaw":-1.25}})",
      R"("name":"x \"y\"","idle":{"seed":4294967295},)"));
  ASSERT_TRUE(script) << script.error().where << " " << script.error().message;
  const std::string once = write_performance(*script);
  const auto again = read_performance(once);
  ASSERT_TRUE(again) << once << again.error().where << " " << again.error().message;
  EXPECT_EQ(write_performance(*again), once);
  const auto a = Performance::compile(*script);
  const auto b = Performance::compile(*again);
  ASSERT_TRUE(a && b);
  for (double t = 0.0; t < 600.0; t += 7.0) {
    const auto fa = a->frame_at(t);
    const auto fb = b->frame_at(t);
    EXPECT_EQ(std::vector<float>(fa.fap, fa.fap + 69), std::vector<float>(fb.fap, fb.fap + 69)) << t;
    EXPECT_EQ(fa.viseme1, fb.viseme1);
    EXPECT_EQ(fa.intensity1, fb.intensity1);
  }
}

TEST(PerformanceDocument, WhatIsWrong_IsNamedWithItsPlace) {
  const auto where = [](const std::string& cue) { return refused_document(document(cue)).where; };
  EXPECT_EQ(where(R"({"duration":1,"fap":3,"value":1})"), "/cues/0/time");
  EXPECT_EQ(where(R"({"time":0,"fap":3,"value":1})"), "/cues/0/duration");
  EXPECT_EQ(where(R"({"time":0,"duration":1,"fap":3})"), "/cues/0");
  EXPECT_EQ(where(R"({"time":0,"duration":1,"fap":"open_yaw","value":1})"), "/cues/0/fap");
  EXPECT_EQ(where(R"({"time":0,"duration":1,"fap":"viseme","value":1})"), "/cues/0/fap");
  EXPECT_EQ(where(R"({"time":0,"duration":1,"fap":1,"value":1})"), "/cues/0/fap");
  EXPECT_EQ(where(R"({"time":0,"duration":1,"viseme":15})"), "/cues/0/viseme");
  EXPECT_EQ(where(R"({"time":0,"duration":1,"viseme":["a"]})"), "/cues/0/viseme");
  EXPECT_EQ(where(R"({"time":0,"duration":1,"expression":"none"})"), "/cues/0/expression");
  EXPECT_EQ(where(R"({"time":0,"duration":1,"expression":"joy","viseme":"a"})"), "/cues/0/expression");
  EXPECT_EQ(where(R"({"time":0,"duration":1})"), "/cues/0");
  EXPECT_EQ(where(R"({"time":0,"duration":1,"blink":"upper"})"), "/cues/0/blink");
  EXPECT_EQ(where(R"({"time":0,"duration":1,"head":{"jaw":1}})"), "/cues/0/head/jaw");
  EXPECT_EQ(where(R"({"time":0,"duration":1,"look_at":{"point":[0,0,-1]}})"), "/cues/0/look_at/point/2");
  EXPECT_EQ(where(R"({"time":0,"duration":1,"look_at":{"point":[0,0,5],"yaw":1}})"), "/cues/0/look_at/yaw");
  EXPECT_EQ(where(R"({"time":0,"duration":1,"fap":3,"value":1,"esing":"linear"})"), "/cues/0/esing");
  EXPECT_EQ(where(R"({"time":0,"duration":1,"fap":3,"value":1,"easing":"bounce"})"), "/cues/0/easing");
  EXPECT_EQ(where(R"({"time":0,"duration":1,"fap":3,"value":1,"easing":[2,0,1,1]})"), "/cues/0/easing/0");
  EXPECT_EQ(where(R"({"time":0,"duration":1,"fap":3,"value":1,"keys":[[0,1]]})"), "/cues/0/value");
  EXPECT_EQ(where(R"({"time":0,"duration":1,"fap":3,"value":1,"time":2})"), "/cues/0/time");
  EXPECT_EQ(where(R"({"time":0,"duration":1,"fap":3,"value":1},{"time":-1,"duration":1,"fap":3,"value":1})"),
            "/cues/1/time");
  EXPECT_EQ(refused_document(document(R"({"time":1e999,"duration":1,"fap":3,"value":1})")).code, ErrorCode::not_finite);
  EXPECT_EQ(refused_document(document(R"({"time":NaN,"duration":1,"fap":3,"value":1})")).code, ErrorCode::malformed);
  EXPECT_EQ(refused_document(document("", R"("duraton":1,)")).where, "/duraton");
  EXPECT_EQ(refused_document(document("", R"("idle":{"seed":-1},)")).where, "/idle/seed");
  EXPECT_EQ(refused_document(document("", R"("idle":{"blinks_per_minute":400},)")).where, "/idle/blinks_per_minute");
  EXPECT_EQ(refused_document(document("", R"("idle":{},"idle":{},)")).where, "/idle");
  EXPECT_EQ(refused_document(R"({"version":1,"cues":[]})").where, "/format");
  EXPECT_EQ(refused_document(R"({"format":"semblante.performance","version":2,"cues":[]})").where, "/version");
  EXPECT_EQ(refused_document(R"({"format":"semblante.performance","version":1})").where, "/cues");
  EXPECT_EQ(refused_document(R"({"format":"semblante.performance","version":1,"cues":7})").where, "/cues");
  EXPECT_EQ(refused_document("[]").code, ErrorCode::malformed);
  EXPECT_EQ(refused_document("7").code, ErrorCode::malformed);
  EXPECT_EQ(refused_document("").code, ErrorCode::malformed);
}

TEST(PerformanceDocument, TenMillionCues_AreRefusedBeforeTheyAreRead) {
  std::string text = R"({"format":"semblante.performance","version":1,"cues":[)";
  const std::string one = R"({"time":0,"blink":"both"},)";
  for (int i = 0; i < 10'000'000; ++i) text += one;
  text += R"({"time":0,"blink":"both"}]})";
  const auto error = refused_document(text);
  EXPECT_EQ(error.code, ErrorCode::too_large);
  // As many as fit into the bytes are more cues than there may be, too.
  text.resize(max_performance_bytes);
  const auto second = refused_document(text);
  EXPECT_EQ(second.code, ErrorCode::too_large);
  EXPECT_EQ(second.where, "/cues");
}

TEST(PerformanceDocument, WhatIsNoDocument_TakesNoMemory) {
  std::string lists;
  for (int i = 0; i < 4'000'001; ++i) lists += i == 0 ? "[]" : ",[]";
  const auto empty_keys = refused_document(document(R"({"time":0,"fap":3,"keys":[)" + lists + "]}"));
  EXPECT_TRUE(empty_keys.where.starts_with("/cues/0/keys/")) << empty_keys.where;
  EXPECT_EQ(empty_keys.code, ErrorCode::too_large);
  std::string members;
  for (int i = 0; i < 65; ++i) members += "\"m" + std::to_string(i) + "\":0,";
  EXPECT_EQ(refused_document(document("", members)).where, "/m0");
  EXPECT_EQ(refused_document(document("", R"("idle":{"a/b":1,"a/b":2},)")).where, "/idle/a~1b");
}

TEST(PerformanceDocument, Nesting_IsBounded) {
  EXPECT_EQ(refused_document(document(std::string(100'000, '['))).code, ErrorCode::too_large);
  EXPECT_EQ(refused_document(R"({"idle":)" + std::string(100'000, '[')).code, ErrorCode::too_large);
}

}  // namespace
}  // namespace semblante
