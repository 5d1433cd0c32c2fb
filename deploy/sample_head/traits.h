#pragma once

#include <cstdint>

namespace semblante {

/// What a file of the family contains.
enum class SampleHeadForm : std::uint8_t {
  bust,  ///< the head with a shirt
  body,  ///< the bust on a whole figure with a skeleton: separate parts of clothes, hands and shoes
  scan,  ///< one irregular open surface as a scanner sees the bust: no inside of the mouth, no eyeballs, not symmetric
};

/// What distinguishes one head of the family from another; the default is the sample head itself. Factors are about 1.
struct SampleHeadTraits {
  double jaw_width = 1.0;     ///< of the lower face
  double face_length = 1.0;   ///< from the eyes to the chin
  double nose_length = 1.0;   ///< how far the nose stands out
  bool pressed_lips = false;  ///< thin lips, hardly any space between them
  bool closed_eyes = false;   ///< upper lids on the lower ones in the neutral face
  SampleHeadForm form = SampleHeadForm::bust;

  bool operator==(const SampleHeadTraits&) const = default;
};

}  // namespace semblante
