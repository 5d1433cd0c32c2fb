#pragma once

namespace semblante::log {

/// Who gets a processor first when there is more to do than the machine can: streams are heard late if they wait, a
/// request or a handshake is only answered later. The thread that sends batches keeps the rank of the process.
enum class ThreadRank {
  live,        ///< connections of streams: the usual share, but they interrupt nobody
  requests,    ///< requests and their answers
  jobs,        ///< worker processes
  handshakes,  ///< of TLS, which strangers may begin by the thousand; they get a hundredth of
               ///< the processor beside a stream's batch, in short turns (nice 10 would give them a tenth)
};

/// For the calling thread, and for the threads and processes that it starts later; once per thread, as it is relative
/// to the rank that the process was started with. A system that forbids it leaves the rank as it is.
void set_thread_rank(ThreadRank rank) noexcept;

}  // namespace semblante::log
