#include "server/jobs/worker_process.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <poll.h>
#include <spawn.h>
#include <unistd.h>

#include <sys/wait.h>

#include "server/store/store_error.h"

extern char** environ;

namespace semblante::jobs {
namespace {

constexpr std::size_t max_line_bytes = 4U << 20U;
constexpr std::size_t last_words_bytes = 600;
constexpr int poll_milliseconds = 50;
constexpr int shortage_milliseconds = 200;  ///< until the next try
constexpr std::chrono::seconds term_to_kill{2};

class Pipe {
 public:
  Pipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC) == 0) return;
    error_ = errno;
    ends_ = {-1, -1};
  }
  ~Pipe() {
    close_read();
    close_write();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  /// Why it could not be made, an errno, or 0.
  [[nodiscard]] int error() const { return error_; }
  [[nodiscard]] int read_end() const { return ends_[0]; }
  [[nodiscard]] int write_end() const { return ends_[1]; }
  void close_read() { close_one(ends_[0]); }
  void close_write() { close_one(ends_[1]); }

 private:
  static void close_one(int& end) {
    if (end >= 0) ::close(end);
    end = -1;
  }
  std::array<int, 2> ends_{-1, -1};
  int error_ = 0;
};

/// The pipes of a worker, and its process once it is started.
struct Worker {
  Pipe in;
  Pipe out;
  pid_t pid = 0;
};

/// posix_spawn's two option objects, freed together.
struct SpawnOptions {
  posix_spawn_file_actions_t files{};
  posix_spawnattr_t attributes{};
  SpawnOptions() {
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
  }
  ~SpawnOptions() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
  }
  SpawnOptions(const SpawnOptions&) = delete;
  SpawnOptions& operator=(const SpawnOptions&) = delete;
};

/// An errno, or 0.
int spawn(const std::vector<std::string>& arguments, const std::filesystem::path& error_file, Worker& worker) {
  SpawnOptions options;
  posix_spawn_file_actions_adddup2(&options.files, worker.in.read_end(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&options.files, worker.out.write_end(), STDOUT_FILENO);
  // A worker must not inherit the server's sockets and files, and has room for a descriptor when the server has none.
  posix_spawn_file_actions_addclosefrom_np(&options.files, STDERR_FILENO + 1);
  posix_spawn_file_actions_addopen(&options.files, STDERR_FILENO, error_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                   0600);
  posix_spawnattr_setflags(&options.attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&options.attributes, &none);
  sigset_t defaults;
  sigemptyset(&defaults);
  for (const int number : {SIGTERM, SIGINT, SIGPIPE, SIGXFSZ, SIGUSR1, SIGUSR2}) sigaddset(&defaults, number);
  posix_spawnattr_setsigdefault(&options.attributes, &defaults);

  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (const auto& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  return posix_spawn(&worker.pid, arguments[0].c_str(), &options.files, &options.attributes, argv.data(), environ);
}

/// Whether others have what is missing, and may give it back: descriptors, processes, memory.
bool is_shortage(int error_number) {
  return error_number == EMFILE || error_number == ENFILE || error_number == EAGAIN || error_number == ENOMEM;
}

/// Holds back SIGPIPE of this thread for as long as it lives, and takes away what came meanwhile.
class NoPipeSignal {
 public:
  NoPipeSignal() {
    sigemptyset(&pipe_);
    sigaddset(&pipe_, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~NoPipeSignal() {
    constexpr timespec at_once{};
    if (sigismember(&before_, SIGPIPE) == 0) sigtimedwait(&pipe_, nullptr, &at_once);
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  NoPipeSignal(const NoPipeSignal&) = delete;
  NoPipeSignal& operator=(const NoPipeSignal&) = delete;

 private:
  sigset_t pipe_{}, before_{};
};

/// The request may exceed a pipe's buffer, and the worker may die before it reads: must neither hang nor raise SIGPIPE.
void feed_input(Pipe& in, std::string_view& input) {
  const NoPipeSignal no_signal;
  while (!input.empty() && in.write_end() >= 0) {
    const auto written = ::write(in.write_end(), input.data(), input.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0 && errno == EAGAIN) return;
    if (written <= 0) break;
    input.remove_prefix(static_cast<std::size_t>(written));
  }
  in.close_write();
}

std::string read_last_words(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.size() > last_words_bytes ? text.substr(text.size() - last_words_bytes) : text;
}

}  // namespace

std::string own_executable() {
  std::error_code error;
  const auto path = std::filesystem::read_symlink(running_program, error);
  return error ? std::string(running_program) : path.string();
}

Result<WorkerExit> run_worker_process(const std::vector<std::string>& arguments, std::string_view input,
                                      const std::filesystem::path& error_file, std::chrono::seconds wall_limit,
                                      const std::function<void(std::string_view line)>& on_line,
                                      const std::function<Wish()>& poll_wish,
                                      const std::optional<WorkerLimits>& limits) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  WorkerExit exit;
  std::optional<Worker> worker;
  while (true) {
    worker.emplace();
    const int pipes = worker->in.error() != 0 ? worker->in.error() : worker->out.error();
    const int fault = pipes != 0 ? pipes : spawn(arguments, error_file, *worker);
    if (fault == 0) break;
    worker.reset();  // its pipe may be what others wait for
    store::throw_if_disk_full(error_file, fault);
    if (!is_shortage(fault) || Clock::now() - begin > wall_limit)
      return Error{ErrorCode::io, arguments[0], "cannot start a worker: " + std::string(std::strerror(fault))};
    const auto wish = poll_wish();
    if (wish != Wish::go_on) {
      exit.kind = wish == Wish::stop ? WorkerExit::Kind::stopped : WorkerExit::Kind::cancelled;
      return exit;
    }
    ::poll(nullptr, 0, shortage_milliseconds);
  }
  Pipe& in = worker->in;
  Pipe& out = worker->out;
  const pid_t pid = worker->pid;
  end_before_the_server(pid);
  if (limits) limit_process(pid, *limits);
  in.close_read();
  out.close_write();
  ::fcntl(in.write_end(), F_SETFL, O_NONBLOCK);

  bool ended_by_us = false;
  Clock::time_point kill_at = Clock::time_point::max();
  std::string pending;
  std::array<char, 16384> piece{};
  const auto end_it = [&](WorkerExit::Kind kind, bool gently) {
    exit.kind = kind;
    ended_by_us = true;
    ::kill(-pid, gently ? SIGTERM : SIGKILL);  // its group: also what it has started
    kill_at = gently ? Clock::now() + term_to_kill : Clock::time_point::max();
  };

  while (true) {
    feed_input(in, input);
    pollfd wait{out.read_end(), POLLIN, 0};
    const int ready = ::poll(&wait, 1, poll_milliseconds);
    if (ready > 0) {
      const auto got = ::read(out.read_end(), piece.data(), piece.size());
      if (got == 0) break;
      if (got > 0) pending.append(piece.data(), static_cast<std::size_t>(got));
      for (std::size_t end = pending.find('\n'); end != std::string::npos; end = pending.find('\n')) {
        on_line(std::string_view(pending).substr(0, end));
        pending.erase(0, end + 1);
      }
      if (pending.size() > max_line_bytes && !ended_by_us) end_it(WorkerExit::Kind::exited, false);
    }
    const auto now = Clock::now();
    const auto wish = poll_wish();
    if (wish == Wish::stop && exit.kind != WorkerExit::Kind::stopped) end_it(WorkerExit::Kind::stopped, false);
    if (!ended_by_us && wish == Wish::cancel) end_it(WorkerExit::Kind::cancelled, true);
    if (!ended_by_us && now - begin > wall_limit) end_it(WorkerExit::Kind::timed_out, false);
    if (now >= kill_at) {
      ::kill(-pid, SIGKILL);
      kill_at = Clock::time_point::max();
    }
  }
  // Its output is closed: the worker is ending, or has closed it on purpose and must be killed.
  int status = 0;
  for (int round = 0; ::waitpid(pid, &status, WNOHANG) == 0; ++round) {
    if (round == 100 || ended_by_us) ::kill(-pid, SIGKILL);
    ::poll(nullptr, 0, 20);
  }
  exit.last_words = read_last_words(error_file);
  if (ended_by_us) return exit;
  exit.kind = WIFSIGNALED(status) ? WorkerExit::Kind::signalled : WorkerExit::Kind::exited;
  exit.code = WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
  return exit;
}

}  // namespace semblante::jobs
