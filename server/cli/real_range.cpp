#include "server/cli/real_range.h"

#include <cmath>
#include <cstdlib>
#include <string>

namespace semblante {

CLI::Validator real_range(double least, double most) {
  const CLI::Validator is_number(
      [](const std::string& text) {
        return std::isnan(std::strtod(text.c_str(), nullptr)) ? text + " is no number" : std::string();
      },
      "");
  return CLI::Range(least, most) & is_number;
}

}  // namespace semblante
