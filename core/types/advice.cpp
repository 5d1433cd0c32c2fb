#include "core/types/advice.h"

#include <algorithm>
#include <array>

namespace semblante {
namespace {

constexpr auto texts = std::to_array<AdviceText>({
    {Advice::export_as_glb, "export-as-glb",
     "open it in the program that made it, or in Blender, and export it as GLB"},
    {Advice::export_again, "export-again", "export the head again"},
    {Advice::unpack, "unpack", "take the model that is in it, or a zip"},
    {Advice::choose_model, "choose-model", "take the file of the model"},
    {Advice::download_model, "download-model", "download the model itself"},
    {Advice::fetch_from_lfs, "fetch-from-lfs", "git lfs pull fetches the model"},
    {Advice::send_all_files, "send-all-files", "take a GLB, or a zip with all files"},
    {Advice::send_one_model, "send-one-model", "leave one model in it"},
    {Advice::reduce_model, "reduce-model", "reduce the mesh or its textures"},
    {Advice::mark_points, "mark-points", "mark the points that are missing"},
    {Advice::move_points, "move-points", "move or remove these points"},
    {Advice::store_again, "store-again", "upload the same file again, or parametrize the model again"},
    {Advice::free_disk, "free-disk", "free some room on the disk, then try again"},
    {Advice::delete_unused, "delete-unused", "delete what is no longer needed"},
    {Advice::wait, "wait", "wait a moment and try again"},
    {Advice::look_again, "look-again", "look at what has changed, then try again"},
    {Advice::sign_in, "sign-in", "sign in with a token that is accepted"},
    {Advice::ask_for_token, "ask-for-token", "ask whoever runs the server for a token that allows it"},
});

constexpr bool is_in_order() {
  for (std::size_t i = 0; i < texts.size(); ++i)
    if (static_cast<std::size_t>(texts[i].advice) != i) return false;
  return texts.size() == static_cast<std::size_t>(Advice::ask_for_token) + 1;
}
static_assert(is_in_order());

}  // namespace

std::span<const AdviceText> all_advice() { return texts; }

const AdviceText& text_of(Advice advice) { return texts[static_cast<std::size_t>(advice)]; }

std::optional<Advice> find_advice(std::string_view name) {
  const auto* found = std::find_if(texts.begin(), texts.end(), [&](const auto& text) { return text.name == name; });
  return found == texts.end() ? std::nullopt : std::optional(found->advice);
}

}  // namespace semblante
