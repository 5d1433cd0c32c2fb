// semblante-codegen-declarations SOURCE_FOLDER: writes the structs of semblante.h for TypeScript and Python.
#include "clients/runtime/codegen/declaration_files.h"

int main(int argc, char** argv) {
  return semblante::codegen::run_generator(argc, argv, semblante::codegen::declaration_files);
}
