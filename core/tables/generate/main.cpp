// semblante-codegen-tables SOURCE_FOLDER: writes the files that are generated from core/tables/data.
#include "core/codegen/generator.h"
#include "core/tables/generate/render.h"

int main(int argc, char** argv) {
  return semblante::codegen::run_generator(argc, argv, semblante::tables::generated_files);
}
