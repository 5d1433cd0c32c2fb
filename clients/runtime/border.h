#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <new>
#include <span>
#include <string_view>

#include "clients/runtime/semblante.h"
#include "core/types/result.h"

/// What every function at the border of the library does: sized structs, errors as values, no exception.
namespace semblante::runtime {

/// Copies a text to a field of a C struct: truncated to its size at the end of a character, and zero-terminated.
void copy_text(std::span<char> to, std::string_view text);

inline semblante_result fail(semblante_error* error, semblante_result result, std::string_view where,
                             std::string_view message) {
  if (error != nullptr) {
    copy_text(error->where, where);
    copy_text(error->message, message);
  }
  return result;
}

semblante_result result_of(ErrorCode code);

inline semblante_result fail(semblante_error* error, const Error& why, std::string_view part = {}) {
  return fail(error, result_of(why.code), std::string(part) + why.where, why.message);
}

/// Runs `work`. Nothing of ours throws; the standard library does when memory ends. Builds without exceptions abort
/// then.
template <class Work>
semblante_result guarded(semblante_error* error, const Work& work) {
#ifdef __cpp_exceptions
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return fail(error, SEMBLANTE_OUT_OF_MEMORY, "", "not enough memory");
  } catch (...) {
    return fail(error, SEMBLANTE_INTERNAL, "", "unexpected error inside the library");
  }
#else
  static_cast<void>(error);
  return work();
#endif
}

/// The same for functions without a result.
template <class Work>
void guarded(const Work& work) {
  static_cast<void>(guarded(nullptr, [&] { return work(), SEMBLANTE_OK; }));
}

/// A struct of the caller as this library knows it: zero where the caller's is shorter. Null is all zero. False when
/// its `size` is not even that of the member.
template <class Struct>
bool read_struct(const Struct* from, Struct& to) {
  to = Struct{};
  if (from == nullptr) return true;
  if (from->size < sizeof(from->size)) return false;
  std::memcpy(&to, from, std::min<std::size_t>(from->size, sizeof(Struct)));
  return true;
}

/// Writes as much as the caller's struct holds, and keeps its size.
template <class Struct>
bool write_struct(Struct from, Struct* to) {
  if (to == nullptr || to->size < sizeof(to->size)) return false;
  from.size = to->size;
  std::memcpy(to, &from, std::min<std::size_t>(to->size, sizeof(Struct)));
  return true;
}

inline bool all_finite(std::span<const float> values) {
  return std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
}
inline bool is_finite(const semblante_frame& frame) { return all_finite(frame.fap); }
inline bool is_finite(const semblante_pose& pose) {
  // All members are floats without padding, so the struct reads as one array.
  static_assert(sizeof(semblante_pose) % sizeof(float) == 0);
  std::array<float, sizeof(semblante_pose) / sizeof(float)> values{};
  std::memcpy(values.data(), &pose, sizeof(pose));
  return all_finite(values);
}

}  // namespace semblante::runtime
