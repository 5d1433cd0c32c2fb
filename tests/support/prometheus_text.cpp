#include "tests/support/prometheus_text.h"

#include <cmath>
#include <limits>
#include <optional>
#include <regex>
#include <set>

namespace semblante::test {
namespace {

/// Reads one sample's line; nullopt when it is not by the letter.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {}

  std::optional<PrometheusSample> sample() {
    PrometheusSample sample;
    sample.name = name(true);
    if (sample.name.empty()) return std::nullopt;
    if (take('{')) {
      do {
        const auto label = name(false);
        if (label.empty() || !take('=') || !take('"')) return std::nullopt;
        const auto value = quoted();
        if (!value || !sample.labels.emplace(label, *value).second) return std::nullopt;
      } while (take(','));
      if (!take('}')) return std::nullopt;
    }
    if (!take(' ')) return std::nullopt;
    const auto number = parse_number();
    if (!number) return std::nullopt;
    sample.value = *number;
    return sample;
  }

 private:
  bool take(char c) {
    if (rest_.empty() || rest_.front() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }
  std::string name(bool colon) {
    std::size_t n = 0;
    while (n < rest_.size()) {
      const char c = rest_[n];
      const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || (colon && c == ':');
      if (!letter && !(n > 0 && c >= '0' && c <= '9')) break;
      ++n;
    }
    std::string text(rest_.substr(0, n));
    rest_.remove_prefix(n);
    return text;
  }
  std::optional<std::string> quoted() {
    std::string text;
    while (!rest_.empty()) {
      const char c = rest_.front();
      rest_.remove_prefix(1);
      if (c == '"') return text;
      if (c != '\\') {
        text.push_back(c);
        continue;
      }
      if (rest_.empty()) return std::nullopt;
      const char escaped = rest_.front();
      rest_.remove_prefix(1);
      if (escaped == 'n')
        text.push_back('\n');
      else if (escaped == '\\' || escaped == '"')
        text.push_back(escaped);
      else
        return std::nullopt;
    }
    return std::nullopt;
  }
  /// The rest of the line.
  std::optional<double> parse_number() const {
    const std::string text(rest_);
    if (text == "+Inf") return std::numeric_limits<double>::infinity();
    static const std::regex form("-?[0-9]+(\\.[0-9]+)?(e[+-]?[0-9]+)?");
    if (!std::regex_match(text, form)) return std::nullopt;
    return std::stod(text);
  }

  std::string_view rest_;
};

/// The family a sample belongs to.
std::string family_of(const std::map<std::string, PrometheusFamily>& families, const std::string& name) {
  if (families.contains(name)) return name;
  for (const std::string suffix : {"_bucket", "_sum", "_count"}) {
    if (name.size() <= suffix.size() || !name.ends_with(suffix)) continue;
    const auto base = name.substr(0, name.size() - suffix.size());
    const auto found = families.find(base);
    if (found != families.end() && found->second.type == "histogram") return base;
  }
  return {};
}

void check_histogram(const std::string& name, const PrometheusFamily& family, std::vector<std::string>& faults) {
  struct Series {
    double bound = -std::numeric_limits<double>::infinity(), below = 0.0;
    std::optional<double> sum, count;
    bool ended = false;
  };
  std::map<std::map<std::string, std::string>, Series> all;
  for (const auto& sample : family.samples) {
    auto labels = sample.labels;
    const auto le = labels.extract("le");
    auto& series = all[labels];
    if (sample.name == name + "_sum") {
      series.sum = sample.value;
    } else if (sample.name == name + "_count") {
      series.count = sample.value;
    } else if (le.empty()) {
      faults.push_back(name + ": a bucket without le");
    } else {
      const auto bound = LineReader("x " + le.mapped()).sample();
      if (!bound || !(bound->value > series.bound)) faults.push_back(name + ": le does not rise at " + le.mapped());
      if (sample.value < series.below) faults.push_back(name + ": buckets do not cumulate at le " + le.mapped());
      if (bound) series.bound = bound->value;
      series.below = sample.value;
      series.ended = le.mapped() == "+Inf";
    }
  }
  for (const auto& [labels, series] : all) {
    if (!series.ended) faults.push_back(name + ": the last bucket is not +Inf");
    if (!series.count || *series.count != series.below) faults.push_back(name + ": _count is not the last bucket");
    if (!series.sum) faults.push_back(name + ": no _sum");
  }
}

}  // namespace

double PrometheusText::value(const std::string& name, const std::map<std::string, std::string>& labels) const {
  const auto family = families.find(family_of(families, name));
  if (family == families.end()) return -1.0;
  for (const auto& sample : family->second.samples)
    if (sample.name == name && sample.labels == labels) return sample.value;
  return -1.0;
}

PrometheusText read_prometheus_text(std::string_view text) {
  PrometheusText read;
  auto& faults = read.faults;
  std::string current;
  std::set<std::pair<std::string, std::map<std::string, std::string>>> series;
  if (!text.empty() && text.back() != '\n') faults.emplace_back("the last line does not end");
  static const std::regex help_form("# HELP ([a-zA-Z_:][a-zA-Z0-9_:]*) (([^\\\\]|\\\\\\\\|\\\\n)+)");
  static const std::regex type_form("# TYPE ([a-zA-Z_:][a-zA-Z0-9_:]*) (counter|gauge|histogram)");
  for (std::size_t number = 1; !text.empty(); ++number) {
    const auto end = text.find('\n');
    const std::string line(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    const auto fault = [&](const std::string& what) {
      faults.push_back("line " + std::to_string(number) + ": " + what + ": " + line);
    };
    std::smatch match;
    if (std::regex_match(line, match, help_form)) {
      if (!current.empty() && read.families[current].type.empty()) fault("the family before has no TYPE");
      current = match[1];
      if (read.families.contains(current)) fault("a family twice");
      read.families[current].help = match[2];
    } else if (std::regex_match(line, match, type_form)) {
      auto& family = read.families[match[1]];
      if (match[1] != current || !family.type.empty() || !family.samples.empty()) fault("TYPE not right after HELP");
      family.type = match[2];
      if (current.ends_with("_total") != (family.type == "counter")) fault("_total is for counters");
    } else if (auto sample = LineReader(line).sample()) {
      const auto name = family_of(read.families, sample->name);
      if (name.empty() || name != current) {
        fault("a sample outside its family");
        continue;
      }
      auto& family = read.families[name];
      if (family.type == "histogram" && sample->name == name) fault("a histogram has no plain sample");
      if (family.type != "gauge" && sample->value < 0.0) fault("less than nothing was counted");
      if (family.type != "histogram" && sample->labels.contains("le")) fault("le is for histograms");
      if (!series.emplace(sample->name, sample->labels).second) fault("a series twice");
      family.samples.push_back(std::move(*sample));
    } else {
      fault("not by the letter");
    }
  }
  for (const auto& [name, family] : read.families)
    if (family.type == "histogram") check_histogram(name, family, faults);
  return read;
}

}  // namespace semblante::test
