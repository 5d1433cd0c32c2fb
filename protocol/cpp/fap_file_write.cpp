#include <algorithm>
#include <cassert>

#include "core/types/decimal.h"
#include "protocol/cpp/face_frame.h"
#include "protocol/cpp/fap_file.h"
#include "protocol/cpp/fap_number.h"

namespace semblante {
namespace {

void append(std::string& text, int value) { text.append(" ").append(whole_text(value)); }

void append_frame(std::string& text, const FapFileFrame& frame) {
  for (std::size_t fap = 1; fap <= last_low_level_fap; ++fap) {
    text.append(fap > 1 ? " " : "").append(frame.present[fap] ? "1" : "0");
  }
  text.append("\n").append(natural_text(frame.number));
  if (frame.present[1]) {
    const auto& viseme = frame.viseme;
    for (const int field : {viseme.select1, viseme.select2, viseme.blend, viseme.viseme_def}) append(text, field);
  }
  if (frame.present[2]) {
    const auto& expression = frame.expression;
    for (const int field : {expression.select1, expression.intensity1, expression.select2, expression.intensity2,
                            expression.init_face, expression.expression_def}) {
      append(text, field);
    }
  }
  for (std::size_t fap = 3; fap <= last_low_level_fap; ++fap) {
    if (frame.present[fap]) text.append(" ").append(write_fap_number(frame.value[fap]));
  }
  text.append("\n");
}

}  // namespace

std::string write_fap_file(const FapFile& file) {
  assert(!file.frames.empty() && file.frames.front().number == 0);
  std::string text = "2.1 " + (file.name.empty() ? "semblante" : file.name) + " " + write_fap_number(file.rate) + " " +
                     natural_text(file.frames.size()) + "\n";
  for (const auto& frame : file.frames) append_frame(text, frame);
  return text;
}

}  // namespace semblante
