#include "server/jobs/worker_process.h"

#include <csignal>
#include <cstdlib>
#include <optional>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "tests/support/wait.h"

namespace semblante::jobs {
namespace {

class WorkerProcessTest : public ::testing::Test {
 protected:
  WorkerProcessTest() {
    std::string name = (std::filesystem::temp_directory_path() / "semblante-worker-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    for (const int number : {SIGPIPE, SIGXFSZ}) std::signal(number, SIG_IGN);  // as in the server
  }
  ~WorkerProcessTest() override { std::filesystem::remove_all(folder_); }

  Result<WorkerExit> run(const std::string& script, Wish wish = Wish::go_on,
                         std::chrono::seconds limit = testing::patience, const std::string& input = "in") {
    return run_worker_process(
        {"/bin/sh", "-c", script}, input, folder_ / "errors", limit,
        [this](std::string_view line) { lines_.emplace_back(line); }, [wish] { return wish; });
  }

  std::filesystem::path folder_;
  std::vector<std::string> lines_;
};

TEST_F(WorkerProcessTest, Missing_CannotBeStarted) {
  EXPECT_FALSE(run_worker_process(
      {"/absent"}, "", folder_ / "errors", std::chrono::seconds(5), [](std::string_view) {},
      [] { return Wish::go_on; }));
}

/// No descriptor is free while it lives.
class NoDescriptors {
 public:
  NoDescriptors() {
    ::getrlimit(RLIMIT_NOFILE, &before_);
    const rlimit none{0, before_.rlim_max};
    ::setrlimit(RLIMIT_NOFILE, &none);
  }
  ~NoDescriptors() { ::setrlimit(RLIMIT_NOFILE, &before_); }
  NoDescriptors(const NoDescriptors&) = delete;
  NoDescriptors& operator=(const NoDescriptors&) = delete;

 private:
  rlimit before_{};
};

TEST_F(WorkerProcessTest, WithoutDescriptors_IsStartedOnceThereAreSome) {
  std::optional<NoDescriptors> none(std::in_place);
  int polls = 0;
  const auto exit = run_worker_process(
      {"/bin/sh", "-c", "exit 3"}, "", folder_ / "errors", testing::patience, [](std::string_view) {},
      [&] {
        if (++polls == 2) none.reset();
        return Wish::go_on;
      });
  ASSERT_TRUE(exit) << exit.error().message;
  EXPECT_EQ(exit->code, 3);
}

TEST_F(WorkerProcessTest, WithoutDescriptors_CanBeStopped_AndEndsAtTheLimit) {
  const NoDescriptors none;
  const auto stopped = run("exit 0", Wish::stop);
  ASSERT_TRUE(stopped);
  EXPECT_EQ(stopped->kind, WorkerExit::Kind::stopped);
  const auto late = run("exit 0", Wish::go_on, std::chrono::seconds(0));
  ASSERT_FALSE(late);
  EXPECT_NE(late.error().message.find("Too many open files"), std::string::npos) << late.error().message;
}

TEST_F(WorkerProcessTest, Lines_ComeWholeAndInOrder) {
  const auto exit = run("cat; printf '\\none\\ntw'; sleep 0.1; printf 'o\\nthree'; exit 3");
  ASSERT_TRUE(exit);
  EXPECT_EQ(exit->kind, WorkerExit::Kind::exited);
  EXPECT_EQ(exit->code, 3);
  EXPECT_EQ(lines_, (std::vector<std::string>{"in", "one", "two"})) << "what has no end is no line";
}

TEST_F(WorkerProcessTest, IsEndedBeforeItsServer_WhereMemoryEnds) {
  ASSERT_TRUE(run("cat; echo; cat /proc/self/oom_score_adj"));  // the input comes after all that is set from outside
  EXPECT_EQ(lines_, (std::vector<std::string>{"in", "1000"}));
}

TEST_F(WorkerProcessTest, LongInput_ArrivesWhole) {
  ASSERT_TRUE(run("wc -c", Wish::go_on, testing::patience, std::string(1 << 20, 'x')));
  EXPECT_EQ(std::atoi(lines_.at(0).c_str()), 1 << 20);
}

TEST_F(WorkerProcessTest, WorkerThatReadsNothing_DoesNotHang) {
  const auto exit = run("exit 0", Wish::go_on, testing::patience, std::string(1 << 20, 'x'));
  ASSERT_TRUE(exit);
  EXPECT_EQ(exit->kind, WorkerExit::Kind::exited);
}

TEST_F(WorkerProcessTest, Signal_IsNamed) {
  const auto exit = run("echo last words >&2; kill -SEGV $$");
  ASSERT_TRUE(exit);
  EXPECT_EQ(exit->kind, WorkerExit::Kind::signalled);
  EXPECT_EQ(exit->code, SIGSEGV);
  EXPECT_EQ(exit->last_words, "last words");
}

TEST_F(WorkerProcessTest, LimitOfAFilesSize_IsTheSignalThatTellsIt) {
  const auto exit = run("ulimit -f 1; exec head -c 100000 /dev/zero > '" + (folder_ / "large").string() + "'");
  ASSERT_TRUE(exit);
  EXPECT_EQ(exit->kind, WorkerExit::Kind::signalled);
  EXPECT_EQ(exit->code, SIGXFSZ);
}

TEST_F(WorkerProcessTest, CancelStopAndTime_EndIt) {
  EXPECT_EQ(run("exec sleep 30", Wish::cancel)->kind, WorkerExit::Kind::cancelled);
  EXPECT_EQ(run("trap '' TERM; while :; do sleep 0.1; done", Wish::cancel)->kind, WorkerExit::Kind::cancelled);
  EXPECT_EQ(run("exec sleep 30", Wish::stop)->kind, WorkerExit::Kind::stopped);
  EXPECT_EQ(run("exec sleep 30", Wish::go_on, std::chrono::seconds(0))->kind, WorkerExit::Kind::timed_out);
}

}  // namespace
}  // namespace semblante::jobs
