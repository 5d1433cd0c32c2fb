#include <algorithm>
#include <span>

#include "clients/runtime/border.h"
#include "core/bridges/arkit.h"
#include "core/bridges/oculus.h"

namespace semblante::runtime {
namespace {

static_assert(arkit_count == 52 && oculus_count == 15, "as the header says");

/// Runs `make`, which returns a Result of a value with a frame, on the argument `values` of this name.
template <class Make>
semblante_result make_frame(const char* name, const float* values, semblante_frame* frame, semblante_error* error,
                            const Make& make) {
  if (values == nullptr || frame == nullptr)
    return fail(error, SEMBLANTE_INVALID_ARGUMENT, frame == nullptr ? "frame" : name, "is null");
  return guarded(error, [&] {
    const auto made = make();
    if (!made) return fail(error, SEMBLANTE_INVALID_ARGUMENT, made.error().where, made.error().message);
    *frame = made->frame;
    return SEMBLANTE_OK;
  });
}

template <class Read>
semblante_result read_frame(const semblante_frame* frame, float* to, const Read& read) {
  if (frame == nullptr || to == nullptr || !is_finite(*frame)) return SEMBLANTE_INVALID_ARGUMENT;
  return guarded(nullptr, [&] {
    const auto values = read(*frame);
    std::copy(values.begin(), values.end(), to);
    return SEMBLANTE_OK;
  });
}

}  // namespace
}  // namespace semblante::runtime

using namespace semblante;

extern "C" {

semblante_result semblante_frame_from_arkit(const float coefficients[52], semblante_frame* frame,
                                            semblante_error* error) {
  return runtime::make_frame("coefficients", coefficients, frame, error, [&] {
    return frame_from_arkit(std::span<const float, arkit_count>(coefficients, arkit_count));
  });
}

semblante_result semblante_arkit_from_frame(const semblante_frame* frame, float coefficients[52]) {
  return runtime::read_frame(frame, coefficients, arkit_from_frame);
}

semblante_result semblante_frame_from_oculus(const float weights[15], semblante_frame* frame, semblante_error* error) {
  return runtime::make_frame("weights", weights, frame, error, [&] {
    return frame_from_oculus(std::span<const float, oculus_count>(weights, oculus_count));
  });
}

semblante_result semblante_oculus_from_frame(const semblante_frame* frame, float weights[15]) {
  return runtime::read_frame(frame, weights, oculus_from_frame);
}

const char* semblante_arkit_name(uint32_t shape) {
  return shape < arkit_count ? arkit_name(shape).data() : nullptr;  // a literal, so it ends with a zero
}

const char* semblante_oculus_name(uint32_t viseme) {
  return viseme < oculus_count ? oculus_name(viseme).data() : nullptr;
}

}  // extern "C"
