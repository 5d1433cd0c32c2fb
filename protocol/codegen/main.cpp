// semblante-codegen-protocol SOURCE_FOLDER: writes the files that are generated from protocol/schema and, in SPEC.md,
// core/tables.
#include "core/codegen/generator.h"
#include "protocol/codegen/render.h"

int main(int argc, char** argv) {
  return semblante::codegen::run_generator(argc, argv, semblante::codegen::protocol_files);
}
