// The limits that server/README.md and openapi.json state, against the constants that are kept.

#include <chrono>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/performance/cue.h"
#include "core/speech/voice_timeline.h"
#include "protocol/cpp/performance_document.h"
#include "server/access/client_limits.h"
#include "server/access/tickets.h"
#include "server/access/token_limits.h"
#include "server/api/api.h"
#include "server/api/documents.h"
#include "server/api/model_clip.h"
#include "server/api/motion_body.h"
#include "server/jobs/job_run.h"
#include "server/net/server.h"
#include "server/recordings/recorder.h"
#include "server/recordings/recording_export.h"
#include "server/recordings/recording_format.h"
#include "server/streams/flood_guard.h"
#include "server/streams/player.h"
#include "server/streams/sound_guard.h"
#include "server/streams/stream_connection.h"
#include "server/streams/stream_limits.h"
#include "server/streams/timeline.h"
#include "server/voice/voice_protocol.h"

namespace semblante::api {
namespace {

std::string size(std::uint64_t bytes) {
  for (const auto& [shift, unit] : {std::pair(30U, " GiB"), std::pair(20U, " MiB"), std::pair(10U, " KiB")}) {
    if (bytes >> shift > 0) return std::to_string(bytes >> shift) + unit;
  }
  return std::to_string(bytes);
}

template <class Number>
std::string count(Number number) {
  return std::to_string(static_cast<std::uint64_t>(number));
}

template <class Duration>
std::string seconds(Duration duration) {
  return count(std::chrono::duration_cast<std::chrono::seconds>(duration).count()) + " s";
}

template <class Number>
std::string rate_of(Number per_second, Number burst) {
  return count(per_second) + " per second, " + count(burst) + " in a burst";
}

/// The second column of the rows of "## Limits" by the first, without the commas within numbers.
std::map<std::string, std::string> stated_limits() {
  std::ifstream file(SEMBLANTE_SOURCE_DIR "/server/README.md");
  std::map<std::string, std::string> rows;
  bool within = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("## ")) within = line == "## Limits";
    if (!within || !line.starts_with("| ")) continue;
    const std::size_t end = line.find(" | ", 2);
    const std::size_t next = line.find(" |", end + 3);
    std::string value;
    for (std::size_t i = end + 3; i < next; ++i) {
      if (line[i] == ',' && i + 1 < next && line[i + 1] != ' ') continue;
      value += line[i];
    }
    rows[line.substr(2, end - 2)] = value;
  }
  return rows;
}

TEST(Limits, OfTheReadMe_AreThoseThatAreKept) {
  const ApiLimits api;
  const net::ServerLimits net;
  const recordings::RecorderLimits recorder;
  const streams::StreamLimits stream;
  const streams::FloodLimits flood;
  const http::OutboxLimits outbox;
  const jobs::JobConfig job;
  const access::TokenLimits token;
  const access::ClientLimits client;
  const std::string rate = rate_of(flood.frames_per_second, flood.frames_burst);
  const std::vector<std::pair<std::string, std::string>> kept = {
      {"model file", size(api.max_upload_bytes)},
      {"bytes stored by one token: models with what is made from them (each content once), recordings, speeches, "
       "expressions",
       size(token.bytes)},
      {"models of one token", count(token.models)},
      {"displacement sets of one token", count(token.expressions)},
      {"streams of one token", count(token.streams)},
      {"recordings of one token", count(token.recordings)},
      {"speeches of one token", count(token.speeches)},
      {"jobs of one token that wait or run", count(token.jobs)},
      {"files that one token sends at the same time", count(token.uploads)},
      {"JSON body", size(api.max_json_bytes)},
      {"request header", size(net.max_header_bytes) + ", " + count(net.max_header_fields) + " fields, " +
                             count(net.max_header_fields) + " query parameters"},
      {"trailers of a chunked body, with the last chunk's extensions", size(net.max_header_bytes)},
      {"line before a chunk; chunk extensions of a body, together", size(net.max_header_bytes) + " each"},
      {"framing of a chunked body",
       size(net.max_header_bytes) + ", and " + count(net.framing_per_byte) + " bytes for each byte of content"},
      {"unparsed bytes of a connection", size(net.max_header_bytes)},
      {"connections of one address (IPv6: of 64 bits), except this machine and proxies",
       count(net.max_connections_per_address)},
      {"handshakes of TLS of one address that are not done, likewise", count(net.max_handshakes_per_address)},
      {"requests of one token, or of one address without one, on a server that asks for tokens",
       rate_of(client.requests_per_second, client.request_burst)},
      {"tokens of one address that are not accepted", count(client.failures_per_minute) + " per minute"},
      {"models, jobs, streams, recordings, speeches and expressions that one address creates, together; this machine "
       "and the "
       "scope admin have no such limit",
       count(client.creations_per_minute) + " per minute"},
      {"tickets that wait for their use; life of a ticket",
       count(access::Tickets::most) + "; " + seconds(access::Tickets::lifetime)},
      {"handshake of TLS", seconds(net.header_timeout)},
      {"a whole body, a file that is sent, a message of a WebSocket",
       seconds(net.body_grace) + ", and 1 s for each " + count(net.least_body_rate) + " bytes of it"},
      {"parts of a model that are listed and can be given a role",
       "the " + count(store::max_part_records) + " with the most vertices; 32 in a list of models"},
      {"pings and pongs (control frames) of one WebSocket", rate_of(net.controls_per_second, net.controls_burst)},
      {"fragments of a message of a WebSocket; of one WebSocket, together, without the last of each message",
       count(net.max_fragments) + "; " + rate_of(net.fragments_per_second, net.fragments_burst)},
      {"messages of one stream connection that are not a publisher's frames or sound",
       rate_of(streams::StreamConnection::messages_per_second, streams::StreamConnection::messages_burst)},
      {"subscriber that reads nothing", seconds(stream.stalled)},
      {"hello of a stream connection", seconds(stream.hello_time)},
      {"idle connection", seconds(net.idle_timeout)},
      {"header of a request", seconds(net.header_timeout)},
      {"between two pieces of a body or an answer", seconds(net.read_timeout)},
      {"between two pieces of a body or an answer", seconds(net.write_timeout)},
      {"models", count(api.max_models)},
      {"displacement sets, beside the library's", count(api.max_expressions)},
      {"stored speeches", count(api.max_speeches)},
      {"text of a speech", count(voice::max_text_bytes) + " bytes"},
      {"sound of a speech", count(static_cast<std::uint64_t>(voice::max_seconds)) + " s"},
      {"timeline of another voice", size(max_timeline_bytes) + ", " + count(max_timeline_events) + " events"},
      {"time in which a voice must have spoken", count(api::longest_speech_seconds) + " s"},
      {"voices that speak at the same time for requests", "half of `--threads`"},
      {"voices that speak at the same time for streams that have begun to say a text", "as many"},
      {"files of an example, together", size(api.max_upload_bytes)},
      {"streams", count(api.max_streams)},
      {"performance: document, cues, keys",
       size(max_performance_bytes) + ", " + count(max_performance_cues) + ", " + count(max_performance_keys)},
      {"performance: simultaneous cues on one target", count(max_overlapping_cues)},
      {"performance: frames per second", count(streams::least_play_rate) + " to " + count(streams::most_play_rate)},
      {"faces of an animated clip", count(max_clip_memory_frames)},
      {"playing performances and .fap files, together", size(stream.playing_bytes) + " of memory"},
      {"recordings", count(recorder.max_recordings) + " stored, " + count(recorder.max_running) + " running"},
      {"recording", count(recordings::max_recording_ms / 3'600'000) + " h, " + size(recorder.max_bytes)},
      {"recordings, together", size(recorder.max_total_bytes)},
      {"free bytes of the disk that recordings and their exports leave", size(recorder.disk_reserve)},
      {"frames of a recording that wait to be written", count(recorder.queued_frames)},
      {"recording as performance, or as .fap before its rate", count(recordings::max_gathered_frames) + " frames"},
      {"recording as frames or CSV", size(recordings::max_written_bytes)},
      {"jobs waiting", count(job.max_queued)},
      {"memory of a job", size(job.limits.memory_bytes)},
      {"processor time of a job", count(job.limits.cpu_seconds) + " s"},
      {"time of a job", seconds(job.wall_limit)},
      {"file a job writes", size(job.limits.file_bytes)},
      {"attempts of a job over restarts", count(job.max_attempts)},
      {"pending answers and messages for subscribers after SIGTERM", seconds(net.drain_time)},
      {"connections of a stream", count(stream.max_connections)},
      {"WebSocket message", size(max_binary_message_bytes) + " binary, " + size(max_json_message_bytes) + " JSON"},
      {"frames of one publisher", rate},
      {"sound of one publisher", count(streams::SoundGuard::bytes_per_second) + " bytes per second, " +
                                     count(streams::SoundGuard::bytes_burst) + " in a burst"},
      {"frames by requests, of one stream", rate},
      {"frames ahead of the stream's clock, of a publisher or requests", count(streams::most_ahead / 1000) + " s"},
      {"state waiting for a subscriber, beside the kernel's buffer (32 KiB)",
       count(stream.pending_messages) + " messages, " + size(stream.pending_bytes)},
      {"answers waiting for a client", count(outbox.answers) + " messages, " + size(outbox.answer_bytes)},
      {"gap held for a resume", "30 s, " + count(stream.held_batches) + " batches; " + count(stream.resumed_frames) +
                                    " frames, " + size(stream.resumed_bytes) + " per resume"},
  };
  const auto stated = stated_limits();
  for (const auto& [what, value] : kept) {
    const auto row = stated.find(what);
    if (row == stated.end()) {
      ADD_FAILURE() << "server/README.md has no limit \"" << what << '"';
    } else {
      EXPECT_EQ(row->second, value) << what;
    }
  }
  ASSERT_TRUE(stated.contains(".fap file: bytes, frames"));
  EXPECT_TRUE(stated.at(".fap file: bytes, frames").starts_with(size(max_fap_body_bytes) + ", "));
}

TEST(Limits, OfTheApiDocument_AreThoseThatAreKept) {
  const auto document = nlohmann::json::parse(openapi_document());
  const auto description = [&](const char* path) {
    return document.at("paths").at(path).at("post").at("requestBody").at("description").get<std::string>();
  };
  EXPECT_NE(description("/v1/models").find("At most " + size(ApiLimits{}.max_upload_bytes)), std::string::npos);
  EXPECT_TRUE(description("/v1/streams/{stream}/fap").starts_with("At most " + size(max_fap_body_bytes)));
  EXPECT_TRUE(description("/v1/streams/{stream}/performances").starts_with("At most " + size(max_performance_bytes)));
  EXPECT_TRUE(description("/v1/models/{model}/clip").starts_with("At most " + size(max_performance_bytes)));
  EXPECT_EQ(document.at("components").at("schemas").at("Performance").at("properties").at("cues").at("maxItems"),
            max_performance_cues);
}

}  // namespace
}  // namespace semblante::api
