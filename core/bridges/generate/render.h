#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "core/codegen/generator.h"

namespace semblante::bridges {

/// A blend shape of arkit.json, with its mirrored copy if requested.
struct ShapeData {
  std::string name;
  std::size_t mirror = 0;      ///< index of the shape of the other side; its own where it has two sides or none
  std::map<int, double> faps;  ///< FAP -> FAP units at coefficient 1
  double cost = 0.0;           ///< square millimetres
};

struct ArkitData {
  std::vector<ShapeData> shapes;
  std::vector<std::string> rotations;
  std::map<std::string, double> settings;
  std::array<double, 5> millimetres{};  ///< a FAPU's whole unit on a usual head, in the order of mpeg4::Unit
};

/// Reads arkit.json. Throws std::exception with the error: runs at development time only.
ArkitData read_arkit_data(const std::string& file);

/// core/bridges/generated/arkit_tables.h
std::string render_cpp(const ArkitData& data);

/// All generated files, from core/bridges/data.
std::vector<codegen::GeneratedFile> generated_files(const std::string& source_folder);

}  // namespace semblante::bridges
