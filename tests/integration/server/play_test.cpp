// `semblante play` against a real server: two real processes.

#include <array>
#include <csignal>
#include <fcntl.h>
#include <spawn.h>
#include <thread>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <sys/wait.h>

#include "tests/integration/cli/program.h"
#include "tests/integration/server/test_client.h"

extern char** environ;

namespace semblante::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class Play : public ::testing::Test {
 protected:
  Outcome play(const std::string& file, std::vector<std::string> more) const {
    std::vector<std::string> arguments = {"play", file, "--server",
                                          "http://127.0.0.1:" + std::to_string(server_.port())};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_semblante(arguments);
  }
  json stream(const std::string& id) const {
    return json::parse(request(server_.port(), "GET", "/v1/streams/" + id).body, nullptr, false);
  }

  TemporaryFolder folder_;
  ServerProcess server_{folder_.path() / "data"};
  Workspace workspace_;
};

TEST_F(Play, EveryFormat_IsPlayedToItsEnd) {
  const auto performance = workspace_.write("hello.json", R"({"format":"semblante.performance","version":1,
    "duration":400,"cues":[{"time":0,"fap":"open_jaw","keys":[[0,0],[400,400]],"easing":"linear"}]})");
  const auto frames = workspace_.write(
      "frames.json",
      R"({"frames":[{"time":0,"faps":{"3":40}},{"time":200,"faps":{"3":400}},{"time":400,"faps":{"4":80}}]})");
  std::string mask;
  for (int fap = 1; fap <= 68; ++fap) mask += fap == 3 ? "1 " : "0 ";
  const auto fap = workspace_.write("one.fap", "2.1 one 25 2\n" + mask + "\n0 100\n" + mask + "\n1 200\n");
  double sequence = 0.0;
  for (const auto& file : {performance, frames, fap}) {
    const auto outcome = play(file, {"--stream", "hello", "--create"});
    EXPECT_EQ(outcome.exit_code, 0) << file << outcome.err;
    const auto now = stream("hello");
    EXPECT_GT(now.value("sequence", 0.0), sequence) << file;
    EXPECT_TRUE(now["playing"].is_null()) << "it ends with what it plays";
    sequence = now.value("sequence", 0.0);
  }
}

TEST_F(Play, WhatIsWrong_IsSaidInOneLine) {
  const auto good =
      workspace_.write("good.json", R"({"format":"semblante.performance","version":1,"idle":{"seed":1}})");
  const auto bad =
      workspace_.write("bad.json", R"({"format":"semblante.performance","version":1,"cues":[{"time":0,"fap":99}]})");
  const auto nowhere = play(good, {"--stream", "nowhere"});
  EXPECT_EQ(nowhere.exit_code, 2);
  EXPECT_THAT(nowhere.err, HasSubstr("there is no stream nowhere"));
  const auto pointer = play(bad, {"--stream", "s", "--create"});
  EXPECT_EQ(pointer.exit_code, 2);
  EXPECT_THAT(pointer.err, HasSubstr("/cues/0"));
  EXPECT_EQ(play(good, {"--stream", "../models"}).exit_code, 2);
  EXPECT_EQ(play("missing.json", {"--stream", "s"}).exit_code, 2);
  const auto dead = run_semblante({"play", good, "--server", "http://127.0.0.1:1", "--stream", "s"});
  EXPECT_NE(dead.exit_code, 0);
  EXPECT_THAT(dead.err, HasSubstr("127.0.0.1:1"));
  for (const auto* address :
       {"ftp://localhost", "localhost:8080", "http://", "http://a/b", "http://[::1", "http://a:x"})
    EXPECT_EQ(run_semblante({"play", good, "--server", address, "--stream", "s"}).exit_code, 2) << address;
  for (const auto* scheme : {"ftp://localhost", "javascript://a", "://a"})
    EXPECT_THAT(run_semblante({"play", good, "--server", scheme, "--stream", "s"}).err,
                HasSubstr("an address is http"));
  const auto shouted = "HTTP://127.0.0.1:" + std::to_string(server_.port());
  EXPECT_THAT(run_semblante({"play", good, "--server", shouted, "--stream", "nowhere"}).err,
              HasSubstr("there is no stream nowhere"));
}

TEST_F(Play, SignalsEndIt_AlsoWhileItWaitsForItsFile) {
  const auto pipe = workspace_.path("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const auto signal : {SIGTERM, SIGINT}) {
    const std::string program = SEMBLANTE_BINARY_DIR "/bin/semblante";
    std::array<const char*, 6> arguments = {program.c_str(), "play", pipe.c_str(), "--stream", "s", nullptr};
    pid_t child = -1;
    ASSERT_EQ(posix_spawn(&child, program.c_str(), nullptr, nullptr, const_cast<char**>(arguments.data()), environ), 0);
    // It opens the pipe, and waits for what is never written.
    const int end = ::open(pipe.c_str(), O_WRONLY);
    ::kill(child, signal);
    int status = 0;
    EXPECT_TRUE(testing::eventually([&] { return ::waitpid(child, &status, WNOHANG) == child; }));
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal);
    ::close(end);
  }
}

TEST_F(Play, TakesOverOnlyIfItIsTold_AndTheFirstSaysWhy) {
  const auto endless =
      workspace_.write("idle.json", R"({"format":"semblante.performance","version":1,"idle":{"seed":1}})");
  const auto brief = workspace_.write("brief.json", R"({"format":"semblante.performance","version":1,"duration":200,
    "cues":[{"time":0,"blink":"both","duration":200}]})");
  Outcome first;
  std::thread thread([&] { first = play(endless, {"--stream", "stage", "--create"}); });
  EXPECT_TRUE(testing::eventually([&] { return stream("stage").value("active_source", json()) == "performance"; }));
  const auto refused = play(brief, {"--stream", "stage"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--take-over"));
  const auto second = play(brief, {"--stream", "stage", "--take-over"});
  EXPECT_EQ(second.exit_code, 0) << second.err;
  thread.join();
  EXPECT_EQ(first.exit_code, 1);
  EXPECT_THAT(first.err, HasSubstr("another source took over"));
}

}  // namespace
}  // namespace semblante::test
