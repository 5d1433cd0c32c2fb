// semblante-codegen-bridges SOURCE_FOLDER: writes what is generated from core/bridges/data.
#include "core/bridges/generate/render.h"
#include "core/codegen/generator.h"

int main(int argc, char** argv) {
  return semblante::codegen::run_generator(argc, argv, semblante::bridges::generated_files);
}
