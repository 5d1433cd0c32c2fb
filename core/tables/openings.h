#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace semblante::mpeg4 {

/// A slit in the face whose two rims move apart: the mouth, an eye. All lists hold ids of feature points.
struct Opening {
  std::string_view name;                    ///< "lips", "left lids"
  std::span<const std::string_view> upper;  ///< points on the upper rim; the same place of `lower` is opposite
  std::span<const std::string_view> lower;  ///< points on the lower rim
  std::span<const std::string_view> corners;
  std::span<const std::string_view> outer_corners;  ///< of the outer contour of the lips
  std::span<const std::string_view> upper_flesh;    ///< all points that belong to the upper lip or lid alone
  std::span<const std::string_view> lower_flesh;
  std::span<const std::string_view> above;  ///< points of the face nearby that no path joins to the slit's lower side
  std::span<const std::string_view> below;  ///< except round a corner; nearest to the slit first
  std::string_view upper_name, lower_name;  ///< "upper lip", "lower lip"
  bool is_mouth;
};

namespace opening_points {
using Name = std::string_view;

inline constexpr std::array<Name, 3> lips_upper = {"2.2", "2.6", "2.7"};
inline constexpr std::array<Name, 3> lips_lower = {"2.3", "2.8", "2.9"};
inline constexpr std::array<Name, 2> lips_corners = {"2.4", "2.5"};
inline constexpr std::array<Name, 2> lips_outer_corners = {"8.3", "8.4"};
inline constexpr std::array<Name, 8> upper_lip = {"2.2", "2.6", "2.7", "8.1", "8.5", "8.6", "8.9", "8.10"};
inline constexpr std::array<Name, 6> lower_lip = {"2.3", "2.8", "2.9", "8.2", "8.7", "8.8"};
inline constexpr std::array<Name, 2> above_lips = {"9.15", "9.3"};
inline constexpr std::array<Name, 2> below_lips = {"2.10", "2.1"};

inline constexpr std::array<Name, 1> left_upper = {"3.1"};
inline constexpr std::array<Name, 1> left_lower = {"3.3"};
inline constexpr std::array<Name, 2> left_corners = {"3.7", "3.11"};
inline constexpr std::array<Name, 2> left_upper_lid = {"3.1", "3.13"};
inline constexpr std::array<Name, 2> left_lower_lid = {"3.3", "3.9"};
inline constexpr std::array<Name, 3> above_left_eye = {"4.3", "4.1", "4.5"};
inline constexpr std::array<Name, 2> below_left_eye = {"5.3", "9.1"};

inline constexpr std::array<Name, 1> right_upper = {"3.2"};
inline constexpr std::array<Name, 1> right_lower = {"3.4"};
inline constexpr std::array<Name, 2> right_corners = {"3.8", "3.12"};
inline constexpr std::array<Name, 2> right_upper_lid = {"3.2", "3.14"};
inline constexpr std::array<Name, 2> right_lower_lid = {"3.4", "3.10"};
inline constexpr std::array<Name, 3> above_right_eye = {"4.4", "4.2", "4.6"};
inline constexpr std::array<Name, 2> below_right_eye = {"5.4", "9.2"};
}  // namespace opening_points

inline constexpr std::array<Opening, 3> openings = {{
    {"lips", opening_points::lips_upper, opening_points::lips_lower, opening_points::lips_corners,
     opening_points::lips_outer_corners, opening_points::upper_lip, opening_points::lower_lip,
     opening_points::above_lips, opening_points::below_lips, "upper lip", "lower lip", true},
    {"left lids",
     opening_points::left_upper,
     opening_points::left_lower,
     opening_points::left_corners,
     {},
     opening_points::left_upper_lid,
     opening_points::left_lower_lid,
     opening_points::above_left_eye,
     opening_points::below_left_eye,
     "upper lid",
     "lower lid",
     false},
    {"right lids",
     opening_points::right_upper,
     opening_points::right_lower,
     opening_points::right_corners,
     {},
     opening_points::right_upper_lid,
     opening_points::right_lower_lid,
     opening_points::above_right_eye,
     opening_points::below_right_eye,
     "upper lid",
     "lower lid",
     false},
}};
inline constexpr const Opening& mouth = openings[0];
/// `eye`: 0 the left one, 1 the right one.
constexpr const Opening& lids_of(std::size_t eye) { return openings[1 + eye]; }

}  // namespace semblante::mpeg4
