#include "server/app/installation_check.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <string_view>
#include <unistd.h>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <sys/timex.h>

#include "server/app/listening.h"
#include "server/app/private_files.h"
#include "server/cli/command_failure.h"
#include "server/jobs/worker_process.h"
#include "server/store/data_files.h"
#include "server/store/database_snapshot.h"
#include "server/store/disk_space.h"
#include "server/upkeep/data_lock.h"

namespace semblante {
namespace {

namespace fs = std::filesystem;
using Level = InstallationFinding::Level;

constexpr std::uint64_t mebibyte = std::uint64_t{1} << 20U;
constexpr std::uint64_t least_free = 512 * mebibyte;  ///< below this, one upload of the largest size may not fit
constexpr std::uint64_t least_files = 10'000;
constexpr std::chrono::seconds worker_patience{20};

std::string mebibytes(std::uint64_t bytes) { return std::to_string(bytes / mebibyte) + " MiB"; }
std::string reason() { return std::strerror(errno); }

/// The folder itself, or the nearest one above it that exists.
fs::path nearest_existing(fs::path folder) {
  std::error_code error;
  folder = fs::absolute(folder, error);
  while (!fs::exists(folder, error) && folder.has_relative_path()) folder = folder.parent_path();
  return folder;
}

/// Whether a file can be made, written through to the disk and removed; sets errno.
bool can_write(const fs::path& folder) {
  auto name = (folder / "doctor-XXXXXX").string();
  const int file = ::mkstemp(name.data());
  if (file < 0) return false;
  const bool written = ::write(file, "x", 1) == 1 && ::fsync(file) == 0;
  const int fault = errno;
  ::close(file);
  ::unlink(name.c_str());
  errno = fault;
  return written;
}

void check_space(InstallationFindings& findings, const fs::path& folder, std::uint64_t reserve) {
  const auto free = store::free_bytes(folder);
  const auto least = std::max(least_free, reserve);
  if (free < least)
    findings.push_back({Level::warning, "disk space", mebibytes(free) + " are free in " + folder.string(),
                        "Free space: uploads and recordings need " + mebibytes(least) + " or more."});
  else
    findings.push_back({Level::ok, "disk space", mebibytes(free) + " are free in " + folder.string(), ""});
  struct statvfs disk {};
  // A file system without a fixed number of files tells 0.
  if (::statvfs(folder.c_str(), &disk) == 0 && disk.f_files > 0 && disk.f_favail < least_files)
    findings.push_back({Level::warning, "disk space", "only " + std::to_string(disk.f_favail) + " more files fit",
                        "Remove files of this file system: it has few inodes left."});
}

void check_owner(InstallationFindings& findings, const fs::path& data) {
  struct stat state {};
  if (::stat(data.c_str(), &state) != 0) return;
  const auto account = ::geteuid();
  if (state.st_uid != account)
    findings.push_back({account == 0 ? Level::warning : Level::error, "data folder",
                        data.string() + " belongs to account " + std::to_string(state.st_uid) +
                            ", and this is account " + std::to_string(account),
                        "Run this and the server as the owner (runuser -u NAME -- semblante doctor), or chown -R it."});
  if ((state.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    findings.push_back({Level::warning, "data folder", "other accounts of this machine may enter " + data.string(),
                        "chmod 700 " + data.string()});
}

void check_database(InstallationFindings& findings, const fs::path& data) {
  const auto file = data / store::database_file_name;
  std::error_code error;
  if (!fs::exists(fs::symlink_status(file, error))) return;  // the first start makes it
  const auto opens = store::check_opens(file);
  if (opens) {
    findings.push_back({Level::ok, "database", "this version reads it", ""});
    return;
  }
  findings.push_back({Level::error, "database", file.string() + ": " + opens.error().message,
                      opens.error().code == ErrorCode::unsupported
                          ? "Use the later version again, or restore a backup that this one has made."
                          : "semblante check tells more; put the right file in its place, or restore a backup."});
}

bool check_data_folder(InstallationFindings& findings, const ServeOptions& options) {
  std::error_code error;
  const auto exists = fs::exists(options.data, error);
  const auto folder = nearest_existing(options.data);
  if (!fs::is_directory(folder, error)) {
    findings.push_back({Level::error, "data folder", folder.string() + " is no folder", "Choose another with --data."});
    return false;
  }
  const bool locked = exists && upkeep::is_server_running(folder);
  if (!can_write(folder))
    findings.push_back({Level::error, "data folder", folder.string() + " cannot be written: " + reason(),
                        "Give it to the account of the server (chown), mount it for writing, or choose another with "
                        "--data; under systemd, name it in ReadWritePaths."});
  else
    findings.push_back({Level::ok, "data folder",
                        options.data.string() + (!exists  ? " will be made by the first start"
                                                 : locked ? " is writable, and a server runs in it"
                                                          : " is writable"),
                        ""});
  if (exists) check_owner(findings, folder);
  if (exists) check_database(findings, folder);
  check_space(findings, folder, options.disk_reserve);
  return locked;
}

void check_address(InstallationFindings& findings, const net::Listener& listener, bool server_runs) {
  const auto where = listener.address + " port " + std::to_string(listener.port);
  sockaddr_storage storage{};
  auto& four = reinterpret_cast<sockaddr_in&>(storage);
  auto& six = reinterpret_cast<sockaddr_in6&>(storage);
  socklen_t length = 0;
  if (::inet_pton(AF_INET, listener.address.c_str(), &four.sin_addr) == 1) {
    four.sin_family = AF_INET;
    four.sin_port = htons(listener.port);
    length = sizeof four;
  } else if (::inet_pton(AF_INET6, listener.address.c_str(), &six.sin6_addr) == 1) {
    six.sin6_family = AF_INET6;
    six.sin6_port = htons(listener.port);
    length = sizeof six;
  }
  const int tried = ::socket(storage.ss_family, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int on = 1;
  ::setsockopt(tried, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (::bind(tried, reinterpret_cast<const sockaddr*>(&storage), length) == 0 && ::listen(tried, 1) == 0)
    findings.push_back({Level::ok, "address", where + " is free", ""});
  else if (errno == EADDRINUSE && server_runs)
    findings.push_back({Level::ok, "address", where + " is in use, as it is while the server runs", ""});
  else
    findings.push_back({Level::error, "address", where + ": " + reason(),
                        errno == EADDRINUSE ? "Stop what listens there (ss -ltnp shows it), or choose another port."
                        : errno == EACCES   ? "Ports below 1024 need CAP_NET_BIND_SERVICE (the unit file has it ready "
                                              "as a comment), or a proxy in front; or choose another port."
                                            : "Choose an address of this machine."});
  ::close(tried);
}

void check_addresses(InstallationFindings& findings, const ServeOptions& options, bool server_runs) {
  try {
    for (const auto& listener : check_listening(options.listening, options.data).listeners)
      check_address(findings, listener, server_runs);
  } catch (const CommandFailure& refused) {
    findings.push_back({Level::error, "address", refused.what(), ""});
  }
}

std::string page_text(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>{stream}, {});
}

/// The files that index.html names by src="..." and href="..." within the web root, and those that scripts fetch.
std::vector<std::string> files_of_studio(const std::string& page) {
  std::vector<std::string> names = {"semblante_view.wasm",  "semblante_motion.wasm",    "semblante_listen.wasm",
                                    "semblante_speak.wasm", "draco/draco_decoder.wasm", "draco/draco_wasm_wrapper.js",
                                    "listen_worklet.js"};
  for (const std::string_view attribute : {"src=\"", "href=\""})
    for (auto at = page.find(attribute); at != std::string::npos; at = page.find(attribute, at + 1)) {
      const auto begin = at + attribute.size();
      const auto name = page.substr(begin, page.find('"', begin) - begin);
      if (name.substr(0, 2) == "./") names.push_back(name.substr(2));
    }
  return names;
}

void check_studio(InstallationFindings& findings, const ServeOptions& options) {
  if (options.web_root.empty()) {
    findings.push_back({Level::warning, "studio", "no web root: the server has no pages, only its interface",
                        "Name the folder of the built pages with --web-root."});
    return;
  }
  for (const auto& sentence : private_files_in_web_root(options))
    findings.push_back({Level::error, "studio", sentence, "Move it, or name another folder with --web-root."});
  std::error_code error;
  const auto page = page_text(options.web_root / "index.html");
  std::vector<std::string> missing;
  if (page.empty()) missing.emplace_back("index.html");
  for (auto& name : files_of_studio(page))
    if (!fs::is_regular_file(options.web_root / name, error) || ::access((options.web_root / name).c_str(), R_OK) != 0)
      missing.push_back(std::move(name));
  if (missing.empty()) {
    findings.push_back({Level::ok, "studio", options.web_root.string() + " is complete", ""});
    return;
  }
  std::string names;
  for (const auto& name : missing) names.append(names.empty() ? "" : ", ").append(name);
  findings.push_back({Level::error, "studio", options.web_root.string() + " has no readable " + names,
                      "Install the package again, or build the studio (deploy/run --build-only) and name web/dist "
                      "with --web-root."});
}

void check_sample(InstallationFindings& findings, const ServeOptions& options) {
  if (options.sample.empty()) return;
  for (const auto& file : {options.sample, fs::path(options.sample).replace_extension(".fps.json")}) {
    const bool is_folder = fs::is_directory(file);
    if (!is_folder && ::access(file.c_str(), R_OK) == 0) continue;
    findings.push_back({Level::error, "sample head",
                        file.string() + " cannot be read: " + (is_folder ? "it is a folder" : reason()),
                        "Correct --sample, or leave it out (--sample \"\")."});
    return;
  }
  findings.push_back({Level::ok, "sample head", options.sample.string() + " is readable", ""});
}

/// A worker that gets no job reports on its standard output that it cannot read its request, and ends with status 2.
void check_worker(InstallationFindings& findings, const ServeOptions& options) {
  std::string answer;
  const auto exit = jobs::run_worker_process(
      {jobs::running_program, "worker", "--memory", std::to_string(options.worker_memory), "--cpu-seconds",
       std::to_string(options.worker_cpu_seconds)},
      "{}", "/dev/null", worker_patience, [&](std::string_view line) { answer = line; },
      [] { return jobs::Wish::go_on; });
  if (exit && exit->kind == jobs::WorkerExit::Kind::exited && exit->code == 2 && !answer.empty()) {
    findings.push_back({Level::ok, "worker", "a process for jobs starts and answers", ""});
    return;
  }
  findings.push_back(
      {Level::error, "worker", "a process for jobs does not start" + (exit ? "" : ": " + exit.error().message),
       "Look for limits of processes or memory (ulimit -a, TasksMax, MemoryMax), raise --worker-memory."});
}

void check_limits(InstallationFindings& findings, const ServeOptions& options) {
  constexpr rlim_t reserved = 512;  // as in open_files.cpp
  rlimit files{};
  if (::getrlimit(RLIMIT_NOFILE, &files) != 0) return;
  const auto text = "the process may have " + std::to_string(files.rlim_max) + " files open";
  if (files.rlim_max < options.max_connections + reserved || files.rlim_max < 4 * reserved)
    findings.push_back({Level::warning, "open files", text + ", which limits the connections",
                        "Raise the hard limit: LimitNOFILE in the unit file, ulimit -Hn in a shell."});
  else
    findings.push_back({Level::ok, "open files", text, ""});
}

void check_clock(InstallationFindings& findings, const ServeOptions& options) {
  using Clock = std::chrono::system_clock;
  constexpr std::time_t made_after = 1'735'689'600;  // 2025-01-01
  constexpr std::chrono::seconds tolerance{60};
  const auto now = Clock::now();
  if (Clock::to_time_t(now) < made_after) {
    findings.push_back(
        {Level::error, "clock", "this machine's clock is years behind", "Set the clock, for example by NTP."});
    return;
  }
  struct stat last {};
  if (::stat((options.data / "last-database").c_str(), &last) == 0 &&
      Clock::from_time_t(last.st_mtim.tv_sec) > now + tolerance) {
    findings.push_back({Level::warning, "clock", "the clock is behind the last start of the server in this data folder",
                        "Set the clock: it was set back, or was ahead then."});
    return;
  }
  timex state{};
  const bool is_known = ::adjtimex(&state) >= 0;
  if (is_known && (static_cast<unsigned>(state.status) & static_cast<unsigned>(STA_UNSYNC)) != 0)
    findings.push_back({Level::ok, "clock", "plausible; the kernel does not know it as synchronized (NTP)", ""});
  else
    findings.push_back({Level::ok, "clock", is_known ? "synchronized" : "plausible", ""});
}

}  // namespace

InstallationFindings check_installation(const ServeOptions& options) {
  InstallationFindings findings;
  const bool server_runs = check_data_folder(findings, options);
  check_addresses(findings, options, server_runs);
  check_studio(findings, options);
  check_sample(findings, options);
  check_worker(findings, options);
  check_limits(findings, options);
  check_clock(findings, options);
  return findings;
}

}  // namespace semblante
