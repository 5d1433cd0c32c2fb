#include "core/json/json_pointer.h"

#include "core/types/decimal.h"
#include "core/types/printable.h"

namespace semblante {
namespace {

constexpr std::size_t max_pointer_bytes = 1000;
constexpr std::string_view cut_off = "/...";

void append_segment(std::string& pointer, std::string_view segment) {
  if (pointer.ends_with(cut_off)) return;
  if (pointer.size() + 1 + segment.size() + cut_off.size() > max_pointer_bytes) {
    pointer.append(cut_off);
  } else {
    pointer.append("/").append(segment);
  }
}

}  // namespace

std::string pointer_segment(std::string_view name) {
  std::string segment;
  for (const char c : printable(name)) {
    if (c == '~') {
      segment += "~0";
    } else if (c == '/') {
      segment += "~1";
    } else {
      segment += c;
    }
  }
  return segment;
}

void append_to_pointer(std::string& pointer, std::string_view name) { append_segment(pointer, pointer_segment(name)); }

void append_to_pointer(std::string& pointer, std::size_t index) { append_segment(pointer, natural_text(index)); }

}  // namespace semblante
