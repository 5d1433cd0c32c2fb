#include "core/json/read_json.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/json/json_pointer.h"

namespace semblante {
namespace {

using nlohmann::json;

/// `near`: pointer of the value at the error.
Error not_json(std::size_t byte, const std::string& near = {}) {
  const std::string place = near.empty() ? "" : ", in " + near;
  return {ErrorCode::malformed, "", "is not valid JSON (byte " + std::to_string(byte) + place + ")"};
}

/// Builds the document from the parser's events. nlohmann's own builder accepts duplicate members, and its callback
/// form searches the parent at the end of each container.
class DocumentBuilder final : public nlohmann::json_sax<json> {
 public:
  DocumentBuilder(const JsonLimits& limits, const JsonElements* elements) : limits_(limits), elements_(elements) {}

  bool null() override { return put(json(nullptr)) != nullptr && completed(); }
  bool boolean(bool value) override { return put(json(value)) != nullptr && completed(); }
  bool number_integer(number_integer_t value) override { return put(json(value)) != nullptr && completed(); }
  bool number_unsigned(number_unsigned_t value) override { return put(json(value)) != nullptr && completed(); }
  bool number_float(number_float_t value, const string_t& /*text*/) override {
    return put(json(value)) != nullptr && completed();
  }
  bool string(string_t& value) override { return put(json(std::move(value))) != nullptr && completed(); }
  bool binary(binary_t& /*value*/) override { return fail(ErrorCode::malformed, "is not JSON"); }

  bool key(string_t& name) override {
    Open& object = open_.back();
    const auto [member, is_new] = object.container->get_ref<json::object_t&>().try_emplace(std::move(name));
    object.member = &*member;
    return is_new || fail(ErrorCode::malformed, "occurs twice");
  }
  bool start_object(std::size_t /*size*/) override { return start(json::object()); }
  bool start_array(std::size_t /*size*/) override { return start(json::array()); }
  bool end_object() override { return end(); }
  bool end_array() override { return end(); }

  bool parse_error(std::size_t byte, const std::string& /*token*/, const json::exception& error) override {
    if (fault_) return false;
    // 4xx: a number beyond the range of a double. Other errors are invalid JSON.
    if (error.id / 100 == 4) return fail(ErrorCode::not_finite, "is a number too large for a double");
    fault_ = not_json(byte, pointer());
    return false;
  }

  Result<json> finish() && {
    if (fault_) return *std::move(fault_);
    return std::move(root_);
  }

 private:
  using Member = json::object_t::value_type;

  struct Open {
    json* container;
    Member* member = nullptr;       ///< of an object: the one being read
    std::size_t handed_over = 0;    ///< of the array that is not kept: elements so far
    std::size_t values_before = 0;  ///< of that array: values of the document outside of it
    bool is_handed_over = false;
  };

  bool fail(ErrorCode code, std::string message) {
    if (!fault_) fault_ = Error{code, pointer(), std::move(message)};
    return false;
  }

  /// Pointer of the current value.
  [[nodiscard]] std::string pointer() const {
    std::string pointer;
    for (std::size_t level = 0; level < open_.size(); ++level) {
      const Open& open = open_[level];
      if (open.container->is_object()) {
        if (open.member != nullptr) append_to_pointer(pointer, open.member->first);
        continue;
      }
      // A container is added to its array when it begins, a scalar only when it is complete.
      const std::size_t begun = level + 1 < open_.size() ? 1 : 0;
      append_to_pointer(pointer, open.handed_over + open.container->size() - begun);
    }
    return pointer;
  }

  /// Adds a value at its place; nullptr when the number of values exceeds the limit.
  json* put(json value) {
    if (++values_ > limits_.max_values) {
      fail(ErrorCode::too_large, "has more than " + std::to_string(limits_.max_values) + " values");
      return nullptr;
    }
    if (open_.empty()) return &(root_ = std::move(value));
    const Open& parent = open_.back();
    if (parent.member != nullptr) return &(parent.member->second = std::move(value));
    return &parent.container->get_ref<json::array_t&>().emplace_back(std::move(value));
  }

  bool start(json container) {
    if (open_.size() == limits_.max_depth)
      return fail(ErrorCode::too_large, "is nested deeper than " + std::to_string(limits_.max_depth));
    json* const placed = put(std::move(container));
    if (placed == nullptr) return false;
    const bool is_handed_over = elements_ != nullptr && open_.size() == 1 && placed->is_array() &&
                                open_[0].member != nullptr && open_[0].member->first == elements_->member;
    open_.push_back({placed, nullptr, 0, values_, is_handed_over});
    return true;
  }

  bool end() {
    open_.pop_back();
    return completed();
  }

  /// Called after each value, when its container is the innermost open one.
  bool completed() {
    if (open_.empty() || !open_.back().is_handed_over) return true;
    Open& array = open_.back();
    auto& held = array.container->get_ref<json::array_t&>();
    Status status = elements_->take(array.handed_over, held.back());
    if (!status) {
      fault_ = std::move(status).error();
      return false;
    }
    held.clear();
    ++array.handed_over;
    values_ = array.values_before;
    return true;
  }

  const JsonLimits& limits_;
  const JsonElements* elements_;
  json root_;
  std::vector<Open> open_;  ///< outermost first
  std::size_t values_ = 0;
  std::optional<Error> fault_;
};

Result<json> read(std::string_view text, const JsonLimits& limits, const JsonElements* elements) {
  if (text.size() > limits.max_bytes)
    return Error{ErrorCode::too_large, "", "has more than " + std::to_string(limits.max_bytes) + " bytes"};
  // The parser treats a NUL byte as the end of its input.
  if (const std::size_t nul = text.find('\0'); nul != std::string_view::npos) return not_json(nul + 1);
  DocumentBuilder builder(limits, elements);
  (void)json::sax_parse(text.begin(), text.end(), &builder);
  return std::move(builder).finish();
}

Result<json> object_only(Result<json> document) {
  if (!document || document->is_object()) return document;
  return Error{ErrorCode::malformed, "", "must be an object, not " + std::string(document->type_name())};
}

}  // namespace

Result<json> read_json(std::string_view text, const JsonLimits& limits) { return read(text, limits, nullptr); }

Result<json> read_json_object(std::string_view text, const JsonLimits& limits) {
  return object_only(read(text, limits, nullptr));
}

Result<json> read_json_object(std::string_view text, const JsonLimits& limits, const JsonElements& elements) {
  return object_only(read(text, limits, &elements));
}

}  // namespace semblante
