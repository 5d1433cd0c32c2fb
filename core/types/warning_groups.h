#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace semblante {

/// Collects the warnings about one file or head, and states equal ones once. Two warnings are equal if they differ only
/// in what they name: text in 'quotes', numbers, ids of points (2.1) and JSON pointers (/meshes/0).
///
/// Memory is bounded by the number of groups: of each group the first two warnings are kept, and the names in the next
/// few.
class WarningGroups {
 public:
  static constexpr std::size_t no_limit = static_cast<std::size_t>(-1);

  explicit WarningGroups(std::size_t max_groups = no_limit) : max_groups_(max_groups) {}

  void add(std::string warning);

  /// In the order of the first of each group. One or two equal warnings as they are; more of them as
  /// "22 times: image 0 is empty; likewise 1, 2, 3, 4, ...". Last the number of warnings beyond the limit, if any.
  [[nodiscard]] std::vector<std::string> sentences() const;

 private:
  struct Group {
    std::size_t count = 0;
    std::string first, second;
    std::vector<std::string> names;  ///< in the warnings after the first, at most `shown_names`
  };
  static constexpr std::size_t shown_names = 4;

  std::size_t max_groups_;
  std::vector<Group> groups_;
  std::map<std::string, std::size_t> group_of_;  ///< by what the warnings of a group have in common
  std::size_t beyond_ = 0;
};

/// The same for a finished list.
std::vector<std::string> grouped_warnings(const std::vector<std::string>& warnings);

}  // namespace semblante
