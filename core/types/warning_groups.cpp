#include "core/types/warning_groups.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "core/types/decimal.h"

namespace semblante {
namespace {

struct Reading {
  std::string common;  ///< the warning with its names left out
  std::string names;   ///< these, separated by blanks
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The length of the name at the beginning of `rest`, which is at the beginning of a word; 0 if there is none.
std::size_t length_of_name(std::string_view rest) {
  if (rest.front() == '\'') {
    const std::size_t end = rest.find('\'', 1);
    return end == std::string_view::npos ? 0 : end + 1;
  }
  if (rest.front() == '/') return std::min(rest.find(' '), rest.size());
  std::size_t size = 0;
  while (size < rest.size() && (is_digit(rest[size]) || (size > 0 && rest[size] == '.'))) ++size;
  if (size > 0 && rest[size - 1] == '.') --size;  // the end of a sentence
  return size;
}

Reading read(std::string_view warning) {
  Reading reading;
  bool begins_word = true;
  while (!warning.empty()) {
    const std::size_t size = begins_word ? length_of_name(warning) : 0;
    if (size > 0) {
      reading.names.append(reading.names.empty() ? "" : " ").append(warning.substr(0, size));
      reading.common += '\'';
      warning.remove_prefix(size);
      begins_word = false;
      continue;
    }
    begins_word = warning.front() == ' ' || warning.front() == '(';
    reading.common += warning.front();
    warning.remove_prefix(1);
  }
  return reading;
}

}  // namespace

void WarningGroups::add(std::string warning) {
  Reading reading = read(warning);
  const auto known = group_of_.find(reading.common);
  if (known == group_of_.end()) {
    if (groups_.size() >= max_groups_) {
      ++beyond_;
      return;
    }
    group_of_.emplace(std::move(reading.common), groups_.size());
    groups_.push_back({1, std::move(warning), {}, {}});
    return;
  }
  Group& group = groups_[known->second];
  if (++group.count == 2) group.second = std::move(warning);
  if (group.names.size() < shown_names && !reading.names.empty()) group.names.push_back(std::move(reading.names));
}

std::vector<std::string> WarningGroups::sentences() const {
  std::vector<std::string> sentences;
  for (const Group& group : groups_) {
    if (group.count <= 2) {
      sentences.push_back(group.first);
      if (group.count == 2) sentences.push_back(group.second);
      continue;
    }
    std::string sentence = natural_text(group.count) + " times: " + group.first;
    for (std::size_t i = 0; i < group.names.size(); ++i) sentence += (i == 0 ? "; likewise " : ", ") + group.names[i];
    if (!group.names.empty() && group.count > group.names.size() + 1) sentence += ", ...";
    sentences.push_back(std::move(sentence));
  }
  if (beyond_ > 0) sentences.push_back("and " + natural_text(beyond_) + " more warnings");
  return sentences;
}

std::vector<std::string> grouped_warnings(const std::vector<std::string>& warnings) {
  WarningGroups groups;
  for (const std::string& warning : warnings) groups.add(warning);
  return groups.sentences();
}

}  // namespace semblante
