#pragma once

#include <string>

#include "core/import/resource_reader.h"

namespace semblante {

/// The other files of the model at `model_path`, from its folder and the folders below it: buffers and images of a
/// glTF, material files and images of an OBJ. A material file may have a path of another machine: if nothing exists
/// there, the file of its name beside the model is used. Paths that lead out of the folder are refused, because a model
/// file of another person must not choose which files of this machine are read.
import::ResourceReader folder_resources(const std::string& model_path);

}  // namespace semblante
