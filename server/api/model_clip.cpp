#include "server/api/model_clip.h"

#include <cstdint>
#include <string_view>
#include <vector>

#include "server/api/common.h"
#include "server/api/mapped_file.h"

namespace semblante::api {

std::string clip_of_model(Context& context, const store::ModelRecord& model, std::size_t level,
                          std::span<const TimedValues> frames, const ClipOptions& options, const std::string& pointer) {
  const auto artefact = [&](const char* name) {
    const auto found = context.store.artefact(model.id, store::artefact_name(level, name));
    if (!found || !model.package) refuse("conflict", "the model is not parametrized: it has no face package", pointer);
    return MappedFile(context.blobs.whole(found->sha256, found->bytes));
  };
  const auto mesh = artefact("mesh.drc");
  const auto weights = artefact("weights");
  const auto rig = artefact("rig.json");
  const auto image = [&](const Sha256& hash) -> Result<std::vector<std::uint8_t>> {
    const MappedFile file(context.blobs.whole(to_hex(hash)));
    return std::vector<std::uint8_t>(file.bytes().begin(), file.bytes().end());
  };
  const auto clip = make_clip({mesh.bytes(), weights.bytes(), rig.text(), image}, frames, options);
  if (!clip) {
    if (clip.error().code == ErrorCode::too_large) refuse("content-too-large", clip.error().message);
    refuse("conflict", "no clip can be made: " + clip.error().message, pointer);
  }
  return {clip->glb.begin(), clip->glb.end()};
}

}  // namespace semblante::api
