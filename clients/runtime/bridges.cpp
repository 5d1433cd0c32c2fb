#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <span>
#include <string_view>

#include "clients/runtime/copy_text.h"
#include "clients/runtime/semblante.h"
#include "core/bridges/arkit.h"
#include "core/bridges/oculus.h"

namespace {

using semblante::runtime::copy_text;

static_assert(semblante::arkit_count == 52 && semblante::oculus_count == 15, "as the header says");

/// Runs `make`, which returns a Result of a value with a frame; catches all exceptions.
template <class Make>
semblante_result make_frame(semblante_frame* frame, semblante_error* error, const Make& make) {
  try {
    const auto made = make();
    if (made) {
      *frame = made->frame;
      return SEMBLANTE_OK;
    }
    if (error != nullptr) {
      copy_text(error->where, made.error().where);
      copy_text(error->message, made.error().message);
    }
    return SEMBLANTE_INVALID_ARGUMENT;
  } catch (const std::bad_alloc&) {
    return SEMBLANTE_OUT_OF_MEMORY;
  } catch (...) {
    return SEMBLANTE_INTERNAL;
  }
}

template <class Read>
semblante_result read_frame(const semblante_frame* frame, float* to, const Read& read) {
  if (frame == nullptr || to == nullptr) return SEMBLANTE_INVALID_ARGUMENT;
  const bool finite =
      std::all_of(std::begin(frame->fap), std::end(frame->fap), [](float f) { return std::isfinite(f); });
  if (!finite) return SEMBLANTE_INVALID_ARGUMENT;
  try {
    const auto values = read(*frame);
    std::copy(values.begin(), values.end(), to);
    return SEMBLANTE_OK;
  } catch (const std::bad_alloc&) {
    return SEMBLANTE_OUT_OF_MEMORY;
  } catch (...) {
    return SEMBLANTE_INTERNAL;
  }
}

}  // namespace

semblante_result semblante_frame_from_arkit(const float coefficients[52], semblante_frame* frame,
                                            semblante_error* error) {
  if (coefficients == nullptr || frame == nullptr) return SEMBLANTE_INVALID_ARGUMENT;
  return make_frame(frame, error, [&] {
    return semblante::frame_from_arkit(std::span<const float, semblante::arkit_count>(coefficients, 52));
  });
}

semblante_result semblante_arkit_from_frame(const semblante_frame* frame, float coefficients[52]) {
  return read_frame(frame, coefficients, semblante::arkit_from_frame);
}

semblante_result semblante_frame_from_oculus(const float weights[15], semblante_frame* frame, semblante_error* error) {
  if (weights == nullptr || frame == nullptr) return SEMBLANTE_INVALID_ARGUMENT;
  return make_frame(frame, error, [&] {
    return semblante::frame_from_oculus(std::span<const float, semblante::oculus_count>(weights, 15));
  });
}

semblante_result semblante_oculus_from_frame(const semblante_frame* frame, float weights[15]) {
  return read_frame(frame, weights, semblante::oculus_from_frame);
}
