#include <array>

#include "server/api/common.h"
#include "server/api/generated/handlers.h"
#include "server/metrics/process_metrics.h"
#include "server/metrics/request_counts.h"
#include "server/metrics/text_writer.h"

namespace semblante::api {
namespace {

using metrics::MetricType;
using metrics::TextWriter;

void write_build(TextWriter& writer, const ApiConfig& config) {
  writer.family("semblante_build_info", MetricType::gauge, "Always 1; the version is in the label.");
  writer.sample(std::uint64_t{1}, {{"version", config.version}});
}

void write_store(TextWriter& writer, store::Store& store) {
  writer.single("semblante_models", MetricType::gauge, "Models stored.", std::uint64_t{store.model_count()});
  writer.single("semblante_expressions", MetricType::gauge, "Displacement sets stored, without the library's.",
                std::uint64_t{store.set_count()});
  writer.single("semblante_artefact_bytes", MetricType::gauge,
                "Size of all artefacts of the models, each counted once.", store.artefact_bytes());
}

void write_pending(TextWriter& writer, const store::PendingStatus& status) {
  writer.single("semblante_store_writable", MetricType::gauge, "1; 0 while the data folder cannot be written.",
                std::uint64_t{status.writable});
  writer.single("semblante_store_disk_full", MetricType::gauge, "1 while that is because the disk is full.",
                std::uint64_t{status.disk_full});
  writer.single("semblante_store_pending_writes", MetricType::gauge,
                "Pending changes, to be made when the data folder can be written.", std::uint64_t{status.count});
}

void write_jobs(TextWriter& writer, const jobs::JobQueue& jobs) {
  writer.family("semblante_jobs", MetricType::gauge, "Jobs that have not ended.");
  writer.sample(std::uint64_t{jobs.waiting()}, {{"state", "waiting"}});
  writer.sample(std::uint64_t{jobs.running()}, {{"state", "running"}});
  writer.family("semblante_worker_isolation", MetricType::gauge,
                "1 if jobs are isolated by this means of the system, 0 if the system lacks or forbids it.");
  writer.sample(std::uint64_t{jobs.isolation().system_calls}, {{"means", "seccomp"}});
  writer.sample(std::uint64_t{jobs.isolation().landlock > 0}, {{"means", "landlock"}});
  writer.family("semblante_jobs_ended_total", MetricType::counter, "Jobs that ended since the server started.");
  using store::JobState;
  for (const auto& kind : jobs::job_kinds)
    for (const auto state : {JobState::done, JobState::failed, JobState::cancelled})
      writer.sample(jobs.ended(kind.name, state), {{"kind", kind.name}, {"state", to_string(state)}});
}

/// The values are sums over all streams, because clients choose stream ids and a label for each would be unbounded.
void write_streams(TextWriter& writer, const streams::StreamHub& hub) {
  using streams::source_names;
  std::array<std::uint64_t, streams::source_count + 1> fed{};
  std::array<std::uint64_t, streams::coding_count> subscribers{};
  for (const auto& stream : hub.list()) {
    ++fed[stream.active_source ? static_cast<std::size_t>(*stream.active_source) : streams::source_count];
    for (std::size_t i = 0; i < subscribers.size(); ++i) subscribers[i] += stream.subscribers_by_coding[i];
  }
  const auto counts = hub.counts();
  writer.family("semblante_streams", MetricType::gauge, "Open streams, by their current source.");
  for (std::size_t i = 0; i < fed.size(); ++i)
    writer.sample(fed[i], {{"source", i < streams::source_count ? source_names[i] : "none"}});
  writer.family("semblante_stream_subscribers", MetricType::gauge, "Connections that subscribe to a stream.");
  for (std::size_t i = 0; i < subscribers.size(); ++i)
    writer.sample(subscribers[i], {{"coding", streams::coding_names[i]}});
  writer.family("semblante_stream_frames_total", MetricType::counter, "Frames that entered a stream.");
  for (std::size_t i = 0; i < streams::source_count; ++i)
    writer.sample(counts.frames_by_source[i], {{"source", source_names[i]}});
  writer.single("semblante_stream_batches_total", MetricType::counter, "Batches into which frames were gathered.",
                counts.batches);
  writer.single("semblante_stream_encode_seconds_total", MetricType::counter,
                "Time spent on encoding batches and join points, in all codings.", counts.encode_seconds);
  writer.single("semblante_stream_messages_sent_total", MetricType::counter,
                "Batches and join points sent, to each subscriber.", counts.messages_sent);
  writer.single("semblante_stream_sent_bytes_total", MetricType::counter, "Bytes of these, WebSocket headers included.",
                counts.bytes_sent);
  writer.single("semblante_stream_messages_coalesced_total", MetricType::counter,
                "Batches to subscribers that fell behind, replaced by the newest state.", counts.messages_replaced);
  writer.single("semblante_stream_sound_packets_total", MetricType::counter, "Packets of sound that entered a stream.",
                counts.sound_packets);
  writer.single("semblante_stream_sound_messages_sent_total", MetricType::counter,
                "Packets of sound sent, to each listener.", counts.sound_sent);
  writer.single("semblante_stream_sound_sent_bytes_total", MetricType::counter,
                "Bytes of these, WebSocket headers included.", counts.sound_bytes_sent);
  writer.single("semblante_stream_sound_messages_dropped_total", MetricType::counter,
                "Packets of sound not sent to listeners who read too slowly.", counts.sound_dropped);
  writer.single("semblante_stream_texts_sent_total", MetricType::counter,
                "Sentences sent to clients with a voice of their own.", counts.texts_sent);
  writer.single("semblante_stream_texts_sent_bytes_total", MetricType::counter,
                "Bytes of these, WebSocket headers included.", counts.text_bytes_sent);
  writer.single("semblante_stream_words_reached_total", MetricType::counter,
                "Words that the voices of such clients have told to begin.", counts.words_reached);
  writer.single("semblante_stream_voices_failed_total", MetricType::counter,
                "Clients whose own voice did not speak, and that got frames then.", counts.voices_failed);
  writer.single("semblante_stream_messages_dropped_total", MetricType::counter,
                "Messages pending for connections closed as slow, and answers dropped at the limit.",
                counts.messages_dropped);
  writer.family("semblante_stream_lateness_seconds", MetricType::histogram,
                "Time from a batch's deadline until the kernel accepted it, for each subscriber.");
  writer.histogram(metrics::lateness_bounds, counts.lateness);
  writer.single("semblante_stream_throttled_frames_total", MetricType::counter,
                "Frames dropped because their source exceeded its limit.", counts.throttled);
  writer.family("semblante_stream_connections_closed_total", MetricType::counter,
                "Connections of streams that the server closed.");
  writer.sample(counts.closed_slow, {{"reason", "slow"}});
  writer.sample(counts.closed_silent, {{"reason", "no_hello"}});
  writer.sample(counts.closed_replaced, {{"reason", "replaced"}});
  writer.sample(counts.closed_conflict, {{"reason", "conflict"}});
  writer.sample(counts.closed_flooding, {{"reason", "throttled"}});
  writer.sample(counts.closed_ended, {{"reason", "ended"}});
  writer.single("semblante_stream_connections_refused_total", MetricType::counter,
                "Connections refused because of the stream's limit of connections.", counts.refused);
  writer.single("semblante_stream_clamped_values_total", MetricType::counter,
                "Values clamped to the range of their FAP.", counts.clamped_values);
}

void write_recordings(TextWriter& writer, const recordings::RecorderCounts& counts) {
  writer.single("semblante_recordings_running", MetricType::gauge, "Running recordings.", counts.running);
  writer.single("semblante_recordings_bytes", MetricType::gauge, "Size of all recordings.", counts.bytes);
  writer.single("semblante_recordings_frames_total", MetricType::counter, "Frames made durable.", counts.frames);
  writer.single("semblante_recordings_dropped_frames_total", MetricType::counter,
                "Frames dropped because the disk was too slow.", counts.dropped);
  writer.single("semblante_recordings_failed_total", MetricType::counter,
                "Recordings that ended because they could not be written.", counts.failed);
}

void write_trash(TextWriter& writer, const store::Trash::Counts& counts) {
  writer.single("semblante_trash_files", MetricType::gauge,
                "Files the database did not know at a start, kept for a grace period.", counts.files);
  writer.single("semblante_trash_bytes", MetricType::gauge, "Size of these.", counts.bytes);
}

}  // namespace

http::Response get_metrics(Context& context, http::Request&) {
  TextWriter writer;
  write_build(writer, context.config);
  metrics::write_process_metrics(writer);
  if (context.net_metrics) context.net_metrics(writer);
  context.requests->write(writer);
  write_store(writer, context.store);
  write_pending(writer, context.pending.status());
  write_jobs(writer, context.jobs);
  write_streams(writer, context.hub);
  if (context.recorder) write_recordings(writer, context.recorder->counts());
  if (context.trash) write_trash(writer, context.trash->counts());
  http::Response response;
  response.headers["Content-Type"] = "text/plain; version=0.0.4; charset=utf-8";
  response.headers["Cache-Control"] = "no-store";
  response.body = writer.text();
  return response;
}

}  // namespace semblante::api
