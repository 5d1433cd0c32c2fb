#include "server/cli/face_reading_options.h"

#include <map>

#include <CLI/CLI.hpp>

namespace semblante {

void add_face_reading_options(CLI::App& command, FaceReading& reading) {
  static const std::map<std::string, AbsentFap> absents = {{"zero", AbsentFap::zero}, {"keep", AbsentFap::keep}};
  static const std::map<std::string, FrameGap> gaps = {{"hold", FrameGap::hold},
                                                       {"interpolate", FrameGap::interpolate}};
  command
      .add_option_function<std::string>(
          "--absent", [&reading](const std::string& word) { reading.fap_meaning.absent = absents.at(word); },
          "What a FAP that a frame of a .fap file leaves out is: zero, or as it was (keep)")
      ->check(CLI::IsMember(absents))
      ->default_str("zero")
      ->envname("SEMBLANTE_ABSENT");
  command
      .add_option_function<std::string>(
          "--gaps", [&reading](const std::string& word) { reading.fap_meaning.gap = gaps.at(word); },
          "What the face does where a .fap file leaves frames out: hold or interpolate")
      ->check(CLI::IsMember(gaps))
      ->default_str("hold")
      ->envname("SEMBLANTE_GAPS");
}

}  // namespace semblante
