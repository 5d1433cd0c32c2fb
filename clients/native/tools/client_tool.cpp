// semblante-client: fetches a face, follows a stream and writes its frames; or publishes to a stream.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <optional>

#include <CLI/CLI.hpp>

#include "clients/native/client/frame_player.h"
#include "clients/native/tools/files.h"
#include "clients/native/tools/frame_output.h"
#include "clients/native/tools/publish.h"
#include "clients/native/tools/run_tool.h"
#include "protocol/cpp/json_codec.h"
#include "protocol/cpp/kernel_values.h"

namespace semblante::tools {
namespace {

struct Arguments {
  client::ServerOptions server;
  std::string stream = "demo";
  std::string model;
  std::optional<std::uint32_t> max_vertices;
  std::string role = "subscribe";
  std::filesystem::path frames_file;
  std::filesystem::path record;
  std::size_t frames = 25;
  double fps = 0;
  double timeout = 10;
  bool json = false;
  OutputOptions output;
};

std::chrono::milliseconds patience(const Arguments& arguments) {
  return std::chrono::milliseconds(static_cast<long long>(arguments.timeout * 1000));
}

client::LiveStream open_stream(const client::ServerAddress& server, const Arguments& arguments, StreamRole role) {
  client::LiveStreamOptions options;
  options.socket = {.json = arguments.json, .timeout = patience(arguments)};
  options.role = role;
  return {server, arguments.stream, options};
}

Status publish(const client::ServerAddress& server, const Arguments& arguments) {
  const auto bytes = read_file(arguments.frames_file);
  if (!bytes) {
    return bytes.error();
  }
  const auto frames = decode_json_frames({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
  if (!frames) {
    Error error = in_file(arguments.frames_file, frames.error());
    if (frames.error().where == "/frames")
      error.message += "; frames of a performance or a take: semblante convert FILE --out frames.json";
    return error;
  }
  client::LiveStream stream = open_stream(server, arguments, StreamRole::publish);
  const auto sent = publish_frames(stream, *frames, patience(arguments));
  stream.close();
  if (!sent) {
    return sent.error();
  }
  std::cout << *sent << " frames published to " << arguments.stream << '\n';
  return Unit{};
}

/// Adds the faces to write to `collected`: all received states, or linear interpolation at a display's own rate. All
/// are read before the first is written, since writing is slower than a stream and a subscriber that reads late gets
/// the newest state instead of every state. What came before an error is kept.
Status collect(client::FramePlayer& player, std::size_t count, double fps,
               std::vector<client::DisplayedFrame>& collected) {
  double start = 0;
  while (collected.size() < count) {
    std::optional<client::DisplayedFrame> shown;
    if (fps > 0) {
      auto frame = player.at(start + static_cast<double>(collected.size()) * 1000.0 / fps);
      if (!frame) {
        return std::move(frame).error();
      }
      shown = *frame;
      if (shown && collected.empty()) {
        start = shown->from.media_time;
        shown->media_time = start;
      }
    } else {
      auto frame = player.next_received();
      if (!frame) {
        return std::move(frame).error();
      }
      if (*frame) {
        shown = client::DisplayedFrame{**frame, **frame, 0.0F, (*frame)->media_time};
      }
    }
    if (!shown) {
      return Error{ErrorCode::io, "stream", "the stream ended after " + std::to_string(collected.size()) + " frames"};
    }
    collected.push_back(*shown);
  }
  return Unit{};
}

Status write_all(const std::vector<client::DisplayedFrame>& frames, client::Face& face, FrameOutput& output) {
  for (const client::DisplayedFrame& frame : frames) {
    if (semblante_head_set_interpolated(face.head(), &frame.from.frame, &frame.to.frame, frame.t) != SEMBLANTE_OK) {
      return Error{ErrorCode::not_finite, "stream", "a frame has a value that is not a finite number"};
    }
    if (auto written = output.write(frame.from.sequence, frame.media_time); !written) {
      return written;
    }
  }
  return output.finish();
}

/// Writes the stream as the JSON accepted for publishing: the first frame is at 0. What came before an error is kept.
Status record(client::LiveStream& stream, client::FramePlayer& player, const Arguments& arguments) {
  std::vector<TimedValues> frames;
  std::optional<Error> fault;
  double begin = 0;
  while (frames.size() < arguments.frames) {
    auto frame = player.next_received();
    if (!frame) {
      fault = std::move(frame).error();
      break;
    }
    if (!*frame) {
      break;  // keeps the frames until the end of the stream
    }
    begin = frames.empty() ? (*frame)->media_time : begin;
    const double since = std::max(0.0, (*frame)->media_time - begin);
    const std::uint32_t before = frames.empty() ? 0 : frames.back().time;
    frames.push_back({std::max(before, static_cast<std::uint32_t>(std::lround(since))), to_values((*frame)->frame)});
  }
  stream.close();
  if (frames.empty()) {
    return fault ? *fault : Error{ErrorCode::empty, arguments.stream, "the stream ended before its first frame"};
  }
  if (auto written = write_file(arguments.record, encode_json_values(frames)); !written) {
    return written;
  }
  std::cout << frames.size() << " frames of " << arguments.stream << " in " << arguments.record.string() << '\n';
  return fault ? Status(*fault) : Unit{};
}

Status subscribe(const client::ServerAddress& server, const Arguments& arguments) {
  client::HttpLimits limits;
  limits.timeout = patience(arguments);
  const client::HttpClient http(server, limits);
  client::LiveStream stream = open_stream(server, arguments, StreamRole::subscribe);
  client::FramePlayer player(stream, limits.timeout);
  if (auto header = player.wait_for_header(); !header) {
    return header;
  }
  if (!arguments.record.empty()) {
    return record(stream, player, arguments);
  }
  const std::string model = arguments.model.empty() ? player.header()->model : arguments.model;
  if (model.empty()) {
    return Error{ErrorCode::missing, arguments.stream, "the stream suggests no model; set one with --model"};
  }
  auto face = client::load_face(http, model, {.lod = std::nullopt, .max_vertices = arguments.max_vertices});
  if (!face) {
    return std::move(face).error();
  }
  face->play_by(*player.header());
  const auto& formats = arguments.output.formats;
  if (std::find(formats.begin(), formats.end(), "png") != formats.end()) {
    for (const std::string& warning : client::fetch_images(http, *face)) {
      std::cerr << "semblante-client: " << warning << '\n';
    }
  }
  auto output = FrameOutput::create(*face, arguments.output);
  if (!output) {
    return std::move(output).error();
  }
  std::vector<client::DisplayedFrame> frames;
  const Status complete = collect(player, arguments.frames, arguments.fps, frames);
  stream.close();
  if (frames.empty()) {
    return complete;
  }
  if (auto written = write_all(frames, *face, *output); !written) {
    return written;
  }
  std::cout << frames.size() << " frames of " << face->rig().name << " (" << face->rig().mesh.vertices
            << " vertices) in " << arguments.output.folder.string() << '\n';
  return complete;
}

Status run(const Arguments& arguments) {
  auto server = arguments.server.parse();
  if (!server) {
    return std::move(server).error();
  }
  return arguments.role == "publish" ? publish(*server, arguments) : subscribe(*server, arguments);
}

}  // namespace
}  // namespace semblante::tools

// Only a mistake in the options themselves throws outside a try: it may end the program.
int main(int argc, char** argv) {  // NOLINT(bugprone-exception-escape)
  semblante::tools::Arguments arguments;
  CLI::App app{
      "Follows a stream of a Semblante server and writes the frames of a face, or publishes frames to a stream.",
      "semblante-client"};
  app.add_option("url", arguments.server.address, "http://HOST:PORT or https://HOST of the server")->required();
  semblante::client::declare_access_options(app, arguments.server);
  app.add_option("-s,--stream", arguments.stream, "id of the stream")->capture_default_str();
  app.add_option("-m,--model", arguments.model, "id of the model; default: the one the stream suggests");
  app.add_option("--max-vertices", arguments.max_vertices, "use the level of detail with at most this many vertices")
      ->check(CLI::PositiveNumber);
  app.add_option("-n,--frames", arguments.frames, "number of frames to write")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  app.add_option("--fps", arguments.fps, "frames per second of stream time, interpolated; 0: each received frame")
      ->check(CLI::Range(0.0, 1000.0))
      ->capture_default_str();
  app.add_option("-o,--out", arguments.output.folder, "folder for frame-00000.* and frames.csv");
  app.add_option("--record", arguments.record,
                 "file for the received frames as JSON {\"frames\": [...]}, instead of --out");
  app.add_option("-f,--format", arguments.output.formats, "obj, ply, png, table; repeatable")->capture_default_str();
  app.add_option("--shot", arguments.output.shot, "VIEW or VIEW:SUBJECT of the PNG")->capture_default_str();
  app.add_option("--size", arguments.output.size, "size of the PNG in pixels")->capture_default_str();
  app.add_option("--role", arguments.role, "subscribe or publish")
      ->check(CLI::IsMember({"subscribe", "publish"}))
      ->capture_default_str();
  app.add_option("--frames-file", arguments.frames_file, "frames for --role publish, as JSON {\"frames\": [...]}");
  app.add_option("--timeout", arguments.timeout, "seconds to wait for the server")
      ->check(CLI::Range(0.1, 3600.0))
      ->capture_default_str();
  app.add_flag("--json", arguments.json, "use the JSON subprotocol instead of the binary one");
  app.callback([&] {
    if (arguments.role == "publish" && arguments.frames_file.empty()) {
      throw CLI::RequiredError("--frames-file");
    }
    if (arguments.role == "subscribe" && arguments.output.folder.empty() && arguments.record.empty()) {
      throw CLI::RequiredError("--out");
    }
  });
  return semblante::tools::run_tool(app, argc, argv, [&] { return semblante::tools::run(arguments); });
}
