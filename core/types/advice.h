#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace semblante {

/// What helps against an error, where that is known.
enum class Advice : std::uint8_t {
  export_as_glb,   ///< no reader has the format, or a part of it: GLB from the program that made the head
  export_again,    ///< the file is damaged, or does not follow its format
  unpack,          ///< the model is in an archive that is not read
  choose_model,    ///< the file is no model
  download_model,  ///< a web page was saved in place of the model
  fetch_from_lfs,  ///< the file stands for one in Git LFS
  send_all_files,  ///< the model has parts in other files
  send_one_model,  ///< there are several models
  reduce_model,    ///< it is too large
  mark_points,     ///< feature points are missing
  move_points,     ///< feature points are in impossible places
  store_again,     ///< what the server stored is damaged: upload or parametrize again
  free_disk,       ///< the disk of the server is full
  delete_unused,   ///< a limit on the number of things is reached
  wait,            ///< the server is busy
  look_again,      ///< the resource has changed
  sign_in,
  ask_for_token,  ///< this token does not allow it
};

/// An advice with its name in problem documents, and its words for command lines: what to do, in the imperative.
struct AdviceText {
  Advice advice;
  std::string_view name, words;
};

/// All of them, in the order of the enumeration.
std::span<const AdviceText> all_advice();

const AdviceText& text_of(Advice advice);
std::optional<Advice> find_advice(std::string_view name);

}  // namespace semblante
