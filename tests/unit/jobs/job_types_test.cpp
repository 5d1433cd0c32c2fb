// Each type of job through each of its forms in JSON. The types are those of the variant: one that is added is tested
// with its default values, and with the values of an example where there is one here.
#include <concepts>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "server/jobs/worker_protocol.h"
#include "server/store/frame_json.h"
#include "server/store/record_json.h"

namespace semblante::jobs {
namespace {

using nlohmann::json;

template <class T>
T example() {
  return {};
}

const ModelFrame frame{{Direction::plus_z, Direction::minus_y}, true, LengthUnit::inch, false, {"a reason"}};
const store::Turn turn{1, 0, 0, 0, 0, 1, 0, -1, 0};
const std::vector<store::FeaturePointRecord> points = {
    {"2.1", 7, std::nullopt},
    {"7.1", std::nullopt, {{1.5, -2.0, 0.1}}, store::ProposalRecord{"mirror", "low", 0.25, "r"}}};
const std::vector<store::PartRecord> parts = {{"face", "skin", true, 8, 4, {0, 0, 0}, {1, 1, 0.1}, 3}};
const MarkedSource head{
    {"/a b/\"c\"", "a.obj", frame, {LengthUnit::inch, Direction::plus_z, std::nullopt}}, points, parts};
const std::vector<Displacement> displacements = {{*parse_feature_point("2.1"), {0.1F, -3.0F, 1e-7F}},
                                                 {*parse_feature_point("10.1"), {0.0F, 1024.0F, 0.0F}}};

template <>
ParametrizeJob example() {
  return {"unfolded", "smooth", 9, {10000, 5000}, "own", 2.5};
}
template <>
ExtractJob example() {
  return {"Grin", "viseme", true, 2.5, 0.5, "t", "f", "smile.obj", "eee", "head.obj", "ddd", points};
}
template <>
ImportJob::Request example() {
  return {head.model};
}
template <>
ParametrizeJob::Request example() {
  return {"Ana", head, example<ParametrizeJob>(), {{"joy", SetKind::expression, displacements}}};
}
template <>
ProposeJob::Request example() {
  return {head};
}
template <>
ExtractJob::Request example() {
  return {head, example<ExtractJob>(), "/expression"};
}
template <>
ImportJob::Outcome example() {
  return {"obj", 8, 4, {-1, 0, 0.1}, {1, 2, 3}, parts, {"careful"}, {1, 2, 3}, frame, turn, {{"smile", 5}}, 7};
}
template <>
ParametrizeJob::Outcome example() {
  return {parts, {"careful"}, {1, 2, 3}, {frame, turn, {-1, 0, 0.1}, {1, 2, 3}}, {{26719, 52220}, {9998, 17000}}};
}
template <>
ProposeJob::Outcome example() {
  return {points, {{"6.2", "no tongue"}}};
}
template <>
ExtractJob::Outcome example() {
  const auto id = [](const char* text) { return *parse_feature_point(text); };
  return {{displacements,
           {{id("9.1"), FapuUnit::ens}, {id("10.2"), FapuUnit::mw}},
           {id("3.1")},
           {id("7.1")},
           {id("6.1"), id("6.2")},
           RemovedMotion{12.5, 0.1}}};
}

/// Calls `check` with a default value and the example of each alternative.
template <class Variant, std::size_t index = 0, class Check>
void for_each(Check check) {
  if constexpr (index < std::variant_size_v<Variant>) {
    using T = std::variant_alternative_t<index, Variant>;
    SCOPED_TRACE(job_kinds[index].name);
    check(T{});
    check(example<T>());
    for_each<Variant, index + 1>(check);
  }
}

template <class T>
void expect_same(const T& back, const T& value) {
  EXPECT_EQ(json(back), json(value));
  if constexpr (std::equality_comparable<T>) {
    EXPECT_EQ(back, value);
  }
}

/// Each member that is written is read: without it there is a fault or another value.
template <class T>
void expect_every_member_read(const T& value) {
  const json whole = value;
  for (const auto& [name, member] : whole.items()) {
    json less = whole;
    less.erase(name);
    try {
      EXPECT_NE(json(less.get<T>()), whole) << name << " is not read";
    } catch (const json::exception&) {
    }
  }
}

/// No text in it is a JSON document of its own.
void expect_no_json_in_texts(const json& value) {
  if (value.is_structured()) {
    for (const auto& item : value) expect_no_json_in_texts(item);
  } else if (value.is_string()) {
    const auto inner = json::parse(value.get<std::string>(), nullptr, false);
    EXPECT_FALSE(inner.is_structured()) << value;
  }
}

TEST(JobTypes, Kinds_HaveNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < job_kinds.size(); ++i) {
    EXPECT_TRUE(names.insert(job_kinds[i].name).second) << job_kinds[i].name;
    EXPECT_EQ(find_job_kind(job_kinds[i].name), i);
  }
  EXPECT_EQ(job_kinds.size(), std::variant_size_v<Job>);
  EXPECT_FALSE(find_job_kind("absent"));
}

TEST(JobTypes, StoredJob_ComesBackAsItWas) {
  for_each<Job>([](const auto& job) {
    using T = std::remove_cvref_t<decltype(job)>;
    const auto record = new_record(job, "m");
    EXPECT_EQ(record.kind, T::kind_name);
    EXPECT_EQ(record.model, "m");
    EXPECT_EQ(record.state, store::JobState::queued);
    const auto back = read_job_as<T>(record);
    ASSERT_TRUE(back) << record.request;
    expect_same(*back, job);
    expect_every_member_read(job);
    expect_no_json_in_texts(json(job));
  });
}

TEST(JobTypes, StoredJobOfAnotherForm_IsAnError) {
  auto record = new_record(example<ParametrizeJob>(), "m");
  record.kind = "absent";
  EXPECT_EQ(read_job(record).error().code, ErrorCode::internal);
  record.kind = ParametrizeJob::kind_name;
  for (const auto* request : {"", "[]", "{}", R"({"metric":1})"}) {
    record.request = request;
    EXPECT_EQ(read_job(record).error().code, ErrorCode::internal) << request;
  }
}

TEST(JobTypes, WorkerRequest_ComesBackAsItWas) {
  for_each<JobRequest>([](const auto& request) {
    using T = std::remove_cvref_t<decltype(request)>;
    const auto back = worker_request_from_json(to_json(WorkerRequest{"/out", request}));
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->output_directory, "/out");
    ASSERT_TRUE(std::holds_alternative<T>(back->job));
    expect_same(std::get<T>(back->job), request);
    expect_every_member_read(request);
    expect_no_json_in_texts(json(request));
  });
}

TEST(JobTypes, WorkerResult_ComesBackAsItWas) {
  for_each<JobOutcome>([](const auto& outcome) {
    using T = std::remove_cvref_t<decltype(outcome)>;
    const std::vector<store::ArtefactRecord> artefacts = {{"mesh.drc", "", 0, "application/octet-stream"}};
    const auto line = worker_line_from_json(to_json_line(WorkerResult{outcome, artefacts}));
    ASSERT_TRUE(line) << line.error().message;
    const auto* const back = std::get_if<WorkerResult>(&*line);
    ASSERT_NE(back, nullptr);
    EXPECT_EQ(back->artefacts, artefacts);
    ASSERT_TRUE(std::holds_alternative<T>(back->outcome));
    expect_same(std::get<T>(back->outcome), outcome);
    expect_every_member_read(outcome);
    expect_no_json_in_texts(json(outcome));
  });
}

TEST(JobTypes, RemovedMotionAndSkippedPoints_KeepTheirValuesAndOrder) {
  const auto line = *worker_line_from_json(to_json_line(WorkerResult{example<ExtractJob::Outcome>(), {}}));
  const Extraction& extraction = std::get<ExtractJob::Outcome>(std::get<WorkerResult>(line).outcome).extraction;
  ASSERT_EQ(extraction.displacements.size(), 2U);
  EXPECT_EQ(extraction.displacements[0].value, displacements[0].value);
  EXPECT_EQ(to_string(extraction.displacements[1].point), "10.1");
  ASSERT_EQ(extraction.skipped.size(), 2U);
  EXPECT_EQ(to_string(extraction.skipped[0].point), "9.1");
  EXPECT_EQ(extraction.skipped[0].unit, FapuUnit::ens);
  EXPECT_EQ(extraction.removed->degrees, 12.5);
}

TEST(WorkerProtocol, ProgressAndProblem_ComeBackAsTheyWere) {
  const auto progress = std::get<WorkerProgress>(*worker_line_from_json(to_json_line(WorkerProgress{0.25, "rig"})));
  EXPECT_EQ(progress.progress, 0.25);
  EXPECT_EQ(progress.stage, "rig");
  const auto problem =
      std::get<http::Problem>(*worker_line_from_json(to_json_line(http::make_problem("worker-limit", "too long"))));
  EXPECT_EQ(problem.slug, "worker-limit");
  EXPECT_EQ(problem.detail, "too long");
  EXPECT_EQ(problem.advice, Advice::reduce_model);
}

/// nlohmann's own conversion of these is undefined, and the program may do anything.
TEST(WorkerProtocol, NumbersThatTheMemberHasNot_AreRefused) {
  const auto with = [](std::string text, const std::string& member, const std::string& number) {
    const auto at = text.find('"' + member + "\":") + member.size() + 3;
    return text.replace(at, text.find_first_of(",}]", at) - at, number);
  };
  const auto line = to_json_line(WorkerResult{example<ImportJob::Outcome>(), {}});
  for (const char* member : {"vertices", "triangles", "part_count", "errors", "index"}) {
    EXPECT_TRUE(worker_line_from_json(with(line, member, "4294967295"))) << member;
    for (const char* number : {"4294967296", "1e40", "-1.5", "-1", "2.5", "null", "\"7\""})
      EXPECT_FALSE(worker_line_from_json(with(line, member, number))) << member << number;
  }
  const auto request = to_json(WorkerRequest{"/out", example<ParametrizeJob::Request>()});
  for (const char* number : {"2147483648", "1e40", "-1.5"})
    EXPECT_FALSE(worker_request_from_json(with(request, "weight_bits", number))) << number;
  for (const char* number : {"[4294967296", "[1e40", "[-1"})
    EXPECT_FALSE(worker_request_from_json(with(request, "lods", number))) << number;
}

TEST(WorkerProtocol, BrokenLines_AreRefused) {
  for (const auto* line : {"", "x", "[]", "{}", R"({"progress":"half","stage":""})", R"({"done":{}})", R"({"done":7})",
                           R"({"done":{"kind":"absent","artefacts":[],"outcome":{}}})",
                           R"({"done":{"kind":"import","artefacts":[],"outcome":7}})"})
    EXPECT_FALSE(worker_line_from_json(line)) << line;
  for (const auto* request :
       {"", "{}", R"({"kind":"import"})", R"({"kind":"import","output_directory":"","request":{}})"})
    EXPECT_FALSE(worker_request_from_json(request)) << request;
}

TEST(WorkerProtocol, ExtractionOfWhatIsNotThere_IsRefused) {
  const json good = example<ExtractJob::Outcome>();
  const auto line = [](const json& outcome) {
    return json{{"done", {{"kind", "extract"}, {"artefacts", json::array()}, {"outcome", outcome}}}}.dump();
  };
  ASSERT_TRUE(worker_line_from_json(line(good)));
  for (const auto& [pointer, value] : {std::pair<const char*, json>{"/skipped", {{"2.1", "miles"}}},
                                       {"/skipped", {{"99.9", "ES"}}},
                                       {"/at_rest", {"99.9"}},
                                       {"/at_rest/0", 7},
                                       {"/displacements", {{"99.9", {0, 1, 0}}}},
                                       {"/displacements", {{"2.1", {0, 1e9, 0}}}},
                                       {"/displacements", "{}"},
                                       {"/head_motion", 7}}) {
    json bad = good;
    bad[json::json_pointer(pointer)] = value;
    EXPECT_FALSE(worker_line_from_json(line(bad))) << pointer << " " << value;
  }
}

}  // namespace
}  // namespace semblante::jobs
