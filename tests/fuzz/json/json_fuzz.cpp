#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/json/json_cursor.h"
#include "core/json/read_json.h"

using namespace semblante;
using nlohmann::json;

namespace {

constexpr JsonLimits limits{.max_depth = 200, .max_values = 500};

void expect(bool fact) {
  if (!fact) std::abort();
}

/// What the limits and the rule of unique names refuse of a text that is JSON.
class Census final : public nlohmann::json_sax<json> {
 public:
  std::size_t values = 0;
  std::size_t depth = 0;
  bool has_duplicates = false;

  bool null() override { return count(); }
  bool boolean(bool) override { return count(); }
  bool number_integer(number_integer_t) override { return count(); }
  bool number_unsigned(number_unsigned_t) override { return count(); }
  bool number_float(number_float_t, const string_t&) override { return count(); }
  bool string(string_t&) override { return count(); }
  bool binary(binary_t&) override { return count(); }
  bool start_object(std::size_t) override { return open(); }
  bool key(string_t& name) override {
    has_duplicates |= !names_.back().insert(name).second;
    return true;
  }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(); }
  bool end_array() override { return close(); }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

 private:
  bool count() {
    ++values;
    return true;
  }
  bool open() {
    names_.emplace_back();
    depth = std::max(depth, names_.size());
    return count();
  }
  bool close() {
    names_.pop_back();
    return true;
  }

  std::vector<std::set<std::string>> names_;
};

void expect_equal(const JsonView& value, const json& expected) {
  const JsonView other = json_view(expected);
  expect(value.kind() == other.kind());
  switch (value.kind()) {
    case JsonKind::boolean:
      expect(value.natural() == other.natural());
      break;
    case JsonKind::natural:
      expect(value.natural() == other.natural());
      expect(value.number() == other.number());
      break;
    case JsonKind::negative:
      expect(value.negative() == other.negative());
      expect(value.number() == other.number());
      break;
    case JsonKind::real:
      expect(std::bit_cast<std::uint64_t>(value.number()) == std::bit_cast<std::uint64_t>(other.number()));
      break;
    case JsonKind::text:
      expect(value.text() == other.text());
      break;
    case JsonKind::array:
      expect(value.size() == expected.size());
      for (std::size_t i = 0; i < value.size(); ++i) expect_equal(value.element(i), expected[i]);
      break;
    case JsonKind::object: {
      expect(value.size() == expected.size());
      auto next = expected.begin();
      value.members([&](std::string_view name, const JsonView& member) {
        expect(name == next.key() && value.member(name).has_value());
        expect_equal(member, *next);
        ++next;
      });
      expect(value.member("no such name").has_value() == expected.contains("no such name"));
      break;
    }
    default:
      break;
  }
}

/// Elements that are handed over are those of the whole document, and the rest of it is the same.
void expect_elements(std::string_view text, json document) {
  for (const std::string& name : {std::string("a"), document.empty() ? std::string() : document.begin().key()}) {
    json whole = document;
    const json list = whole.contains(name) && whole[name].is_array() ? whole[name] : json::array();
    std::size_t taken = 0;
    const JsonElements elements{name, [&](std::size_t index, const JsonView& element) -> Status {
                                  expect(index == taken && index < list.size());
                                  expect_equal(element, list[index]);
                                  ++taken;
                                  return Unit{};
                                }};
    const auto tree = read_json_object_tree(text, limits, &elements);
    expect(tree.ok() && taken == list.size());
    if (taken > 0) whole[name] = json::array();
    expect_equal(tree->root(), whole);
  }
}

}  // namespace

/// Beside nlohmann's parser. Differences by intent: duplicate names, the limits, and a NUL byte, which ends the text
/// for nlohmann.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto tree = read_json_tree(text, limits);
  const json document = json::parse(text, nullptr, false);
  if (document.is_discarded() || text.find('\0') != std::string_view::npos) {
    expect(!tree);
    return 0;
  }
  Census census;
  expect(json::sax_parse(text, &census));
  const bool is_large = census.depth > limits.max_depth || census.values > limits.max_values;
  if (is_large || census.has_duplicates) {
    expect(!tree && ((is_large && tree.error().code == ErrorCode::too_large) ||
                     (census.has_duplicates && tree.error().code == ErrorCode::malformed)));
    return 0;
  }
  expect(tree.ok());
  expect_equal(tree->root(), document);
  const auto same = read_json(text, limits);
  expect(same.ok() && *same == document);
  if (document.is_object()) expect_elements(text, document);
  return 0;
}
