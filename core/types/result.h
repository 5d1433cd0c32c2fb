#pragma once

#include <cassert>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/types/advice.h"

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
/// `advice` is set where the kind of error alone does not tell what helps: `message` does not repeat it.
struct Error {
  Error() = default;
  Error(ErrorCode kind, std::string place, std::string words)
      : code(kind), where(std::move(place)), message(std::move(words)) {}
  Error(ErrorCode kind, std::string place, std::string words, std::optional<Advice> helps)
      : code(kind), advice(helps), where(std::move(place)), message(std::move(words)) {}
  /// Of fixed texts, which many errors have: small code where they are made.
  Error(ErrorCode kind, const char* place, const char* words);

  ErrorCode code = ErrorCode::internal;
  std::optional<Advice> advice;
  std::string where;
  std::string message;
};

/// A value or an error. For untrusted input; mistakes of the caller are asserts. An error is on the heap: few results
/// have one, and every result is moved and destroyed.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : value_(std::move(value)) {}                               // NOLINT(google-explicit-constructor)
  Result(Error error) : error_(std::make_unique<Error>(std::move(error))) {}  // NOLINT(google-explicit-constructor)
  Result(const Result& other)
      : value_(other.value_), error_(other.error_ ? std::make_unique<Error>(*other.error_) : nullptr) {}
  Result(Result&&) noexcept = default;
  Result& operator=(Result other) {
    value_ = std::move(other.value_);
    error_ = std::move(other.error_);
    return *this;
  }
  ~Result() = default;

  [[nodiscard]] bool ok() const { return value_.has_value(); }
  explicit operator bool() const { return ok(); }

  T& value() & { return assert(ok()), *value_; }
  const T& value() const& { return assert(ok()), *value_; }
  T&& value() && { return assert(ok()), std::move(*value_); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

  const Error& error() const& { return assert(error_ != nullptr), *error_; }
  Error&& error() && { return assert(error_ != nullptr), std::move(*error_); }

 private:
  std::optional<T> value_;
  std::unique_ptr<Error> error_;
};

/// Success without a value.
struct Unit {};
using Status = Result<Unit>;

}  // namespace semblante
