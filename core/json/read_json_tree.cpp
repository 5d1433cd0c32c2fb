#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "core/json/json_pointer.h"
#include "core/json/json_tree.h"
#include "core/types/decimal.h"
#include "core/types/printable.h"

namespace semblante {

/// Reads a text without recursion. Complete values wait in `waiting_` until their container ends; then they move to
/// their consecutive places in the tree.
class JsonReader {
 public:
  JsonReader(std::string_view text, const JsonLimits& limits, const JsonElements* elements)
      : text_(text), limits_(limits), elements_(elements) {}

  Result<JsonTree> read() && {
    // Offsets in the tree have 32 bits.
    const std::size_t most = std::min<std::size_t>(limits_.max_bytes, ~std::uint32_t{0});
    if (text_.size() > most) {
      return Error{ErrorCode::too_large, "", "has more than " + natural_text(most) + " bytes"};
    }
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
    // No JSON begins with two characters one of which is not ASCII, or with a byte order mark of UTF-16.
    if (text_.starts_with("\xFF\xFE") || text_.starts_with("\xFE\xFF") ||
        text_.substr(0, 2).find('\0') != std::string_view::npos) {
      return Error{ErrorCode::malformed, "", "must be UTF-8, not UTF-16 or UTF-32"};
    }
    while (!fault_ && step()) {
    }
    if (!fault_) {
      skip_blanks();
      if (at_ < text_.size()) not_json();
    }
    if (fault_) return *std::move(fault_);
    tree_.root_ = waiting_.front();
    return std::move(tree_);
  }

 private:
  using Node = JsonTree::Node;

  struct Open {
    std::size_t first;       ///< index of its first child in `waiting_`
    std::uint32_t name = 0;  ///< of the container itself, in the tree's texts
    std::uint32_t name_size = 0;
    bool is_object = false;
    bool is_handed_over = false;
    std::size_t handed_over = 0;  ///< elements so far
    /// Of an array that is handed over: the size of the document outside of it.
    std::size_t values_before = 0;
    std::size_t nodes_before = 0;
    std::size_t texts_before = 0;
    std::uint32_t member = 0;  ///< of an object: name of the member being read
    std::uint32_t member_size = 0;
    bool has_member = false;
  };

  // ---- faults

  bool fail(ErrorCode code, std::string message) {
    if (!fault_) fault_ = Error{code, pointer(), std::move(message)};
    return false;
  }

  /// The byte at `at_` is not what JSON allows there.
  bool not_json() {
    if (fault_) return false;
    const std::string place = pointer();
    fault_ = Error{ErrorCode::malformed, "",
                   "is not valid JSON (byte " + natural_text(at_ + 1) + (place.empty() ? "" : ", in " + place) + ")"};
    return false;
  }

  /// Pointer of the current value.
  [[nodiscard]] std::string pointer() const {
    std::string pointer;
    for (std::size_t level = 0; level < open_.size(); ++level) {
      const Open& open = open_[level];
      const std::size_t end = level + 1 < open_.size() ? open_[level + 1].first : waiting_.size();
      if (!open.is_object) {
        append_to_pointer(pointer, open.handed_over + end - open.first);
      } else if (open.has_member) {
        append_to_pointer(pointer, std::string_view(tree_.texts_).substr(open.member, open.member_size));
      }
    }
    return pointer;
  }

  // ---- tokens

  [[nodiscard]] char next() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  void skip_blanks() {
    while (next() == ' ' || next() == '\n' || next() == '\r' || next() == '\t') ++at_;
  }

  bool word(std::string_view word) {
    for (const char c : word) {
      if (next() != c) return not_json();
      ++at_;
    }
    return true;
  }

  bool digits() {
    if (next() < '0' || next() > '9') return not_json();
    while (next() >= '0' && next() <= '9') ++at_;
    return true;
  }

  bool number(Node& node) {
    const std::size_t begin = at_;
    const bool negative = next() == '-';
    if (negative) ++at_;
    if (next() == '0') {
      ++at_;
    } else if (!digits()) {
      return false;
    }
    bool is_whole = true;
    if (next() == '.') {
      is_whole = false;
      ++at_;
      if (!digits()) return false;
    }
    if (next() == 'e' || next() == 'E') {
      is_whole = false;
      ++at_;
      if (next() == '+' || next() == '-') ++at_;
      if (!digits()) return false;
    }
    const std::string_view token = text_.substr(begin, at_ - begin);
    if (is_whole && whole(token, negative, node)) return true;
    node.kind = JsonKind::real;
    node.real = *read_double(token);
    return std::isfinite(node.real) || fail(ErrorCode::not_finite, "is a number too large for a double");
  }

  /// Whether it has 64 bits.
  static bool whole(std::string_view token, bool negative, Node& node) {
    std::uint64_t value = 0;
    for (const char c : token.substr(negative ? 1 : 0)) {
      const auto digit = static_cast<std::uint64_t>(c - '0');
      if (value > (~std::uint64_t{0} - digit) / 10) return false;
      value = value * 10 + digit;
    }
    constexpr std::uint64_t most_negative = std::uint64_t{1} << 63U;
    if (negative && value > most_negative) return false;
    node.kind = negative && value != 0 ? JsonKind::negative : JsonKind::natural;
    node.bits = negative ? 0 - value : value;
    return true;
  }

  bool hexadecimal(std::uint32_t& unit) {
    unit = 0;
    for (int i = 0; i < 4; ++i, ++at_) {
      const char c = next();
      std::uint32_t digit = 16;
      if (c >= '0' && c <= '9') digit = static_cast<std::uint32_t>(c - '0');
      if (c >= 'a' && c <= 'f') digit = static_cast<std::uint32_t>(c - 'a' + 10);
      if (c >= 'A' && c <= 'F') digit = static_cast<std::uint32_t>(c - 'A' + 10);
      if (digit == 16) return not_json();
      unit = unit << 4U | digit;
    }
    return true;
  }

  void put_utf8(std::uint32_t code) {
    std::string& to = tree_.texts_;
    const auto tail = [&](unsigned shift) { to += static_cast<char>(0x80U | (code >> shift & 0x3FU)); };
    if (code < 0x80) {
      to += static_cast<char>(code);
    } else if (code < 0x800) {
      to += static_cast<char>(0xC0U | code >> 6U);
      tail(0);
    } else if (code < 0x10000) {
      to += static_cast<char>(0xE0U | code >> 12U);
      tail(6);
      tail(0);
    } else {
      to += static_cast<char>(0xF0U | code >> 18U);
      tail(12);
      tail(6);
      tail(0);
    }
  }

  bool escape() {
    static constexpr std::string_view short_names = "\"\\/bfnrt";
    static constexpr std::string_view short_values = "\"\\/\b\f\n\r\t";
    const char c = next();
    if (const std::size_t found = short_names.find(c); c != '\0' && found != std::string_view::npos) {
      tree_.texts_ += short_values[found];
      ++at_;
      return true;
    }
    if (c != 'u') return not_json();
    ++at_;
    std::uint32_t code = 0;
    if (!hexadecimal(code)) return false;
    if (code >= 0xDC00 && code < 0xE000) return not_json();
    if (code >= 0xD800 && code < 0xDC00) {
      std::uint32_t low = 0;
      if (!word("\\u") || !hexadecimal(low)) return false;
      if (low < 0xDC00 || low >= 0xE000) return not_json();
      code = 0x10000U + ((code - 0xD800U) << 10U) + (low - 0xDC00U);
    }
    put_utf8(code);
    return true;
  }

  /// A string, appended to the texts of the tree.
  bool text(std::uint32_t& begin, std::uint32_t& size) {
    begin = static_cast<std::uint32_t>(tree_.texts_.size());
    ++at_;
    while (next() != '"') {
      const auto c = static_cast<unsigned char>(next());
      if (c < 0x20) return not_json();  // the end of the text as well
      if (c == '\\') {
        ++at_;
        if (!escape()) return false;
        continue;
      }
      const std::size_t length = utf8_length(text_.substr(at_, 4));
      if (length == 0) return not_json();
      tree_.texts_.append(text_.substr(at_, length));
      at_ += length;
    }
    ++at_;
    size = static_cast<std::uint32_t>(tree_.texts_.size() - begin);
    return true;
  }

  // ---- values and containers

  /// Reads what is next: the end of a container, or a member's name, and a value or the beginning of a container.
  /// Returns whether more is to come.
  bool step() {
    skip_blanks();
    if (!open_.empty()) {
      Open& parent = open_.back();
      const char end = parent.is_object ? '}' : ']';
      const bool is_first = waiting_.size() == parent.first && parent.handed_over == 0;
      if (next() == end) {
        ++at_;
        return close();
      }
      if (!is_first) {
        if (next() != ',') return not_json();
        ++at_;
        skip_blanks();
      }
      if (parent.is_object && !name(parent)) return false;
    }
    return value();
  }

  bool name(Open& object) {
    if (next() != '"') return not_json();
    std::uint32_t begin = 0;
    std::uint32_t size = 0;
    if (!text(begin, size)) return false;
    object.member = begin;
    object.member_size = size;
    object.has_member = true;
    skip_blanks();
    if (next() != ':') return not_json();
    ++at_;
    skip_blanks();
    return true;
  }

  bool value() {
    Node node;
    if (!open_.empty() && open_.back().is_object) {
      node.name = open_.back().member;
      node.name_size = open_.back().member_size;
    }
    const char c = next();
    const bool opens = c == '{' || c == '[';
    const bool known = opens || c == '"' || c == '-' || (c >= '0' && c <= '9') || c == 't' || c == 'f' || c == 'n';
    if (!known) return not_json();
    if (opens && open_.size() == limits_.max_depth) {
      return fail(ErrorCode::too_large, "is nested deeper than " + natural_text(limits_.max_depth));
    }
    if (++values_ > limits_.max_values) {
      return fail(ErrorCode::too_large, "has more than " + natural_text(limits_.max_values) + " values");
    }
    if (opens) return open(node, c == '{');
    bool read = true;
    if (c == '"') {
      node.kind = JsonKind::text;
      std::uint32_t begin = 0;
      std::uint32_t count = 0;
      read = text(begin, count);
      node.range = {begin, count};
    } else if (c == 't' || c == 'f') {
      node.kind = JsonKind::boolean;
      node.bits = c == 't' ? 1 : 0;
      read = word(c == 't' ? "true" : "false");
    } else if (c == 'n') {
      read = word("null");
    } else {
      read = number(node);
    }
    return read && completed(node);
  }

  bool open(const Node& node, bool is_object) {
    ++at_;
    const bool is_handed_over = elements_ != nullptr && open_.size() == 1 && !is_object && open_[0].is_object &&
                                std::string_view(tree_.texts_).substr(node.name, node.name_size) == elements_->member;
    open_.push_back({.first = waiting_.size(),
                     .name = node.name,
                     .name_size = node.name_size,
                     .is_object = is_object,
                     .is_handed_over = is_handed_over,
                     .values_before = values_,
                     .nodes_before = tree_.nodes_.size(),
                     .texts_before = tree_.texts_.size()});
    return true;
  }

  bool close() {
    const Open closed = open_.back();
    Node node;
    node.kind = closed.is_object ? JsonKind::object : JsonKind::array;
    node.name = closed.name;
    node.name_size = closed.name_size;
    const auto first = waiting_.begin() + static_cast<std::ptrdiff_t>(closed.first);
    if (closed.is_object && !sort_members(first)) return false;
    open_.pop_back();
    node.range = {static_cast<std::uint32_t>(tree_.nodes_.size()), static_cast<std::uint32_t>(waiting_.end() - first)};
    tree_.nodes_.insert(tree_.nodes_.end(), first, waiting_.end());
    waiting_.erase(first, waiting_.end());
    return completed(node);
  }

  bool sort_members(std::vector<Node>::iterator first) {
    const auto before = [this](const Node& a, const Node& b) { return tree_.name_of(a) < tree_.name_of(b); };
    if (!std::is_sorted(first, waiting_.end(), before)) {
      std::make_heap(first, waiting_.end(), before);
      std::sort_heap(first, waiting_.end(), before);
    }
    const auto twice = std::adjacent_find(
        first, waiting_.end(), [this](const Node& a, const Node& b) { return tree_.name_of(a) == tree_.name_of(b); });
    if (twice == waiting_.end()) return true;
    open_.back().member = twice->name;
    open_.back().member_size = twice->name_size;
    return fail(ErrorCode::malformed, "occurs twice");
  }

  /// Adds a complete value to its container, or hands it over. Returns whether more is to come.
  bool completed(const Node& node) {
    if (open_.empty() || !open_.back().is_handed_over) {
      waiting_.push_back(node);
      return !open_.empty();
    }
    Open& array = open_.back();
    Status status = elements_->take(array.handed_over, {tree_, &node});
    if (!status) {
      fault_ = std::move(status).error();
      return false;
    }
    ++array.handed_over;
    values_ = array.values_before;
    tree_.nodes_.resize(array.nodes_before);
    tree_.texts_.resize(array.texts_before);
    return true;
  }

  std::string_view text_;
  const JsonLimits& limits_;
  const JsonElements* elements_;
  std::size_t at_ = 0;
  std::size_t values_ = 0;
  JsonTree tree_;
  std::vector<Node> waiting_;
  std::vector<Open> open_;  ///< outermost first
  std::optional<Error> fault_;
};

Result<JsonTree> read_json_tree(std::string_view text, const JsonLimits& limits) {
  return JsonReader(text, limits, nullptr).read();
}

Result<JsonTree> read_json_object_tree(std::string_view text, const JsonLimits& limits, const JsonElements* elements) {
  Result<JsonTree> tree = JsonReader(text, limits, elements).read();
  if (!tree || tree->root().kind() == JsonKind::object) return tree;
  return Error{ErrorCode::malformed, "", std::string("must be an object, not ") + kind_name(tree->root().kind())};
}

}  // namespace semblante
