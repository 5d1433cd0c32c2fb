#include "server/api/common.h"
#include "server/api/routes.h"
#include "server/metrics/process_metrics.h"
#include "server/metrics/request_counts.h"
#include "server/metrics/text_writer.h"

namespace semblante::api {
namespace {

using metrics::MetricType;
using metrics::TextWriter;

void write_build(TextWriter& writer, const ApiConfig& config) {
  writer.family("semblante_build_info", MetricType::gauge, "1; the version is in the label.");
  writer.sample(std::uint64_t{1}, {{"version", config.version}});
}

void write_store(TextWriter& writer, store::Store& store) {
  writer.single("semblante_models", MetricType::gauge, "Models kept.", std::uint64_t{store.model_count()});
  writer.single("semblante_expressions", MetricType::gauge, "Displacement sets kept, beside the library's.",
                std::uint64_t{store.set_count()});
  writer.single("semblante_artefact_bytes", MetricType::gauge,
                "Size of all artefacts of the models, each counted once.", store.artefact_bytes());
}

void write_jobs(TextWriter& writer, const jobs::JobQueue& jobs) {
  writer.family("semblante_jobs", MetricType::gauge, "Jobs that have not ended.");
  writer.sample(std::uint64_t{jobs.waiting()}, {{"state", "waiting"}});
  writer.sample(std::uint64_t{jobs.running()}, {{"state", "running"}});
  writer.family("semblante_jobs_ended_total", MetricType::counter, "Jobs that ended since the server started.");
  using store::JobKind;
  using store::JobState;
  for (const auto kind : {JobKind::import, JobKind::parametrize, JobKind::propose, JobKind::extract})
    for (const auto state : {JobState::done, JobState::failed, JobState::cancelled})
      writer.sample(jobs.ended(kind, state), {{"kind", to_string(kind)}, {"state", to_string(state)}});
}

void write_streams(TextWriter& writer, const streams::StreamHub& hub) {
  const auto streams = hub.list();
  std::uint64_t subscribers = 0;
  for (const auto& stream : streams) subscribers += stream.subscribers;
  const auto counts = hub.counts();
  writer.single("semblante_streams", MetricType::gauge, "Streams open.", std::uint64_t{streams.size()});
  writer.single("semblante_stream_subscribers", MetricType::gauge, "Connections that follow a stream.", subscribers);
  writer.single("semblante_stream_frames_total", MetricType::counter, "Frames that entered a stream.", counts.frames);
  writer.single("semblante_stream_messages_sent_total", MetricType::counter,
                "Messages with frames, for each subscriber they were meant for.", counts.messages_sent);
  writer.single("semblante_stream_messages_coalesced_total", MetricType::counter,
                "Messages to subscribers that fell behind, replaced by the newest state.", counts.messages_replaced);
  writer.single("semblante_stream_closed_slow_total", MetricType::counter,
                "Connections closed because they read nothing.", counts.closed_slow);
  writer.single("semblante_stream_refused_total", MetricType::counter,
                "Connections and publishers that were not taken.", counts.refused);
  writer.single("semblante_stream_clamped_values_total", MetricType::counter,
                "Values beyond the range of their FAP, made its end.", counts.clamped_values);
}

}  // namespace

http::Response get_metrics(Context& context, http::Request&) {
  TextWriter writer;
  write_build(writer, context.config);
  metrics::write_process_metrics(writer);
  if (context.net_metrics) context.net_metrics(writer);
  context.requests->write(writer);
  write_store(writer, context.store);
  write_jobs(writer, context.jobs);
  write_streams(writer, context.hub);
  http::Response response;
  response.headers["Content-Type"] = "text/plain; version=0.0.4; charset=utf-8";
  response.headers["Cache-Control"] = "no-store";
  response.body = writer.text();
  return response;
}

}  // namespace semblante::api
