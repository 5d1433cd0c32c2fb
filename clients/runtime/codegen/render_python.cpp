#include <algorithm>
#include <map>
#include <stdexcept>

#include "clients/runtime/codegen/declaration_files.h"

namespace semblante::codegen {
namespace {

/// Of a line, as the package's own code has it.
constexpr std::size_t widest_line = 120;

std::string python_type(const CMember& member, const std::map<std::string, std::string>& classes) {
  static const std::map<std::string, std::string> plain = {
      {"char", "c_char"},       {"uint8_t", "c_uint8"}, {"uint32_t", "c_uint32"}, {"size_t", "c_size_t"},
      {"uint64_t", "c_uint64"}, {"float", "c_float"},   {"double", "c_double"}};
  if (member.pointer && member.type == "char") return "c_char_p";
  std::string type;
  if (const auto found = plain.find(member.type); found != plain.end()) {
    type = found->second;
  } else if (const auto known = classes.find(member.type); known != classes.end()) {
    type = known->second;
  } else {
    throw std::runtime_error("unknown type " + member.type);
  }
  if (member.pointer) return "POINTER(" + type + ")";
  // ctypes names the innermost length first.
  for (auto length = member.lengths.rbegin(); length != member.lengths.rend(); ++length)
    type += " * " + std::to_string(*length);
  return type;
}

/// Words of `text`, in lines of at most widest_line characters.
std::string wrapped(const std::string& text, const std::string& indent) {
  std::string out;
  std::string line = indent;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, end - at);
    if (line.size() + 1 + word.size() > widest_line) {
      out += line + "\n";
      line = indent;
    }
    line += (line == indent ? "" : " ") + word;
    at = end + 1;
  }
  return out + line;
}

}  // namespace

std::string render_structs(const std::vector<CStruct>& structs) {
  std::string out =
      "# Generated from clients/runtime/semblante.h and core/kernel/semblante_kernel.h by "
      "semblante-codegen-declarations; change the\n"
      "# headers, not this.\n"
      "\"\"\"The structs of semblante.h: the same members in the same order.\"\"\"\n\n"
      "import ctypes\n"
      "from ctypes import POINTER, c_char, c_char_p, c_double, c_float, c_size_t, c_uint8, c_uint32, c_uint64\n"
      "from typing import Any\n\n\n"
      "class Sized(ctypes.Structure):\n"
      "    \"\"\"A struct that begins with its own size.\"\"\"\n\n"
      "    def __init__(self, **members: Any) -> None:\n"
      "        super().__init__(size=ctypes.sizeof(type(self)), **members)\n";
  std::map<std::string, std::string> classes;
  for (const CStruct& record : structs) {
    const std::string name = camel_case_name(record);
    const bool sized = !record.members.empty() && record.members.front().name == "size";
    out += "\n\nclass " + name + (sized ? "(Sized):\n" : "(ctypes.Structure):\n");
    if (!record.doc.empty()) out += wrapped("\"\"\"" + record.doc + "\"\"\"", "    ") + "\n\n";
    out += "    _fields_ = [\n";
    for (const CMember& member : record.members)
      out += "        (\"" + member.name + "\", " + python_type(member, classes) + "),\n";
    out += "    ]\n";
    classes[record.name] = name;
  }
  out += "\n\nstructs = {\n";
  for (const auto& record : structs) out += "    \"" + record.name + "\": " + classes[record.name] + ",\n";
  return out + "}\n";
}

}  // namespace semblante::codegen
