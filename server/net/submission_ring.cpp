#include "server/net/submission_ring.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <unistd.h>

#include <linux/io_uring.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/syscall.h>

namespace semblante::net {
namespace {

#ifdef IORING_SETUP_SUBMIT_ALL
/// A call that cannot be begun does not keep back those behind it.
constexpr unsigned setup_flags = IORING_SETUP_SUBMIT_ALL;
#else
constexpr unsigned setup_flags = 0;
#endif

void* map(int descriptor, std::size_t bytes, off_t what) {
  void* at = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, descriptor, what);
  return at == MAP_FAILED ? nullptr : at;
}

}  // namespace

std::optional<SubmissionRing> SubmissionRing::make(unsigned entries) {
  io_uring_params parameters{};
  parameters.flags = setup_flags;
  Part part;
  part.descriptor = static_cast<int>(::syscall(SYS_io_uring_setup, entries, &parameters));
  if (part.descriptor < 0) return std::nullopt;
  SubmissionRing ring(part);  // frees what there is
  // FAST_POLL came after the calls that are used here.
  constexpr unsigned needed = IORING_FEAT_SINGLE_MMAP | IORING_FEAT_FAST_POLL;
  if ((parameters.features & needed) != needed) {
    errno = ENOSYS;
    return std::nullopt;
  }
  const auto& submission = parameters.sq_off;
  const auto& completion = parameters.cq_off;
  auto& to = ring.part_;
  to.rings_bytes = std::max<std::size_t>(submission.array + parameters.sq_entries * sizeof(unsigned),
                                         completion.cqes + parameters.cq_entries * sizeof(io_uring_cqe));
  to.rings = map(to.descriptor, to.rings_bytes, IORING_OFF_SQ_RING);
  to.entries_bytes = parameters.sq_entries * sizeof(io_uring_sqe);
  to.entries = static_cast<io_uring_sqe*>(map(to.descriptor, to.entries_bytes, IORING_OFF_SQES));
  if (to.rings == nullptr || to.entries == nullptr) return std::nullopt;
  auto* const base = static_cast<char*>(to.rings);
  const auto at = [base](unsigned offset) { return reinterpret_cast<unsigned*>(base + offset); };
  to.submission_tail = at(submission.tail);
  to.submission_indices = at(submission.array);
  to.submission_mask = *at(submission.ring_mask);
  to.completion_head = at(completion.head);
  to.completion_tail = at(completion.tail);
  to.completion_mask = *at(completion.ring_mask);
  to.completions = reinterpret_cast<io_uring_cqe*>(base + completion.cqes);
  return ring;
}

SubmissionRing::~SubmissionRing() {
  const int error = errno;
  if (part_.entries != nullptr) ::munmap(part_.entries, part_.entries_bytes);
  if (part_.rings != nullptr) ::munmap(part_.rings, part_.rings_bytes);
  if (part_.descriptor >= 0) ::close(part_.descriptor);
  errno = error;
}

void SubmissionRing::add_send(int descriptor, std::string_view bytes, std::uint64_t number) {
  const unsigned tail = *part_.submission_tail;  // written by this side only
  const unsigned index = tail & part_.submission_mask;
  io_uring_sqe entry{};
  entry.opcode = IORING_OP_SEND;
  entry.fd = descriptor;
  entry.addr = reinterpret_cast<std::uintptr_t>(bytes.data());
  entry.len = static_cast<unsigned>(bytes.size());
  entry.msg_flags = MSG_DONTWAIT | MSG_NOSIGNAL;  // completed within the system call, like send()
  entry.user_data = number;
  part_.entries[index] = entry;
  part_.submission_indices[index] = index;
  std::atomic_ref(*part_.submission_tail).store(tail + 1, std::memory_order_release);
  ++gathered_;
}

int SubmissionRing::begin() {
  while (gathered_ > 0) {
    const auto begun =
        ::syscall(SYS_io_uring_enter, part_.descriptor, gathered_, gathered_, IORING_ENTER_GETEVENTS, nullptr, 0);
    if (begun < 0 && errno == EINTR) continue;
    if (begun <= 0) return begun < 0 ? errno : EIO;
    gathered_ -= static_cast<unsigned>(begun);
    under_way_ += static_cast<unsigned>(begun);
  }
  return 0;
}

/// Only after a signal has ended the wait of begin(): each call is completed without waiting.
void SubmissionRing::wait() const {
  ::syscall(SYS_io_uring_enter, part_.descriptor, 0, 1, IORING_ENTER_GETEVENTS, nullptr, 0);
}

std::optional<std::pair<std::size_t, long>> SubmissionRing::next_completion() {
  const unsigned head = *part_.completion_head;  // written by this side only
  if (head == std::atomic_ref(*part_.completion_tail).load(std::memory_order_acquire)) return std::nullopt;
  const io_uring_cqe completion = part_.completions[head & part_.completion_mask];
  std::atomic_ref(*part_.completion_head).store(head + 1, std::memory_order_release);
  --under_way_;
  return std::pair(static_cast<std::size_t>(completion.user_data), static_cast<long>(completion.res));
}

}  // namespace semblante::net
