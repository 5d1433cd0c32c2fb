// The real server, the real gateways and UDP packets on loopback.

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "clients/gateways/net/udp_socket.h"
#include "clients/gateways/vmc/values.h"
#include "core/bridges/head_turn.h"
#include "protocol/cpp/kernel_values.h"
#include "protocol/cpp/quantizers.h"
#include "protocol/http/http_client.h"
#include "tests/integration/client/child_process.h"
#include "tests/support/stream_speaker.h"
#include "tests/support/wait.h"
#include "tests/unit/gateways/golden_packets.h"

namespace semblante::testing {
namespace {

using namespace std::chrono_literals;
using gateways::UdpSocket;

/// The server without a model: streams need none.
class BareServer {
 public:
  BareServer() { start("0"); }
  ~BareServer() {
    stop();
    std::filesystem::remove_all(folder_);
  }
  BareServer(const BareServer&) = delete;
  BareServer& operator=(const BareServer&) = delete;

  void start(const std::string& port) {
    process_ = std::make_unique<ChildProcess>(std::vector<std::string>{
        SEMBLANTE_SERVER, "serve", "--port", port, "--data", folder_.string(), "--log-level", "error"});
    const std::string line = process_->read_line(patience);
    const std::size_t at = line.find("http://");
    const auto url =
        client::parse_url(at == std::string::npos ? std::string_view() : std::string_view(line).substr(at));
    ASSERT_TRUE(url) << "the server said: " << line;
    url_ = *url;
  }
  void stop() {
    if (!process_) return;
    process_->interrupt();
    EXPECT_EQ(process_->wait(patience), 0) << "the server stops cleanly";
    process_.reset();
  }

  [[nodiscard]] const client::Url& url() const { return url_; }
  [[nodiscard]] std::string address() const { return "http://" + url_.authority(); }
  [[nodiscard]] nlohmann::json stream(const std::string& name) const {
    const auto answer = client::HttpClient(url_).get("/v1/streams/" + name);
    return answer && answer->status == 200 ? nlohmann::json::parse(answer->body, nullptr, false) : nlohmann::json();
  }
  void create(const std::string& name) const {
    const auto made = client::HttpClient(url_).post("/v1/streams", R"({"name":")" + name + "\"}", "application/json");
    ASSERT_TRUE(made && made->status == 201);
  }
  void post(const std::string& name, const std::string& frame) const {
    const auto posted = client::HttpClient(url_).post("/v1/streams/" + name + "/frames",
                                                      R"({"frames":[)" + frame + "]}", "application/json");
    ASSERT_TRUE(posted && posted->status == 202) << (posted ? posted->body : posted.error().message);
  }

 private:
  static std::filesystem::path make_folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "semblante-gateways-XXXXXX").string();
    return mkdtemp(pattern.data());
  }

  std::filesystem::path folder_ = make_folder();
  std::unique_ptr<ChildProcess> process_;
  client::Url url_;
};

/// The port in "listening at 127.0.0.1 port 40001 for stream show".
std::string port_of(const std::string& line) {
  const std::size_t at = line.find(" port ");
  EXPECT_NE(at, std::string::npos) << line;
  return line.substr(at + 6, line.find(' ', at + 6) - at - 6);
}

class Gateways : public ::testing::Test {
 protected:
  std::unique_ptr<ChildProcess> start_in(const std::string& program, const std::string& stream,
                                         std::vector<std::string> more = {}) {
    std::vector<std::string> command = {program};
    if (program == SEMBLANTE_VMC) command.emplace_back("in");
    for (const auto* word : {"--server", ""}) command.emplace_back(word);
    command.back() = server.address();
    command.insert(command.end(), {"--stream", stream, "--create", "--listen", "127.0.0.1:0"});
    command.insert(command.end(), more.begin(), more.end());
    auto process = std::make_unique<ChildProcess>(command);
    in_port = port_of(process->read_line(patience));
    EXPECT_TRUE(eventually([&] { return publishes(stream); })) << "the gateway publishes";
    return process;
  }
  bool publishes(const std::string& stream) {
    const auto said = server.stream(stream);
    return said.is_object() && said.value("publishers", 0) == 1;
  }

  /// Sends packets until a state that `wanted` likes has come to a subscriber; UDP may lose some, even here.
  void send_until(const std::vector<Bytes>& packets, const std::string& stream,
                  const std::function<bool(const FaceFrame&)>& wanted) {
    auto socket = UdpSocket::send_to({"127.0.0.1", in_port}, false);
    ASSERT_TRUE(socket);
    auto subscriber = StreamSpeaker::connect(server.url(), stream);
    ASSERT_TRUE(subscriber) << subscriber.error().message;
    ASSERT_TRUE(eventually([&] {
      for (const Bytes& packet : packets) socket->send(packet);
      const auto message = subscriber->next(200ms);
      if (!message || !*message) return false;
      if (const auto* key = std::get_if<Keyframe>(&**message)) return wanted(key->state);
      const auto* frames = std::get_if<Frames>(&**message);
      return frames != nullptr && wanted(frames->frames.back().state);
    })) << "the face did not come";
  }

  static std::vector<Bytes> golden_sequence(const std::string& name) {
    std::vector<Bytes> packets;
    const auto file = golden("vmc.json");
    for (const auto& sequence : file["sequences"]) {
      if (sequence["name"] != name) continue;
      for (const auto& packet : sequence["packets"]) packets.push_back(from_hex(packet["hex"]));
    }
    EXPECT_FALSE(packets.empty()) << name;
    return packets;
  }

  BareServer server;
  std::string in_port;
};

TEST_F(Gateways, VmcPackets_ReachASubscriberAsFaps) {
  auto gateway = start_in(SEMBLANTE_VMC, "show");
  ArkitCoefficients coefficients{};
  coefficients[find_arkit("jawOpen").value()] = 0.3F;
  semblante_frame frame = frame_from_arkit(coefficients)->frame;
  turn_head(frame, {-20.0F * 3.14159265F / 180.0F, 0.0F, 0.0F});
  const FaceFrame expected = quantized(frame);
  ASSERT_GT(expected.level[49], 0);
  send_until(golden_sequence("bones after Apply in the same bundle belong to the face"), "show",
             [&](const FaceFrame& state) { return state == expected; });
  send_until({{1, 2, 3, 4}}, "show", [&](const FaceFrame& state) { return state == expected; });
  gateway->interrupt();
  const std::string counts = gateway->read_line(patience);
  EXPECT_EQ(gateway->wait(patience), 0);
  EXPECT_TRUE(counts.starts_with("packets ")) << counts;
  EXPECT_EQ(counts.find("refused 0,"), std::string::npos) << counts;
}

TEST_F(Gateways, LiveLinkPackets_ReachASubscriberAsFaps) {
  auto gateway = start_in(SEMBLANTE_LIVELINK, "phone", {"--subject", "iPhone"});
  const auto entry = golden("live_link.json")["packets"][0];
  ArkitCoefficients coefficients{};
  for (std::size_t i = 0; i < arkit_count; ++i) coefficients[i] = entry["values"][i];
  semblante_frame frame = frame_from_arkit(coefficients)->frame;
  turn_head(frame, {entry["values"][52], entry["values"][53], entry["values"][54]});
  send_until({from_hex(entry["hex"])}, "phone",
             [expected = quantized(frame)](const FaceFrame& state) { return state == expected; });
  gateway->interrupt();
  EXPECT_EQ(gateway->wait(patience), 0);
}

TEST_F(Gateways, VmcOutIntoAnotherStreamsVmcIn_BringsBackWhatTheBridgeKeeps) {
  server.create("stage");
  auto in = start_in(SEMBLANTE_VMC, "mirror");
  ChildProcess out(
      {SEMBLANTE_VMC, "out", "--server", server.address(), "--stream", "stage", "--to", "127.0.0.1:" + in_port});
  ASSERT_TRUE(out.read_line(patience).starts_with("sending stream stage"));
  server.post("stage", R"({"viseme":{"select1":10,"select2":0,"blend":40},
                           "expression":{"select1":1,"intensity1":50,"select2":0,"intensity2":0},
                           "faps":{"19":300,"20":300,"23":12000,"24":11000,"25":-5000,"26":-5000,
                                   "31":120,"32":120,"48":9000,"49":-25000,"50":4000}})");
  const auto sent = server.stream("stage");
  ASSERT_EQ(sent.value("sequence", 0), 1);

  // What was posted, as the stream has it.
  semblante_frame posted{};
  posted.viseme1 = 10;
  posted.viseme_blend = 40;
  posted.expression1 = 1;
  posted.intensity1 = 50;
  const std::map<std::size_t, float> faps = {{19, 300}, {20, 300}, {23, 12000}, {24, 11000},  {25, -5000}, {26, -5000},
                                             {31, 120}, {32, 120}, {48, 9000},  {49, -25000}, {50, 4000}};
  for (const auto& [fap, value] : faps) posted.fap[fap] = value;
  posted = to_kernel_frame(to_values(quantized(posted)));
  std::size_t clamped = 0;
  const FaceFrame expected = quantized(vmc::face_from_values(vmc::values_from_face(posted, true, true), clamped));

  // The reading in ARKit's terms is the bridge's; beyond it, a float more or less may round to the next level.
  const auto alike = [&](const FaceFrame& state) {
    if (state.expression != expected.expression || state.viseme.select1 != expected.viseme.select1) return false;
    for (std::size_t n = first_low_level_fap; n <= last_low_level_fap; ++n) {
      if (std::abs(state.level[n] - expected.level[n]) > 1) return false;
    }
    return std::abs(state.viseme.blend - expected.viseme.blend) <= 1;
  };
  EXPECT_EQ(expected.expression.intensity1, 50);
  EXPECT_NE(expected.level[49], 0);
  send_until({}, "mirror", alike);
  for (ChildProcess* process : {&out, in.get()}) {
    process->interrupt();
    EXPECT_TRUE(process->read_line(patience).starts_with("packets "));
    EXPECT_EQ(process->wait(patience), 0);
  }
}

TEST_F(Gateways, AServerThatStartsAgain_IsPublishedToAgain) {
  auto gateway = start_in(SEMBLANTE_VMC, "show");
  const std::string port = server.url().port;
  server.stop();
  server.start(port);
  EXPECT_TRUE(eventually([&] { return publishes("show"); })) << "the stream is made and published to again";
  send_until(golden_sequence("the head turned to its left by 20 degrees"), "show",
             [](const FaceFrame& state) { return state.level[49] > 0; });
  gateway->interrupt();
  EXPECT_EQ(gateway->wait(patience), 0);
}

TEST_F(Gateways, WhatCannotBe_EndsWithAnErrorAtOnce) {
  ChildProcess missing(
      {SEMBLANTE_VMC, "in", "--server", server.address(), "--stream", "nobody", "--listen", "127.0.0.1:0"});
  EXPECT_EQ(missing.wait(patience), 1) << "no such stream, and none to be made";
  ChildProcess nothing({SEMBLANTE_VMC, "out", "--server", server.address(), "--stream", "nobody"});
  EXPECT_EQ(nothing.wait(patience), 1);
  ChildProcess abroad({SEMBLANTE_VMC, "out", "--server", server.address(), "--stream", "x", "--to", "192.0.2.1"});
  EXPECT_EQ(abroad.wait(patience), 1) << "another machine, and --anywhere was not said";
}

}  // namespace
}  // namespace semblante::testing
