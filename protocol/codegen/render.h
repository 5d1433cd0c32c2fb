#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/codegen/generator.h"

namespace semblante::codegen {

/// All generated files, from protocol/schema, core/tables and the text of SPEC.md.
std::vector<GeneratedFile> protocol_files(const std::string& source_folder);

/// protocol/cpp/generated/messages.h: structs, enums and `visit_fields`, from which the codecs are templates.
std::string render_cpp(const nlohmann::ordered_json& schema);
/// protocol/ts/generated/messages.ts: interfaces, and the same description as data, which the codecs interpret.
std::string render_typescript(const nlohmann::ordered_json& schema);
/// protocol/cpp/generated/packed_tables.h: the constants of the packed form.
std::string render_packed_cpp(const nlohmann::ordered_json& packed);
/// protocol/cpp/generated/text_prime.h: the texts that packed texts begin with.
std::string render_text_prime(const nlohmann::ordered_json& prime);
/// Two tables of SPEC.md.
std::string packed_table_list(const nlohmann::ordered_json& packed);
std::string packed_reference_list(const nlohmann::ordered_json& packed);
/// Tables of SPEC.md from core/tables.
std::string fap_table();
std::string fap_group_table();
std::string feature_point_group_table();
std::string feature_point_table();
std::string fapu_table();
std::string companion_table();
std::string select_table();
/// SPEC.md with the text between each pair of `<!-- generated: NAME -->` and `<!-- end -->` generated again.
std::string render_spec(const nlohmann::ordered_json& schema, const nlohmann::ordered_json& packed,
                        const std::string& spec);

}  // namespace semblante::codegen
