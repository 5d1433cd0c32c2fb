#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "core/extract/named_set.h"

namespace semblante {

/// A viseme of FAP 1 or an expression of FAP 2, by number; never 0.
struct NamedFace {
  SetKind kind = SetKind::viseme;
  std::size_t number = 0;

  bool operator==(const NamedFace&) const = default;
};

/// What a shape of this name shows, as avatars spell it: "viseme_PP", "vrc.v_ch", "Fcl_MTH_A", "Fcl_ALL_Joy", "happy",
/// "surprise". Empty for any other name, also for parts of a face ("Fcl_EYE_Joy", "mouthSmile").
std::optional<NamedFace> face_of_shape_name(std::string_view name);

/// The ARKit shape of this name: ARKit's and Live Link's spelling, and sides written _L and _R.
std::optional<std::size_t> arkit_of_shape_name(std::string_view name);

}  // namespace semblante
