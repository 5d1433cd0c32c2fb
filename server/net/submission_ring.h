#pragma once

// Private to net/.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

struct io_uring_sqe;
struct io_uring_cqe;

namespace semblante::net {

/// An io_uring that sends: calls are gathered and done by one system call. One thread at a time.
class SubmissionRing {
 public:
  /// For so many calls at a time. nullopt, with errno, where the kernel has no io_uring or forbids it.
  static std::optional<SubmissionRing> make(unsigned entries);
  ~SubmissionRing();
  SubmissionRing(SubmissionRing&& other) noexcept : part_(std::exchange(other.part_, {})) {}
  SubmissionRing& operator=(SubmissionRing&&) = delete;

  /// Gathers send(descriptor, bytes) that does not wait. At most `entries` before submit().
  void add_send(int descriptor, std::string_view bytes, std::uint64_t number);
  /// Does what was gathered; `done` gets the result of each, bytes or -errno. Returns 0, or the errno for which it did
  /// not do all: then the ring must not be used again.
  template <class Done>
  int submit(Done done) {
    const int error = begin();
    while (under_way_ > 0) {
      const auto completion = next_completion();
      if (completion)
        done(completion->first, completion->second);
      else
        wait();
    }
    return error;
  }

 private:
  /// The memory that is shared with the kernel.
  struct Part {
    int descriptor = -1;
    void* rings = nullptr;
    std::size_t rings_bytes = 0;
    io_uring_sqe* entries = nullptr;
    std::size_t entries_bytes = 0;
    unsigned* submission_tail = nullptr;
    unsigned* submission_indices = nullptr;
    unsigned submission_mask = 0;
    unsigned* completion_head = nullptr;
    unsigned* completion_tail = nullptr;
    unsigned completion_mask = 0;
    io_uring_cqe* completions = nullptr;
  };

  explicit SubmissionRing(const Part& part) : part_(part) {}
  int begin();
  void wait() const;
  std::optional<std::pair<std::size_t, long>> next_completion();

  Part part_;
  unsigned gathered_ = 0;   ///< since submit()
  unsigned under_way_ = 0;  ///< begun, and not told `done` yet
};

}  // namespace semblante::net
