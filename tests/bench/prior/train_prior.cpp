// semblante-train-prior SOURCE_DIR [MODEL POINTS]...: trains the prior of smooth weights, writes the table of core and
// those that the tests use, each without what it is measured on, and prints what they do.

#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>

#include "tests/bench/prior/prior_training.h"
#include "tests/bench/weights/smooth_shares.h"
#include "tests/oracle/real_heads.h"

namespace semblante::bench {
namespace {

using Entries = std::vector<WeightPrior::Entry>;

void write(const std::string& path, const std::string& about, const Entries& entries) {
  std::ofstream file(path, std::ios::binary);
  file << "// Written by semblante-train-prior (tests/bench/prior). " << about << "\n// {i, j, k, c in hundredths}\n";
  std::size_t on_line = 0;
  for (const WeightPrior::Entry& e : entries) {
    file << '{' << int{e.i} << ", " << int{e.j} << ", " << int{e.k} << ", " << e.hundredths << "},"
         << (++on_line % 6 == 0 ? '\n' : ' ');
  }
  file << '\n';
  file.close();
  if (!file) throw std::runtime_error("cannot write " + path);
}

void print(const char* head, const char* prior, const ExpressionStudy& study, const WeightPrior& table) {
  const Figures f = measure(study, smooth_shares(study, table));
  std::printf("%-12s %-34s %6.3f %8.3f %8.4f %5zu\n", head, prior, f.error, f.visible_error, f.roughness,
              f.max_influences);
  std::fflush(stdout);
}

constexpr std::uint32_t people = 3;

void run(const std::string& source, std::span<char* const> more) {
  const auto faces = oracle::faces_folder();
  if (!faces) throw std::runtime_error("no folder of real heads: set SEMBLANTE_FACES_DIR");
  const auto ict = [&](const auto& wanted) {
    std::vector<TrainingHead> heads;
    for (std::uint32_t person = 0; person < people; ++person) {
      heads.push_back({"ict-facekit", read_ict_shapes(*faces / "ict-facekit", person, wanted), 1.0 / people});
    }
    return heads;
  };
  std::vector<TrainingHead> others;
  others.push_back(
      {"makehuman", read_target_study(*faces / "makehuman/head.glb", *faces / "makehuman/makehuman.fps.json"), 1.0});
  const std::vector<TrainingHead> makehuman = others;
  for (std::size_t k = 0; k + 1 < more.size(); k += 2) {
    others.push_back({more[k], read_target_study(more[k], more[k + 1]), 1.0});
  }
  const auto joined = [](std::vector<TrainingHead> a, const std::vector<TrainingHead>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  };
  const std::vector<TrainingHead> ict_all = ict([](const std::string&) { return true; });
  const std::vector<TrainingHead> ict_unmeasured = ict([](const std::string& name) { return !is_measured(name); });
  const ExpressionStudy measured = read_expression_study(*faces / "ict-facekit");

  std::printf("%-12s %-34s %6s %8s %8s %5s\n", "head", "prior", "E", "visible", "rough", "max");
  print("ict-facekit", "none", measured, {});
  print("makehuman", "none", makehuman[0].study, {});
  const std::string tests = source + "/tests/golden/parametrize/";
  const Entries without_makehuman = train_prior(ict_all);
  print("makehuman", "of ict-facekit", makehuman[0].study, WeightPrior(without_makehuman));
  write(tests + "prior_without_makehuman.inc", "Of ict-facekit alone.", without_makehuman);
  const Entries without_ict = train_prior(makehuman);
  print("ict-facekit", "of makehuman", measured, WeightPrior(without_ict));
  write(tests + "prior_without_ict.inc", "Of makehuman alone.", without_ict);
  const Entries without_measured = train_prior(ict_unmeasured);
  print("ict-facekit", "of its other shapes", measured, WeightPrior(without_measured));
  write(tests + "prior_without_measured.inc", "Of the shapes of ict-facekit that are not measured.", without_measured);
  const Entries all = train_prior(joined(ict_all, others));
  print("ict-facekit", "of all", measured, WeightPrior(all));
  print("makehuman", "of all", makehuman[0].study, WeightPrior(all));
  write(source + "/core/parametrize/weight_prior_table.inc", "Of all heads.", all);
}

}  // namespace
}  // namespace semblante::bench

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fputs("usage: semblante-train-prior SOURCE_DIR [MODEL POINTS]...\n", stderr);
    return 2;
  }
  try {
    semblante::bench::run(argv[1], std::span(argv + 2, static_cast<std::size_t>(argc) - 2));
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "semblante-train-prior: %s\n", fault.what());
    return 1;
  }
  return 0;
}
