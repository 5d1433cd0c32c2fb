#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "core/doctor/finding.h"
#include "core/doctor/subject.h"

namespace semblante {

/// A slit in the face whose rims move apart: the mouth, an eye.
struct Opening {
  std::string_view name;                    ///< "lips", "left lids"
  std::span<const std::string_view> upper;  ///< points on the upper rim; the same place of `lower` is opposite
  std::span<const std::string_view> lower;  ///< points on the lower rim
  std::span<const std::string_view> corners;
  std::span<const std::string_view> upper_flesh;  ///< all points that belong to the upper lip or lid alone
  std::span<const std::string_view> lower_flesh;
  bool is_mouth;
};
std::span<const Opening> openings();

/// Rims that the surface joins across the slit: fused, or bridged by a membrane.
std::vector<Finding> find_joined_rims(const Subject& head);

/// A face that is not neutral: the mouth stands open, the eyes are not open.
std::vector<Finding> find_rims_not_neutral(const Subject& head);

/// Points of one lip or lid that move vertices of the other, by the weights as they are.
std::vector<Finding> find_leaks(const Subject& head);

/// Too few or too many vertices around mouth and eyes.
std::vector<Finding> find_wrong_density(const Subject& head);

}  // namespace semblante
