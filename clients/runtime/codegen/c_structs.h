#pragma once

#include <string>
#include <vector>

namespace semblante::codegen {

/// A member of a C struct, such as `const float* rest` or `float eye_pivot[2][3]`.
struct CMember {
  std::string name;
  std::string type;  ///< without const and pointer: "float", "semblante_iris"
  bool pointer = false;
  std::vector<int> lengths;  ///< of an array, outermost first; empty: not an array
};

struct CStruct {
  std::string name;  ///< with its prefix: "semblante_frame"
  std::string doc;   ///< the comment before it, one line without marks; may be empty
  std::vector<CMember> members;
};

/// "semblante_timed_frame" -> "TimedFrame".
std::string camel_case_name(const CStruct& record);

/// Reads the definitions `typedef struct NAME { ... } NAME;` of a header, in their order. Lengths of arrays may be sums
/// and products of whole numbers and of names that the header or `more` defines as such. It knows the C of our own
/// headers and no more: throws std::runtime_error with the place for anything else.
std::vector<CStruct> read_c_structs(const std::string& header, const std::string& more = {});

}  // namespace semblante::codegen
