#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

/// What every generator of source files has in common. It runs at development time or within a build only, so that
/// faults are exceptions with a message for developers.
namespace semblante::codegen {

struct GeneratedFile {
  std::string path;  ///< below the source folder, or below the folder that is given for output
  std::string text;
};

/// Makes the text of every file that a room generates from the data in the source folder; writes nothing. Throws
/// std::exception on any fault of the data.
using Generator = std::vector<GeneratedFile> (*)(const std::string& source_folder);

/// `main` of a generator: writes its files below the source folder that argv names, or below the second folder of argv
/// where there is one. Returns the exit status.
int run_generator(int argc, char** argv, Generator generate);

/// The paths of the files whose committed text is not what the generator makes: none where all are up to date.
std::vector<std::string> out_of_date(const std::string& source_folder, Generator generate);

/// "ResumePoint" and "resumePoint" -> "resume_point".
std::string snake_case(const std::string& name);

/// Both throw std::runtime_error that names the file where it cannot be read or is no JSON.
std::string read_text(const std::string& path);
nlohmann::ordered_json read_json(const std::string& path);

}  // namespace semblante::codegen
