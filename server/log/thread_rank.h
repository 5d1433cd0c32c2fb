#pragma once

namespace semblante::log {

/// Who gets a processor first when there is more to do than the machine can: streams are heard late if they wait, a
/// request or a handshake is only answered later. The thread that sends batches keeps the rank of the process.
enum class ThreadRank {
  live,        ///< connections of streams: the usual share, but they interrupt nobody
  requests,    ///< requests and their answers
  jobs,        ///< worker processes
  handshakes,  ///< of TLS, which strangers may begin by the thousand; in parallel with a stream's batch, a higher rank
               ///< would give them a tenth of its processor, this one gives a hundredth; their
               ///< turns are short as well
};

/// For the calling thread, and for the threads and processes that it starts later; once per thread, as it is relative
/// to the rank that the process was started with. A system that forbids it leaves the rank as it is.
void set_thread_rank(ThreadRank rank) noexcept;

}  // namespace semblante::log
