#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace semblante {

/// The length units of the standard, always stored in this order. AU (1e-5 rad) is the same for all faces.
enum class FapuUnit : std::uint8_t { irisd, es, ens, mns, mw };
inline constexpr std::size_t fapu_unit_count = 5;
inline constexpr std::array<std::string_view, fapu_unit_count> fapu_unit_names = {"IRISD", "ES", "ENS", "MNS", "MW"};

/// Where the value of a unit comes from.
enum class FapuOrigin : std::uint8_t {
  points,       ///< measured between the feature points that define it
  closed_eyes,  ///< estimated, because the lids of the neutral face are closed
  user,         ///< given by hand
};

/// FAPUs of a neutral face in model units, ALREADY divided by 1024; empty if the points that define one are missing.
struct Fapu {
  std::array<std::optional<double>, fapu_unit_count> value{};
  std::array<FapuOrigin, fapu_unit_count> origin{};

  [[nodiscard]] std::optional<double> operator[](FapuUnit unit) const { return value[static_cast<std::size_t>(unit)]; }
};

}  // namespace semblante
