#pragma once

#include "core/types/model.h"
#include "tests/unit/import/test_files.h"

namespace semblante::test {

/// An image as every client reads it.
struct ShownPixels {
  int width = 0, height = 0, channels = 0;  ///< channels of the file
  Bytes rgba;
};

/// Empty, with a failure, if it cannot be read.
ShownPixels pixels_of(const Image& image);

}  // namespace semblante::test
