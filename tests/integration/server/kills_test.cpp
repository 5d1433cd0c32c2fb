// SIGKILL at random moments under a mixed load: uploads and removals, edits of points, jobs, expressions, recordings.
// After each restart everything that was acknowledged is there, nothing half-made is served, and `semblante check`
// finds neither faults nor files without a record. SEMBLANTE_KILLS says how often (12 by default), SEMBLANTE_KILLS_SEED
// repeats the moments of another run.

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <functional>
#include <mutex>
#include <random>
#include <set>
#include <spawn.h>
#include <thread>
#include <unistd.h>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include "protocol/hash/sha256.h"
#include "tests/integration/cli/program.h"
#include "tests/integration/server/model_flow.h"

extern char** environ;

namespace semblante::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

unsigned long number_from(const char* variable, unsigned long otherwise) {
  const char* text = std::getenv(variable);
  return text != nullptr && *text != '\0' ? std::strtoul(text, nullptr, 10) : otherwise;
}

/// A value of which the last change may be unacknowledged: it is the old one or the new one.
struct Edited {
  int acknowledged = -1, asked = -1;  ///< -1: never set
  [[nodiscard]] bool may_be(int value) const { return value == acknowledged || value == asked; }
};

/// What the server has acknowledged, and what it was asked for and may have done.
struct Ledger {
  std::map<std::string, std::string> models;  ///< SHA-256 of the uploaded file by id
  std::set<std::string> removed_models, maybe_removed_models;
  std::set<std::string> packaged;     ///< models whose parametrization was seen to be done
  std::set<std::string> jobs;         ///< acknowledged, on models that stay
  std::set<std::string> extractions;  ///< acknowledged jobs whose sets were not removed
  Edited points;                      ///< vertex of the point 2.1 of `edited_model`
  std::string edited_model;
  std::map<std::string, Edited> sets;  ///< y of the point 2.1
  std::set<std::string> removed_sets, maybe_removed_sets;
  std::map<std::string, std::size_t> durable_frames;  ///< of recordings, as the server said
  std::map<std::string, std::size_t> stopped;         ///< frames of recordings whose stop was acknowledged
  std::set<std::string> removed_recordings, maybe_removed_recordings;
};

/// Counts for the report.
struct Tally {
  std::atomic<std::size_t> uploads{0}, removals{0}, edits{0}, jobs{0}, sets{0}, recordings{0}, stops{0};
};

class Kills : public ::testing::Test {
 protected:
  [[nodiscard]] fs::path data() const { return folder_.path() / "data"; }

  /// A request of the load. Status 0: the server was killed before it answered.
  Reply ask(const std::string& method, const std::string& target, const std::string& body = {},
            const Fields& fields = json_type) {
    try {
      auto reply = request(port_, method, target, body, fields);
      const auto length = reply.headers.find("content-length");
      if (reply.status != 0 && length != reply.headers.end() && std::to_string(reply.body.size()) != length->second)
        return {};
      return reply;
    } catch (const std::runtime_error&) {  // nobody listens any more
      return {};
    }
  }
  void change(const std::function<void(Ledger&)>& how) {
    const std::lock_guard lock(mutex_);
    how(ledger_);
  }
  Ledger ledger() {
    const std::lock_guard lock(mutex_);
    return ledger_;
  }

  void upload_and_remove() {
    std::mt19937 random(random_());
    while (!stop_) {
      const auto file = grid_obj(4 + static_cast<int>(random() % 30));
      const auto reply = ask("POST", "/v1/models?filename=grid.obj", file, obj_type);
      if (reply.status == 202) {
        const std::string id = json_of(reply)["model"]["id"];
        ++tally_.uploads;
        change([&](Ledger& l) { l.models[id] = sha256_hex(file); });
      }
      const auto models = ledger().models;
      if (models.size() > 8) remove_model(std::next(models.begin(), static_cast<int>(random() % models.size()))->first);
    }
  }
  void remove_model(const std::string& id) {
    if (id == ledger().edited_model) return;
    change([&](Ledger& l) {
      l.maybe_removed_models.insert(id);
      l.models.erase(id);
      l.packaged.erase(id);
    });
    if (ask("DELETE", "/v1/models/" + id).status != 204) return;
    ++tally_.removals;
    change([&](Ledger& l) {
      l.removed_models.insert(id);
      l.maybe_removed_models.erase(id);
    });
  }

  void edit_points() {
    const auto id = ledger().edited_model;
    while (!stop_) {
      int vertex = 0;
      change([&](Ledger& l) { vertex = l.points.asked = (l.points.asked + 1) % 81; });
      auto body = json::parse(grid_points());
      body["points"]["2.1"]["vertex"] = vertex;
      const auto reply = ask("PUT", "/v1/models/" + id + "/feature-points", body.dump());
      // Not answered: the server may have stored it before it was killed, so nothing else is asked for.
      if (reply.status == 0) return;
      if (reply.status != 200) continue;
      ++tally_.edits;
      change([&](Ledger& l) { l.points.acknowledged = vertex; });
    }
  }

  void run_jobs() {
    const auto id = ledger().edited_model;
    while (!stop_) {
      const auto reply = ask("POST", "/v1/models/" + id + "/parametrizations");
      if (reply.status != 202) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        continue;
      }
      const std::string job = json_of(reply)["id"];
      ++tally_.jobs;
      change([&](Ledger& l) { l.jobs.insert(job); });
      std::string state;
      while (!stop_ && state != "done" && state != "failed") {
        const auto now = json_of(ask("GET", "/v1/jobs/" + job));
        if (now.is_object()) state = now.value("state", "");
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      }
      if (state == "done") change([&](Ledger& l) { l.packaged.insert(id); });
    }
  }

  /// Sets taken from an example: the uploaded files are blobs of the job until it ends.
  void extract_sets() {
    // The corner 8.3 of the mouth is moved: vertex 33, at 2 3 0.
    auto smile = grid_obj(9);
    smile.replace(smile.find("v 2 3 0\n"), 8, "v 3 2.5 0\n");
    const std::string points =
        R"({"points":{"2.1":{"vertex":13},"2.2":{"vertex":40},"8.3":{"vertex":33},"8.4":{"vertex":29},"9.15":{"vertex":58}}})";
    const auto part = [](const std::string& name, const std::string& content) {
      const bool is_file = name != "feature_points";
      return "--border\r\nContent-Disposition: form-data; name=\"" + name + "\"" +
             (is_file ? "; filename=\"" + name + ".obj\"" : "") + "\r\n\r\n" + content + "\r\n";
    };
    while (!stop_) {
      // Every upload has files of its own.
      const auto remark = "# " + std::to_string(++extraction_) + "\n";
      const auto reply = ask("POST", "/v1/expressions",
                             part("neutral", remark + grid_obj(9)) + part("expression", remark + smile) +
                                 part("feature_points", points) + "--border--\r\n",
                             form_type);
      if (reply.status != 202) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        continue;
      }
      const std::string job = json_of(reply)["id"];
      ++tally_.jobs;
      change([&](Ledger& l) { l.extractions.insert(job); });
      auto now = json::object();
      while (!stop_ && now.value("state", "") != "done") {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        if (const auto read = json_of(ask("GET", "/v1/jobs/" + job)); read.is_object()) now = read;
      }
      if (stop_) return;
      // Removed again, so that their number stays below the limit of sets.
      change([&](Ledger& l) { l.extractions.erase(job); });
      ask("DELETE", now["result"]["href"]);
    }
  }

  void edit_sets() {
    for (int y = 1; !stop_; ++y) {
      const auto set = [&] { return json{{"name", "Set"}, {"displacements", {{"2.1", {0, y, 0}}}}}.dump(); };
      const auto made = ask("POST", "/v1/expressions", set());
      if (made.status != 201) continue;
      const std::string id = json_of(made)["id"];
      ++tally_.sets;
      change([&](Ledger& l) { l.sets[id] = {y, y}; });
      const Fields any_version = {{"Content-Type", "application/json"}, {"If-Match", made.headers.at("etag")}};
      change([&](Ledger& l) { l.sets[id].asked = y + 1; });
      ++y;
      const auto edited = ask("PUT", "/v1/expressions/" + id, set(), any_version);
      if (edited.status == 200) change([&](Ledger& l) { l.sets[id].acknowledged = y; });
      if (ledger().sets.size() <= 20) continue;
      const auto old = ledger().sets.begin()->first;
      change([&](Ledger& l) {
        l.maybe_removed_sets.insert(old);
        l.sets.erase(old);
      });
      if (ask("DELETE", "/v1/expressions/" + old).status == 204)
        change([&](Ledger& l) {
          l.removed_sets.insert(old);
          l.maybe_removed_sets.erase(old);
        });
    }
  }

  /// The n-th frame of each recording has the value 4 n.
  void record(const std::string& stream) {
    ask("POST", "/v1/streams", json{{"name", stream}}.dump());
    for (int round = 0; !stop_; ++round) {
      const auto reply = ask("POST", "/v1/streams/" + stream + "/recordings");
      if (reply.status != 201) continue;
      const std::string id = json_of(reply)["id"];
      const auto self = "/v1/recordings/" + id;
      ++tally_.recordings;
      change([&](Ledger& l) { l.durable_frames[id] = 0; });
      for (int i = 1; i <= 60 && !stop_; ++i) {
        ask("POST", "/v1/streams/" + stream + "/frames",
            R"({"frames":[{"faps":{"3":)" + std::to_string(4 * i) + "}}]}");
        if (i % 10 != 0) continue;
        const auto now = json_of(ask("GET", self));
        if (now.is_object()) change([&](Ledger& l) { l.durable_frames[id] = now.value("frames", std::size_t{0}); });
      }
      const auto stopped = ask("POST", self + "/stop");
      if (stopped.status != 200) continue;
      ++tally_.stops;
      change([&](Ledger& l) { l.stopped[id] = json_of(stopped)["frames"]; });
      if (round % 2 == 0) continue;
      change([&](Ledger& l) {
        l.maybe_removed_recordings.insert(id);
        l.durable_frames.erase(id);
        l.stopped.erase(id);
      });
      if (ask("DELETE", self).status == 204)
        change([&](Ledger& l) {
          l.removed_recordings.insert(id);
          l.maybe_removed_recordings.erase(id);
        });
    }
  }

  /// Loads the server until it is killed after so many ms.
  void load_and_kill(ServerProcess& server, unsigned long ms) {
    port_ = server.port();
    stop_ = false;
    std::vector<std::thread> threads;
    threads.emplace_back([this] { upload_and_remove(); });
    threads.emplace_back([this] { edit_points(); });
    threads.emplace_back([this] { run_jobs(); });
    threads.emplace_back([this] { edit_sets(); });
    threads.emplace_back([this] { extract_sets(); });
    threads.emplace_back([this] { record("one"); });
    threads.emplace_back([this] { record("two"); });
    std::this_thread::sleep_for(std::chrono::milliseconds(ms));
    ::kill(server.pid(), SIGKILL);
    stop_ = true;
    for (auto& thread : threads) thread.join();
    server.end(SIGKILL);
  }

  /// Starts a server and kills it after so many ms, before or soon after it is ready.
  void kill_a_start(unsigned long ms) const {
    const std::string program = SEMBLANTE_BINARY_DIR "/bin/semblante";
    std::vector<std::string> arguments = {program,  "serve",         "--port",      "0",
                                          "--data", data().string(), "--log-level", "error"};
    std::vector<char*> argv;
    for (auto& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    pid_t child = -1;
    posix_spawn_file_actions_t quiet;
    posix_spawn_file_actions_init(&quiet);
    posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    const int failed = posix_spawn(&child, program.c_str(), &quiet, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&quiet);
    ASSERT_EQ(failed, 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(ms));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
  }

  void wait_until_idle() {
    for (const auto& id : ledger_.jobs) {
      const auto job = wait_for_job(port_, id);
      if (job["state"] == "done") continue;
      // Three kills during one job are a reason to give up.
      EXPECT_EQ(job["problem"]["type"], "/problems/worker-crashed") << "the acknowledged job is lost: " << job;
    }
    ledger_.jobs.clear();
    for (const auto& id : ledger_.extractions) {
      const auto job = wait_for_job(port_, id);
      if (job["state"] == "done") {
        EXPECT_EQ(ask("GET", job["result"]["href"]).status, 200) << "the set of a job is lost";
      } else {
        EXPECT_EQ(job["problem"]["type"], "/problems/worker-crashed") << "the acknowledged job is lost: " << job;
      }
    }
    ledger_.extractions.clear();
    for (const auto& [id, hash] : ledger_.models) {
      const auto target = "/v1/models/" + id;
      EXPECT_TRUE(testing::eventually([&] { return json_of(ask("GET", target)).value("state", "") != "importing"; }));
    }
  }

  void expect_whole(const std::string& target) {
    const auto reply = ask("GET", target);
    EXPECT_EQ(reply.status, 200) << target << ": " << reply.body.substr(0, 300);
    if (reply.status != 200) return;
    EXPECT_EQ(reply.headers.at("etag"), "\"sha256-" + sha256_hex(reply.body) + "\"") << target;
  }

  void expect_models() {
    for (const auto& [id, hash] : ledger_.models) {
      const auto reply = ask("GET", "/v1/models/" + id);
      ASSERT_EQ(reply.status, 200) << "the acknowledged upload " << id << " is lost";
      const auto model = json_of(reply);
      EXPECT_EQ(model["source"]["sha256"], hash);
      const std::string state = model["state"];
      // The server gives an import up when it was killed during three attempts.
      if (state == "failed") {
        EXPECT_EQ(model["problem"]["type"], "/problems/worker-crashed") << model["problem"];
      } else {
        expect_whole("/v1/models/" + id + "/preview.glb");
        expect_whole("/v1/models/" + id + "/report.json");
      }
      if (ledger_.packaged.contains(id)) {
        EXPECT_EQ(state, "parametrized") << id;
      }
      if (state == "parametrized")
        for (const std::string name : {"mesh.drc", "weights", "rig.json", "face.glb"})
          expect_whole("/v1/models/" + id + "/" + name);
    }
    for (const auto& id : ledger_.removed_models)
      EXPECT_EQ(ask("GET", "/v1/models/" + id).status, 404) << "a removed model is back";
    ledger_.removed_models.clear();
    const auto points = json_of(ask("GET", "/v1/models/" + ledger_.edited_model + "/feature-points"));
    const int vertex = points["points"]["2.1"]["vertex"];
    EXPECT_TRUE(ledger_.points.may_be(vertex))
        << vertex << ", acknowledged " << ledger_.points.acknowledged << ", asked for " << ledger_.points.asked;
    ledger_.points = {vertex, vertex};
  }
  void expect_sets() {
    for (auto& [id, value] : ledger_.sets) {
      const auto reply = ask("GET", "/v1/expressions/" + id);
      ASSERT_EQ(reply.status, 200) << "the acknowledged set " << id << " is lost";
      const int y = json_of(reply)["displacements"]["2.1"][1];
      EXPECT_TRUE(value.may_be(y)) << y << ", acknowledged " << value.acknowledged << ", asked for " << value.asked;
      value = {y, y};
    }
    for (const auto& id : ledger_.removed_sets) EXPECT_EQ(ask("GET", "/v1/expressions/" + id).status, 404);
    ledger_.removed_sets.clear();
  }
  void expect_recordings() {
    for (auto& [id, durable] : ledger_.durable_frames) {
      const auto reply = ask("GET", "/v1/recordings/" + id);
      ASSERT_EQ(reply.status, 200) << "the acknowledged recording " << id << " is lost";
      const auto recording = json_of(reply);
      EXPECT_EQ(recording["state"], "finished") << recording;
      const std::size_t frames = recording["frames"];
      if (const auto stopped = ledger_.stopped.find(id); stopped != ledger_.stopped.end()) {
        EXPECT_EQ(frames, stopped->second) << "the stop was acknowledged";
      }
      EXPECT_GE(frames, durable) << "they were said to be durable";
      durable = frames;
      const auto list = json_of(ask("GET", "/v1/recordings/" + id + "/frames?limit=1000"))["frames"];
      ASSERT_EQ(list.size(), frames);
      // The value that the stream had before may be its first frame.
      for (std::size_t i = 1; i < list.size(); ++i)
        EXPECT_EQ(list[i]["faps"]["3"].get<int>() - list[i - 1]["faps"]["3"].get<int>(), 4) << id << " at " << i;
    }
    for (const auto& id : ledger_.removed_recordings) EXPECT_EQ(ask("GET", "/v1/recordings/" + id).status, 404);
    ledger_.removed_recordings.clear();
    // The number of those that are looked at each time stays the same.
    constexpr std::size_t most_kept = 30;
    while (ledger_.durable_frames.size() > most_kept) {
      const auto id = ledger_.durable_frames.begin()->first;
      EXPECT_EQ(ask("DELETE", "/v1/recordings/" + id).status, 204);
      ledger_.removed_recordings.insert(id);
      ledger_.durable_frames.erase(id);
      ledger_.stopped.erase(id);
    }
  }
  /// Neither faults nor files that the database does not know: a start moves these into the trash. A job whose request
  /// was stored and not acknowledged may still run, and its files become known with its end.
  void expect_check_finds_nothing() {
    json notes;
    const bool all_known = testing::eventually(
        [&] {
          const auto outcome = run_semblante({"check", "--json", "--data", data().string()});
          const auto report = json::parse(outcome.out, nullptr, false);
          EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
          if (HasFailure()) return true;
          notes = report["notes"];
          return notes.empty();
        },
        std::chrono::milliseconds(200));
    EXPECT_TRUE(all_known) << notes;
  }
  /// A server on the data folder that the kill left behind has everything.
  void expect_nothing_lost(ServerProcess& server) {
    port_ = server.port();
    wait_until_idle();
    expect_models();
    expect_sets();
    expect_recordings();
    expect_check_finds_nothing();
  }

  [[nodiscard]] std::size_t files_below(const std::string& folder) const {
    std::size_t count = 0;
    std::error_code error;
    for (const auto& entry : fs::recursive_directory_iterator(data() / folder, error))
      count += entry.is_regular_file() ? 1U : 0U;
    return count;
  }

  TemporaryFolder folder_;
  std::mt19937 random_{static_cast<unsigned>(number_from("SEMBLANTE_KILLS_SEED", 1))};
  std::atomic<bool> stop_ = false;
  int port_ = 0;
  std::mutex mutex_;
  Ledger ledger_;
  Tally tally_;
  std::atomic<int> extraction_{0};
};

TEST_F(Kills, AtAnyMoment_LoseNothingThatWasAcknowledged) {
  const auto kills = number_from("SEMBLANTE_KILLS", 12);
  const auto begin = std::chrono::steady_clock::now();
  unsigned long told = 0;
  auto server = std::make_unique<ServerProcess>(data());
  ledger_.edited_model = import_grid(server->port());
  ledger_.models[ledger_.edited_model] = sha256_hex(grid_obj(9));
  for (unsigned long kill = 0; kill < kills; ++kill) {
    SCOPED_TRACE("kill " + std::to_string(kill));
    load_and_kill(*server, 50 + random_() % 1500);
    // Some starts are killed too, while they put things right.
    while (random_() % 4 == 0) {
      kill_a_start(random_() % 300);
      ++kill;
    }
    server.reset();
    server = std::make_unique<ServerProcess>(data());
    expect_nothing_lost(*server);
    if (HasFailure()) return;
    if (kill / 20 != told) std::cout << (told = kill / 20) * 20 << " kills" << std::endl;
  }
  const auto took = std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now() - begin);
  std::cout << kills << " kills in " << took.count() << " s; acknowledged: " << tally_.uploads << " uploads, "
            << tally_.removals << " removals, " << tally_.edits << " edits of points, " << tally_.jobs << " jobs, "
            << tally_.sets << " expressions, " << tally_.recordings << " recordings, " << tally_.stops
            << " stops; files in blobs " << files_below("blobs") << ", recordings " << files_below("recordings")
            << ", trash " << files_below("trash") << ", tmp " << files_below("tmp") << "\n";
  EXPECT_EQ(server->end(SIGTERM), 0);
  expect_check_finds_nothing();
}

}  // namespace
}  // namespace semblante::test
