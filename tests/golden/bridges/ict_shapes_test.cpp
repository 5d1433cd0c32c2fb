// The ARKit bridge against ICT-FaceKit's own shapes of the same names. The table: tests/bench/bridges.

#include "tests/bench/bridges/ict_shapes.h"

#include <map>
#include <string>

#include <gtest/gtest.h>

#include "tests/oracle/real_heads.h"

namespace semblante {
namespace {

struct Bound {
  double error;   ///< at most
  double cosine;  ///< at least
};

// A little over what is reached; 1 would be what doing nothing gives.
const std::map<std::string, Bound> bounds = {
    {"browDown", {0.86, 0.50}},     {"browInnerUp", {0.70, 0.73}}, {"eyeBlink_R", {0.50, 0.86}},
    {"eyeWide", {0.61, 0.81}},      {"jawOpen", {0.74, 0.82}},     {"jawOpen_mouthClose", {0.93, 0.59}},
    {"mouthFrown", {0.57, 0.81}},   {"mouthFunnel", {0.60, 0.80}}, {"mouthLowerDown", {0.45, 0.89}},
    {"mouthPress", {0.76, 0.66}},   {"mouthPucker", {0.58, 0.82}}, {"mouthSmile", {0.70, 0.71}},
    {"mouthSmile_L", {0.70, 0.71}}, {"noseSneer", {0.69, 0.73}},
};

TEST(ArkitBridge_IctShapes, EveryShapeIsMetWithinItsBound) {
  const auto faces = oracle::faces_folder();
  if (!faces) GTEST_SKIP() << "no folder of real heads";
  const bench::IctStudy study(*faces / "ict-facekit");
  ASSERT_EQ(study.shapes.size(), bounds.size());
  for (const bench::IctShape& shape : study.shapes) {
    const semblante_frame frame = frame_from_arkit(shape.coefficients).value().frame;
    const bench::BridgeQuality quality = bench::compare(study, study.displacement_of(frame), shape.displacement);
    EXPECT_LE(quality.error, bounds.at(shape.name).error) << shape.name;
    EXPECT_GE(quality.cosine, bounds.at(shape.name).cosine) << shape.name;
  }
}

// No shape of another name is met clearly better than the one that is meant.
TEST(ArkitBridge_IctShapes, EachIsNearestToItself) {
  const auto faces = oracle::faces_folder();
  if (!faces) GTEST_SKIP() << "no folder of real heads";
  const bench::IctStudy study(*faces / "ict-facekit");
  for (const bench::IctShape& ours : study.shapes) {
    const auto displacement = study.displacement_of(frame_from_arkit(ours.coefficients).value().frame);
    const double own = bench::compare(study, displacement, ours.displacement).cosine;
    for (const bench::IctShape& theirs : study.shapes) {
      const double cosine = bench::compare(study, displacement, theirs.displacement).cosine;
      EXPECT_GT(own, cosine - 0.05) << ours.name << " is as near to " << theirs.name;
    }
  }
}

}  // namespace
}  // namespace semblante
