// semblante-codegen-api SOURCE_FOLDER OUTPUT_FOLDER: writes the files that are generated from server/api/openapi.json,
// and the documents that the server sends.
#include "core/codegen/generator.h"
#include "server/api/codegen/render.h"

namespace semblante::codegen {
namespace {

std::vector<GeneratedFile> api_files(const std::string& source_folder) {
  const std::string path = source_folder + "/server/api/openapi.json";
  const Json document = read_json(path);
  const std::string folder = "server/api/generated/";
  return {{folder + "handlers.h", render_handlers(document)},
          {folder + "route_table.cpp", render_route_table(document)},
          {folder + "answers.h", render_answers_header(document)},
          {folder + "answers.cpp", render_answers_source(document)},
          {folder + "SCOPES.md", render_scopes(document)},
          {folder + "body_members.h", render_body_members(document)},
          {folder + "documents.cpp",
           render_documents(
               {{"openapi_document", read_text(path)},
                {"protocol_specification", read_text(source_folder + "/protocol/SPEC.md")},
                {"packed_tables_document", read_text(source_folder + "/protocol/schema/packed_tables.json")}})}};
}

}  // namespace
}  // namespace semblante::codegen

int main(int argc, char** argv) { return semblante::codegen::run_generator(argc, argv, semblante::codegen::api_files); }
