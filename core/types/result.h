#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace semblante {

/// The kind of error, independent of the place of its detection. The REST layer maps each to a stable problem `type`.
enum class ErrorCode {
  malformed,         ///< the bytes do not follow their format
  truncated,         ///< the data ends before its declared end
  out_of_range,      ///< an index or a number outside its bounds
  not_finite,        ///< NaN or infinity in place of a finite number
  too_large,         ///< over a documented limit
  empty,             ///< nothing to work on (no triangles, no points)
  unsupported,       ///< valid, but outside what this program supports
  mismatch,          ///< two inputs that must belong together do not
  missing,           ///< something required is absent
  invalid_argument,  ///< a value that is not valid here
  cancelled,         ///< stopped on request
  io,                ///< the file system or the network failed
  internal,          ///< an error of this program
};

/// `code` for programs; `where` (JSON pointer, field, byte offset or line; may be empty) and `message` for display.
struct Error {
  ErrorCode code = ErrorCode::internal;
  std::string where;
  std::string message;
};

/// A value or an error. For untrusted input; mistakes of the caller are asserts.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}      // NOLINT(google-explicit-constructor)
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT(google-explicit-constructor)

  [[nodiscard]] bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }

  T& value() & { return assert(ok()), *std::get_if<0>(&state_); }
  const T& value() const& { return assert(ok()), *std::get_if<0>(&state_); }
  T&& value() && { return assert(ok()), std::move(*std::get_if<0>(&state_)); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

  const Error& error() const& { return assert(failed()), *std::get_if<1>(&state_); }
  Error&& error() && { return assert(failed()), std::move(*std::get_if<1>(&state_)); }

 private:
  /// Not `!ok()`: a variant may also be without any value, after a move that threw.
  [[nodiscard]] bool failed() const { return state_.index() == 1; }

  std::variant<T, Error> state_;
};

/// Success without a value.
struct Unit {};
using Status = Result<Unit>;

}  // namespace semblante
