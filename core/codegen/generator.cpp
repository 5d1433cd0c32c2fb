#include "core/codegen/generator.h"

#include <cctype>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "core/types/letter_case.h"

namespace semblante::codegen {
namespace {

void write_text(const std::string& path, const std::string& text) {
  // What did not change keeps its time, so that nothing is compiled again for it.
  if (std::filesystem::exists(path) && read_text(path) == text) return;
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (!folder.empty()) std::filesystem::create_directories(folder);
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw std::runtime_error("cannot write " + path);
}

}  // namespace

std::string read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot open " + path);
  return {std::istreambuf_iterator<char>(file), {}};
}

nlohmann::ordered_json read_json(const std::string& path) {
  try {
    return nlohmann::ordered_json::parse(read_text(path));
  } catch (const nlohmann::ordered_json::exception& fault) {
    throw std::runtime_error(path + ": " + fault.what());
  }
}

int run_generator(int argc, char** argv, Generator generate) {
  if (argc != 2 && argc != 3) {
    std::fprintf(stderr, "usage: %s SOURCE_FOLDER [OUTPUT_FOLDER]\n", argv[0]);
    return 2;
  }
  try {
    const std::string source_folder = argv[1];
    const std::string output_folder = argc == 3 ? argv[2] : source_folder;
    for (const GeneratedFile& file : generate(source_folder)) write_text(output_folder + "/" + file.path, file.text);
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "%s: %s\n", argv[0], fault.what());
    return 1;
  }
  return 0;
}

std::vector<std::string> out_of_date(const std::string& source_folder, Generator generate) {
  std::vector<std::string> paths;
  for (const GeneratedFile& file : generate(source_folder)) {
    if (read_text(source_folder + "/" + file.path) != file.text) paths.push_back(file.path);
  }
  return paths;
}

std::string snake_case(const std::string& name) {
  std::string result;
  for (const char c : name) {
    const bool upper = std::isupper(static_cast<unsigned char>(c)) != 0;
    if (upper && !result.empty()) result += '_';
    result += lower_case(c);
  }
  return result;
}

}  // namespace semblante::codegen
