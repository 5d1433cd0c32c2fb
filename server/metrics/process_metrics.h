#pragma once

#include "server/metrics/text_writer.h"

namespace semblante::metrics {

/// What Prometheus' own client libraries tell of a process, under the same names: processor time, memory, descriptors,
/// threads, start. Read from /proc at the moment; what cannot be read is left without a sample.
void write_process_metrics(TextWriter& writer);

}  // namespace semblante::metrics
