#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace semblante {

enum class JsonKind : std::uint8_t {
  null,
  boolean,
  natural,   ///< a whole number from 0 to 2^64 - 1 without point and exponent
  negative,  ///< a whole number from -2^63 to -1 without point and exponent
  real,
  text,
  array,
  object,
};

/// "null", "true or false", "a number", "a string", "an array", "an object"
const char* kind_name(JsonKind kind);

class JsonView;

/// What holds JSON values: JsonTree, or nlohmann's document (nlohmann_json.h). `node` is one of its values.
class JsonHolder {
 public:
  virtual ~JsonHolder() = default;
  [[nodiscard]] virtual JsonKind kind(const void* node) const = 0;
  /// Elements of an array or members of an object.
  [[nodiscard]] virtual std::size_t size(const void* node) const = 0;
  /// Of an array; `index` is below its size.
  [[nodiscard]] virtual const void* element(const void* node, std::size_t index) const = 0;
  /// Of an object; null: there is none.
  [[nodiscard]] virtual const void* member(const void* node, std::string_view name) const = 0;
  /// Calls `visit(context, name, value)` for each member of an object, in the order of the names.
  using Visit = void (*)(void* context, std::string_view name, const void* value);
  virtual void members(const void* node, void* context, Visit visit) const = 0;
  /// Of a number of any kind.
  [[nodiscard]] virtual double number(const void* node) const = 0;
  /// Of a `natural`, or of true (1) and false (0).
  [[nodiscard]] virtual std::uint64_t natural(const void* node) const = 0;
  [[nodiscard]] virtual std::int64_t negative(const void* node) const = 0;
  [[nodiscard]] virtual std::string_view text(const void* node) const = 0;
};

/// A value of a JSON document, wherever it is held. Its holder must outlive it. Without a holder: null.
class JsonView {
 public:
  JsonView() = default;
  JsonView(const JsonHolder& holder, const void* node) : holder_(&holder), node_(node) {}

  [[nodiscard]] JsonKind kind() const { return holder_ == nullptr ? JsonKind::null : holder_->kind(node_); }
  [[nodiscard]] bool is_number() const { return kind() >= JsonKind::natural && kind() <= JsonKind::real; }
  [[nodiscard]] std::size_t size() const { return holder_->size(node_); }
  [[nodiscard]] JsonView element(std::size_t index) const { return {*holder_, holder_->element(node_, index)}; }
  /// A view without a value where there is no such member.
  [[nodiscard]] JsonView member(std::string_view name) const { return {*holder_, holder_->member(node_, name)}; }
  [[nodiscard]] bool has_value() const { return node_ != nullptr; }
  template <class Take>
  void members(Take take) const {
    struct Context {
      const JsonHolder* holder;
      Take* take;
    } context{holder_, &take};
    holder_->members(node_, &context, [](void* at, std::string_view name, const void* value) {
      auto& [holder, to] = *static_cast<Context*>(at);
      (*to)(name, JsonView(*holder, value));
    });
  }
  [[nodiscard]] double number() const { return holder_->number(node_); }
  [[nodiscard]] std::uint64_t natural() const { return holder_->natural(node_); }
  [[nodiscard]] std::int64_t negative() const { return holder_->negative(node_); }
  [[nodiscard]] std::string_view text() const { return holder_->text(node_); }

 private:
  const JsonHolder* holder_ = nullptr;
  const void* node_ = nullptr;
};

}  // namespace semblante
