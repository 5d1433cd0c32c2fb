#include "core/doctor/openings.h"

namespace semblante {
namespace {

using Names = std::string_view;

constexpr Names lips_upper[] = {"2.2", "2.6", "2.7"};
constexpr Names lips_lower[] = {"2.3", "2.8", "2.9"};
constexpr Names lips_corners[] = {"2.4", "2.5"};
constexpr Names lips_upper_flesh[] = {"2.2", "2.6", "2.7", "8.1", "8.5", "8.6", "8.9", "8.10"};
constexpr Names lips_lower_flesh[] = {"2.3", "2.8", "2.9", "8.2", "8.7", "8.8"};

constexpr Names left_upper[] = {"3.1"};
constexpr Names left_lower[] = {"3.3"};
constexpr Names left_corners[] = {"3.7", "3.11"};
constexpr Names left_upper_flesh[] = {"3.1", "3.13"};
constexpr Names left_lower_flesh[] = {"3.3", "3.9"};

constexpr Names right_upper[] = {"3.2"};
constexpr Names right_lower[] = {"3.4"};
constexpr Names right_corners[] = {"3.8", "3.12"};
constexpr Names right_upper_flesh[] = {"3.2", "3.14"};
constexpr Names right_lower_flesh[] = {"3.4", "3.10"};

constexpr Opening all[] = {
    {"lips", lips_upper, lips_lower, lips_corners, lips_upper_flesh, lips_lower_flesh, true},
    {"left lids", left_upper, left_lower, left_corners, left_upper_flesh, left_lower_flesh, false},
    {"right lids", right_upper, right_lower, right_corners, right_upper_flesh, right_lower_flesh, false},
};

}  // namespace

std::span<const Opening> openings() { return all; }

}  // namespace semblante
