#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <map>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/geometric.hpp>

#include "core/propose/propose.h"
#include "core/propose/quick_set.h"
#include "tests/bench/propose/proposal_study.h"
#include "tests/oracle/real_heads.h"

// How far proposals are from points that people placed with care. See tests/bench/README.md.

namespace {

using namespace semblante;
using namespace semblante::bench;

void print_line(const std::string& name, std::vector<ProposalError> errors) {
  if (errors.empty()) return;
  std::printf("  %-24s %5zu   %6.1f   %6.1f   %6.1f\n", name.c_str(), errors.size(), 100 * share_within(errors, 0.5),
              100 * share_within(errors, 0.9), 100 * share_within(errors, 1.0));
}

void print_set(const std::vector<std::string_view>& set, std::span<const ProposalStudy> studies,
               std::map<std::string, std::vector<std::string>>& by_point) {
  std::printf("From %zu points, off the placed ones in %% of ES0; no head is measured against its own proportions\n",
              set.size());
  std::printf("  %-24s %5s   %6s   %6s   %6s\n", "", "", "median", "9 in 10", "worst");
  std::vector<ProposalError> all;
  for (const ProposalStudy& study : studies) {
    const std::vector<ProposalError> errors = errors_from(study, set);
    print_line(study.name, errors);
    std::vector<ProposalError> own;
    std::copy_if(errors.begin(), errors.end(), std::back_inserter(own),
                 [](const ProposalError& e) { return e.method != ProposalMethod::mirror; });
    print_line("  without mirror images", own);
    for (const Confidence placed : {Confidence::high, Confidence::medium, Confidence::low}) {
      std::vector<ProposalError> some;
      std::copy_if(errors.begin(), errors.end(), std::back_inserter(some),
                   [&](const ProposalError& e) { return e.placed == placed; });
      print_line("  placed: " + std::string(confidence_names[static_cast<std::size_t>(placed)]), some);
    }
    for (const ProposalError& e : errors) {
      std::array<char, 48> text{};
      std::snprintf(text.data(), text.size(), "%5.1f %-10s %-6s", 100 * e.error,
                    proposal_method_names[static_cast<std::size_t>(e.method)].data(),
                    confidence_names[static_cast<std::size_t>(e.confidence)].data());
      auto& line = by_point[to_string(e.id)];
      line.resize(studies.size());
      line[static_cast<std::size_t>(&study - studies.data())] = text.data();
    }
    all.insert(all.end(), errors.begin(), errors.end());
  }
  print_line("all", all);
}

/// From no marked points at all.
void print_by_shape(std::span<const ProposalStudy> studies) {
  std::printf(
      "\nFrom the shape alone, off the placed ones in %% of ES0: median, 9 in 10, worst; within the claimed radius, "
      "%%\n");
  for (const ProposalStudy& study : studies) {
    const auto proposals =
        propose_feature_points(study.surface, study.parts_from({}), {}, study.other_heads, {}, study.model.triangles);
    if (!proposals) {
      std::printf("  %-24s none\n", study.name.c_str());
      continue;
    }
    const std::vector<ProposalError> errors = errors_of(study, *proposals);
    print_line(study.name, errors);
    std::printf("  %-24s %5.1f\n", "  within", 100 * share_within_claim(errors));
  }
}

void print_random_sets(std::span<const ProposalStudy> studies) {
  constexpr int draws = 300;
  std::printf("\nFrom %d random sets of 15 to 40 points a head\n", draws);
  std::printf("  %-24s %5s   %6s   %6s   %6s   beyond 50 %%: high, medium, low confidence\n", "", "", "median",
              "9 in 10", "worst");
  for (const ProposalStudy& study : studies) {
    std::mt19937 random(1);
    std::vector<ProposalError> all;
    std::array<int, 3> absurd{};
    for (int draw = 0; draw < draws; ++draw) {
      const auto errors = errors_from(study, random_names(study, 15 + random() % 26, random));
      for (const ProposalError& e : errors) absurd[static_cast<std::size_t>(e.confidence)] += e.error > 0.5 ? 1 : 0;
      all.insert(all.end(), errors.begin(), errors.end());
    }
    for (const Confidence c : {Confidence::high, Confidence::medium, Confidence::low}) {
      std::vector<ProposalError> some;
      std::copy_if(all.begin(), all.end(), std::back_inserter(some),
                   [&](const ProposalError& e) { return e.confidence == c; });
      print_line(study.name + " " + std::string(confidence_names[static_cast<std::size_t>(c)]), some);
    }
    std::printf("  %-24s beyond 50 %%: %d, %d, %d\n", study.name.c_str(), absurd[0], absurd[1], absurd[2]);
  }
}

/// The errors from the quick set and from random sets of one head.
std::vector<ProposalError> errors_of_sets(const ProposalStudy& study) {
  std::vector<ProposalError> all = errors_from(study, {quick_set.begin(), quick_set.end()});
  std::mt19937 random(3);
  for (int draw = 0; draw < 40; ++draw) {
    const auto errors = errors_from(study, random_names(study, 15 + random() % 26, random));
    all.insert(all.end(), errors.begin(), errors.end());
  }
  return all;
}

/// Whether nine in ten proposals lie within the radius that they claim. The last column is the factor for all claims
/// that the OTHER heads give: with a calibrated claim it is about 1.
void print_calibration(std::span<const ProposalStudy> studies) {
  std::printf("\nWithin the claimed radius, %% of the proposals; no head is measured against its own proportions\n");
  std::printf("  %-24s %9s %9s   %6s %6s %6s   %s\n", "", "quick set", "random", "high", "medium", "low",
              "factor from the others");
  std::vector<std::vector<ProposalError>> of_heads;
  for (const ProposalStudy& study : studies) of_heads.push_back(errors_of_sets(study));
  std::vector<ProposalError> all;
  for (std::size_t head = 0; head <= studies.size(); ++head) {
    const bool is_sum = head == studies.size();
    const std::vector<ProposalError>& errors = is_sum ? all : of_heads[head];
    std::vector<ProposalError> others;
    for (std::size_t other = 0; other < of_heads.size(); ++other) {
      // The family of one head counts as one.
      if (!is_sum && studies[other].family == studies[head].family) continue;
      others.insert(others.end(), of_heads[other].begin(), of_heads[other].end());
    }
    const std::string name = is_sum ? "all" : studies[head].name;
    if (is_sum)
      std::printf("  %-24s %9s", name.c_str(), "");
    else
      std::printf("  %-24s %9.1f", name.c_str(),
                  100 * share_within_claim(errors_from(studies[head], {quick_set.begin(), quick_set.end()})));
    std::printf(" %9.1f  ", 100 * share_within_claim(errors));
    for (const Confidence c : {Confidence::high, Confidence::medium, Confidence::low}) {
      std::vector<ProposalError> some;
      std::copy_if(errors.begin(), errors.end(), std::back_inserter(some),
                   [&](const ProposalError& e) { return e.confidence == c; });
      std::printf(" %6.1f", 100 * share_within_claim(some));
    }
    std::printf("   %.2f\n", factor_for_nine_in_ten(others));
    if (!is_sum) all.insert(all.end(), errors.begin(), errors.end());
  }
}

void print_time(const ProposalStudy& study) {
  double best = 1e9;
  const FeaturePointSet known = some_points(study, {quick_set.begin(), quick_set.end()});
  for (int i = 0; i < 5; ++i) {
    const auto start = std::chrono::steady_clock::now();
    (void)propose_feature_points(study.surface, study.parts_from(known), known, study.other_heads);
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::printf("  %-24s %zu vertices: %.3f s, roles of parts included\n", study.name.c_str(),
              study.surface.vertex_count(), best);
}

}  // namespace

int main(int argc, char** argv) {
  const auto faces = oracle::faces_folder();
  if (!faces) {
    std::printf("no folder of real heads: set SEMBLANTE_FACES_DIR\n");
    return 1;
  }
  const std::vector<ProposalStudy> studies = read_proposal_studies(*faces);
  std::map<std::string, std::vector<std::string>> by_point;
  std::vector<std::string_view> set;
  bool points = false;
  for (const std::string_view word : std::span(argv + 1, argv + argc)) {
    if (word == "--points")
      points = true;
    else
      set.push_back(word);
  }
  const bool quick = set.empty();
  if (quick) set.assign(quick_set.begin(), quick_set.end());
  print_set(set, studies, by_point);
  if (quick) {
    print_random_sets(studies);
    std::vector<ProposalStudy> heads = make_sample_studies();
    heads.insert(heads.begin(), studies.begin(), studies.end());
    print_by_shape(heads);
    print_calibration(heads);
    std::printf("\nTime\n");
    for (const ProposalStudy& study : studies) print_time(study);
  }
  if (points) {
    std::printf("\nPoint by point\n  %-6s", "");
    for (const ProposalStudy& study : studies) std::printf(" %-24s", study.name.c_str());
    std::printf("\n");
    for (std::size_t i = 0; i < feature_point_count; ++i) {
      const auto line = by_point.find(to_string(FeaturePointId(static_cast<std::uint8_t>(i))));
      if (line == by_point.end()) continue;
      std::printf("  %-6s", line->first.c_str());
      for (const std::string& text : line->second) std::printf(" %-24s", text.c_str());
      std::printf("\n");
    }
  }
  return 0;
}
