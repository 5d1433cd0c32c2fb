// Jobs of every type and format in an isolated process: each call that they make to the system is allowed.
#include <cstdio>
#include <fstream>

#include <gtest/gtest.h>

#include "core/import/model_formats.h"
#include "core/parametrize/weight_method.h"
#include "server/jobs/input_files.h"
#include "server/jobs/job.h"
#include "server/jobs/result_files.h"
#include "tests/support/sample_shapes.h"
#include "tests/unit/import/test_files.h"
#include "tests/unit/jobs/isolated_process.h"

namespace semblante::jobs {
namespace {

class IsolatedJobs : public IsolationTest {
 protected:
  /// Runs the job as a worker does, after isolation.
  int run_isolated(const JobRequest& job) const {
    std::filesystem::remove(result());
    const InputFiles inputs(inputs_of(job));
    const int code = attempt([&] {
      ResultFiles files(folder().string());
      const auto outcome = run(job, inputs, files, {});
      if (!outcome) std::fprintf(stderr, "%s: %s\n", outcome.error().where.c_str(), outcome.error().message.c_str());
      return outcome ? possible : 1;
    });
    results_ = 0;
    for (const auto& file : std::filesystem::directory_iterator(folder())) {
      ++results_;
      std::filesystem::remove(file.path());
    }
    return code;
  }

  [[nodiscard]] ModelSource source(const std::vector<std::uint8_t>& bytes, std::string_view ending) const {
    const auto path = top_ / "model";
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    ModelSource model;
    model.path = path.string();
    model.file_name = "model" + std::string(ending);
    return model;
  }
  [[nodiscard]] MarkedSource avatar() const {
    MarkedSource head;
    head.model = source(semblante::testing::sample_avatar_glb(), ".glb");
    for (const auto& point : semblante::testing::sample_avatar().points)
      head.points.push_back({to_string(point.id), point.vertex,
                             std::array<double, 3>{point.position.x, point.position.y, point.position.z}});
    return head;
  }

  mutable int results_ = 0;  ///< files of the last job
};

std::string_view ending_of(ModelFormat format) {
  for (const auto& file : model_files)
    if (file.format == format) return file.ending;
  return {};
}

TEST_F(IsolatedJobs, Import_OfEveryFormat) {
  for (const auto& file : test::all_quads()) {
    EXPECT_EQ(run_isolated(ImportJob::Request{source(file.bytes, ending_of(file.format))}), possible) << file.name;
    EXPECT_EQ(results_, 3) << file.name << ": report, preview, positions";
  }
}

TEST_F(IsolatedJobs, Import_OfDamagedFiles_FailsAndIsNotKilled) {
  for (const auto& file : test::all_quads()) {
    auto bytes = file.bytes;
    bytes.resize(bytes.size() / 2);
    EXPECT_LE(run_isolated(ImportJob::Request{source(bytes, ending_of(file.format))}), 1) << file.name;
  }
}

TEST_F(IsolatedJobs, Parametrization_ByEveryMethod) {
  for (const std::string_view method : weight_method_names) {
    ParametrizeJob options;
    options.weights = std::string(method);
    if (method == "smooth") options.lods = {2000, 500};
    if (method == "fitted") options.expressions = "own";
    EXPECT_EQ(run_isolated(ParametrizeJob::Request{"Avatar", avatar(), options, {}}), possible) << method;
    EXPECT_GE(results_, 5) << method;
  }
}

TEST_F(IsolatedJobs, ProposalAndExtraction) {
  auto head = avatar();
  ExtractJob extract;
  extract.name = "smile";
  extract.target = "mouthSmileLeft";
  EXPECT_EQ(run_isolated(ExtractJob::Request{head, extract, {}}), possible);
  std::erase_if(head.points, [](const auto& point) { return point.id.starts_with("9."); });
  EXPECT_EQ(run_isolated(ProposeJob::Request{head}), possible);
}

}  // namespace
}  // namespace semblante::jobs
