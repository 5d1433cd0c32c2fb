#include "clients/gateways/vmc/sender.h"

#include "clients/gateways/osc/bundle_writer.h"
#include "clients/gateways/vmc/turn.h"
#include "clients/gateways/vmc/values.h"

namespace semblante::vmc {
namespace {

void add_bone(osc::BundleWriter& writer, std::string_view name, const glm::dquat& rotation) {
  const glm::dquat unity = mirror_x(rotation);
  writer.add("/VMC/Ext/Bone/Pos", {name, 0.0F, 0.0F, 0.0F, static_cast<float>(unity.x), static_cast<float>(unity.y),
                                   static_cast<float>(unity.z), static_cast<float>(unity.w)});
}

}  // namespace

std::vector<std::vector<std::uint8_t>> packets_of(const semblante_frame& frame, double seconds,
                                                  const SenderOptions& options) {
  const bool presets = options.vrm0 || options.vrm1;
  const Values values = values_from_face(frame, presets, options.bones);
  osc::BundleWriter writer(max_sent_bytes);
  writer.add("/VMC/Ext/OK", {std::int32_t{1}});
  writer.add("/VMC/Ext/T", {static_cast<float>(seconds)});
  if (options.bones) {
    add_bone(writer, "Neck", values.neck);
    add_bone(writer, "Head", values.head);
    add_bone(writer, "LeftEye", values.eyes[0]);
    add_bone(writer, "RightEye", values.eyes[1]);
  }
  const auto add_blend = [&writer](std::string_view name, float value) {
    writer.add("/VMC/Ext/Blend/Val", {name, value});
  };
  for (std::size_t shape = 0; options.perfect_sync && shape < arkit_count; ++shape) {
    add_blend(arkit_name(shape), values.perfect_sync[shape]);
  }
  for (std::size_t i = 0; i < values.presets.size(); ++i) {
    if (options.vrm0) add_blend(vrm_presets()[i].vrm0, values.presets[i]);
    if (options.vrm1) add_blend(vrm_presets()[i].vrm1, values.presets[i]);
  }
  writer.add("/VMC/Ext/Blend/Apply", {});
  return writer.finish();
}

}  // namespace semblante::vmc
