#pragma once

#include <string>

namespace semblante::test {

/// A flat patch of `side` by `side` vertices as OBJ, 1 apart, centred on x = 0: vertex row * side + column.
inline std::string grid_obj(int side) {
  std::string text = "# grid\n";
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column)
      text += "v " + std::to_string(column - side / 2) + " " + std::to_string(row) + " 0\n";
  for (int row = 0; row + 1 < side; ++row)
    for (int column = 0; column + 1 < side; ++column) {
      const int a = row * side + column + 1;
      const auto corner = [](int index) { return " " + std::to_string(index); };
      text += "f" + corner(a) + corner(a + 1) + corner(a + side + 1) + corner(a + side) + "\n";
    }
  return text;
}

}  // namespace semblante::test
