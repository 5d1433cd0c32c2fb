#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/codegen/generator.h"

namespace semblante::tables {

/// The parsed files of core/tables/data.
struct TableData {
  nlohmann::ordered_json faps, feature_points, fapus, high_level, companions;
};

/// Reads the data files. Throws std::exception with the file's name on any fault: this runs at development time only.
TableData read_table_data(const std::string& data_folder);

/// core/tables/generated/mpeg4_tables.h: the tables of the freestanding kernel, in C.
std::string render_c_header(const TableData& data);
/// core/tables/generated/mpeg4_entries.h: the constexpr entries of core/tables/mpeg4.h.
std::string render_cpp_header(const TableData& data);
/// protocol/ts/generated/mpeg4.ts: the same for the web.
std::string render_typescript(const TableData& data);

/// All of them, from core/tables/data.
std::vector<codegen::GeneratedFile> generated_files(const std::string& source_folder);

}  // namespace semblante::tables
