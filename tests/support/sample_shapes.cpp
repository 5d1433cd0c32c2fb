#include "tests/support/sample_shapes.h"

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/bridges/arkit.h"
#include "core/bridges/oculus.h"
#include "core/expressions/kernel_rig.h"
#include "core/parametrize/parametrize.h"
#include "deploy/sample_head/write_sample_head.h"
#include "tests/support/sample_head_model.h"

namespace semblante::testing {
namespace {

constexpr std::string_view arkit_shapes[] = {
    "jawOpen",         "jawLeft",      "eyeBlinkLeft",  "eyeBlinkRight",      "eyeWideLeft",         "eyeWideRight",
    "browInnerUp",     "browDownLeft", "browDownRight", "mouthSmileLeft",     "mouthSmileRight",     "mouthFrownLeft",
    "mouthFrownRight", "mouthPucker",  "mouthFunnel",   "mouthLowerDownLeft", "mouthLowerDownRight", "noseSneerLeft",
    "noseSneerRight"};

/// A head with weights, posed by frames.
class Shaper {
 public:
  explicit Shaper(const SampleHeadTraits& traits) : model_(sample_head_model(traits)) {
    const Surface surface = build_surface(model_);
    ParametrizeOptions options;
    options.weights = WeightMethod::smooth;
    auto rig = parametrize(model_, surface, sample_head_points(traits), options);
    if (!rig) throw std::runtime_error(rig.error().message);
    rig_ = *std::move(rig);
  }
  [[nodiscard]] SampleHeadTarget target(std::string name, const semblante_frame& frame) const {
    const KernelRig kernel = make_kernel_rig(rig_);
    const semblante_rig view = kernel.view();
    semblante_pose pose;
    semblante_evaluate(&view, &frame, &pose);
    const semblante_face face = make_kernel_face(rig_, &model_.positions[0].x);
    SampleHeadTarget target{std::move(name), std::vector<glm::vec3>(model_.positions.size())};
    semblante_deform(&face, &pose, &target.displacements[0].x);
    for (std::size_t v = 0; v < model_.positions.size(); ++v) target.displacements[v] -= model_.positions[v];
    return target;
  }

 private:
  Model model_;
  Rig rig_;
};

SampleHead make_avatar() {
  constexpr SampleHeadTraits traits{.form = SampleHeadForm::body};
  SampleHead head = make_sample_head(traits);
  const Shaper shaper(traits);
  for (std::size_t viseme = 1; viseme < oculus_count; ++viseme) {
    OculusWeights weights{};
    weights[viseme] = 1.0F;
    head.targets.push_back(
        shaper.target("viseme_" + std::string(oculus_name(viseme)), frame_from_oculus(weights).value().frame));
  }
  for (const std::string_view name : arkit_shapes) {
    ArkitCoefficients coefficients{};
    coefficients.at(find_arkit(name).value()) = 1.0F;
    head.targets.push_back(shaper.target(std::string(name), frame_from_arkit(coefficients).value().frame));
  }
  return head;
}

}  // namespace

const SampleHead& sample_avatar() {
  static const SampleHead avatar = make_avatar();
  return avatar;
}

const std::vector<std::uint8_t>& sample_avatar_glb() {
  static const std::vector<std::uint8_t> bytes = sample_head_glb(sample_avatar()).value();
  return bytes;
}

}  // namespace semblante::testing
