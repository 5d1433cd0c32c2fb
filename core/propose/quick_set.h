#pragma once

#include <array>
#include <string_view>

namespace semblante {

/// Twenty points that a person finds surely and that settle most of the rest: the middle, the left side, and one corner
/// on the right that settles how the head stands. README.md says how they were chosen. In the order to mark them.
inline constexpr std::array<std::string_view, 20> quick_set = {
    "9.3",  "9.15", "8.1", "2.2", "2.3",  "8.2",  "2.1", "11.4",  // the middle, from the tip of the nose
    "3.11", "3.7",  "3.1", "3.3", "3.12",                         // the left eye, the outer corner of the right one
    "4.1",  "4.5",  "9.1", "8.3", "2.13", "10.1", "10.5"};        // the left brow, nose, mouth, jaw and ear

}  // namespace semblante
