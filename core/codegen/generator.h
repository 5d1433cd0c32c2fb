#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

/// Common functions of all generators of source files. Generators run only during development or in a build, so errors
/// are exceptions with a message for developers.
namespace semblante::codegen {

struct GeneratedFile {
  std::string path;  ///< relative to the source folder, or to the output folder if one is given
  std::string text;
};

/// Generates the text of all files of one generator from the data in the source folder; does not write files. Throws
/// std::exception for invalid data.
using Generator = std::vector<GeneratedFile> (*)(const std::string& source_folder);

/// The `main` of a generator. The first argument is the source folder, an optional second one the output folder
/// (default: the source folder). Returns the exit status.
int run_generator(int argc, char** argv, Generator generate);

/// The paths of the committed files whose text differs from that of the generator; empty if all are up to date.
std::vector<std::string> out_of_date(const std::string& source_folder, Generator generate);

/// "ResumePoint" and "resumePoint" -> "resume_point".
std::string snake_case(const std::string& name);

/// Read a file. Throw std::runtime_error with the path if it cannot be read or is not JSON.
std::string read_text(const std::string& path);
nlohmann::ordered_json read_json(const std::string& path);

}  // namespace semblante::codegen
