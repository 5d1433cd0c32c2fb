// semblante-codegen-expressions SOURCE_FOLDER: writes the files that are generated from core/expressions/data.
#include "core/codegen/generator.h"
#include "core/expressions/generate/render.h"

int main(int argc, char** argv) {
  return semblante::codegen::run_generator(argc, argv, semblante::expressions::generated_files);
}
