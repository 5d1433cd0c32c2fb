#pragma once

#include "server/metrics/text_writer.h"

namespace semblante::metrics {

/// The process metrics of Prometheus' own client libraries, with the same names: processor time, memory, descriptors,
/// threads, start. Read from /proc by each call; values that cannot be read have no sample.
void write_process_metrics(TextWriter& writer);

}  // namespace semblante::metrics
