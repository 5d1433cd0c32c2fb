#include <algorithm>
#include <map>
#include <stdexcept>

#include "clients/runtime/codegen/declaration_files.h"
#include "core/types/letter_case.h"

namespace semblante::codegen {
namespace {

struct Extent {
  int size = 0;
  int alignment = 1;
};

int padded(int size, int alignment) { return (size + alignment - 1) / alignment * alignment; }

/// "semblante_timed_frame" -> "timedFrameLayout".
std::string layout_name(const CStruct& record) {
  std::string name = camel_case_name(record);
  name[0] = lower_case(name[0]);
  return name + "Layout";
}

}  // namespace

std::string render_layouts(const std::vector<CStruct>& structs) {
  std::map<std::string, Extent> extents = {{"char", {1, 1}},   {"uint8_t", {1, 1}},  {"uint32_t", {4, 4}},
                                           {"size_t", {4, 4}}, {"uint64_t", {8, 8}}, {"float", {4, 4}},
                                           {"double", {8, 8}}};
  std::string out =
      "// Generated from clients/runtime/semblante.h and core/kernel/semblante_kernel.h by "
      "semblante-codegen-declarations; change the\n"
      "// headers, not this. Offsets of members in bytes, with the 4-byte pointers of WebAssembly. `bytes`: the whole "
      "struct.\n";
  for (const CStruct& record : structs) {
    out += "\nexport const " + layout_name(record) + " = {\n";
    Extent whole;
    for (const CMember& member : record.members) {
      const auto found = extents.find(member.type);
      if (found == extents.end()) throw std::runtime_error(record.name + ": unknown type " + member.type);
      Extent one = member.pointer ? Extent{4, 4} : found->second;
      for (const int length : member.lengths) one.size *= length;
      const int at = padded(whole.size, one.alignment);
      out += "  " + member.name + ": " + std::to_string(at) + ",\n";
      whole.size = at + one.size;
      whole.alignment = std::max(whole.alignment, one.alignment);
    }
    whole.size = padded(whole.size, whole.alignment);
    out += "  bytes: " + std::to_string(whole.size) + ",\n} as const;\n";
    extents[record.name] = whole;
  }
  return out;
}

}  // namespace semblante::codegen
