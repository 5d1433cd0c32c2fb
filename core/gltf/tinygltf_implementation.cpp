// The one translation unit that holds tinygltf's code. The options that shape it are on the CMake target, so that
// every includer sees the same ones.
#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
