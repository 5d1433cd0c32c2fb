#pragma once

#include <CLI/CLI.hpp>

namespace semblante {

/// For options that are real numbers: CLI::Range without NaN, which no comparison finds outside of a range.
CLI::Validator real_range(double least, double most);

}  // namespace semblante
