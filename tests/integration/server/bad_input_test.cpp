// Bad input that a first user sends: files that lack what they name, points of another frame, handshakes of another
// time. Each answer names the field, in a form that can be read, and the server goes on.

#include <cctype>
#include <chrono>
#include <cstdint>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/integration/server/model_flow.h"
#include "tests/integration/server/shared_server.h"

namespace semblante::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class BadInput : public SharedServer {
 protected:
  static void SetUpTestSuite() { start(); }
  void TearDown() override { EXPECT_EQ(request(port(), "GET", "/healthz").status, 200) << "the server goes on"; }

  static json put(const std::string& model, const std::string& text) {
    return json_of(request(port(), "PUT", "/v1/models/" + model + "/feature-points", text, json_type));
  }
};

/// A zip with one stored file: local header, directory, end. The CRC is of the content given here.
std::string stored_zip(const std::string& name, const std::string& content, std::uint32_t crc) {
  const auto number = [](std::uint64_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text.push_back(static_cast<char>((value >> (8 * i)) & 0xFFU));
    return text;
  };
  const auto sizes = number(crc, 4) + number(content.size(), 4) + number(content.size(), 4) + number(name.size(), 2);
  const auto local = "PK\x03\x04" + number(20, 2) + number(0, 8) + sizes + number(0, 2) + name + content;
  const auto entry = "PK\x01\x02" + number(20, 2) + number(20, 2) + number(0, 8) + sizes + number(0, 16) + name;
  return local + entry + "PK\x05\x06" + number(0, 4) + number(1, 2) + number(1, 2) + number(entry.size(), 4) +
         number(local.size(), 4) + number(0, 2);
}

/// What a file lacks is the file's fault, not that of feature points nobody has sent yet.
TEST_F(BadInput, ZipWithoutModel_IsAMalformedModel) {
  const auto zip = stored_zip("readme.txt", "hi", 0xD8932AAC);  // CRC-32 of "hi"
  const auto made =
      json_of(request(port(), "POST", "/v1/models?filename=a.zip", zip, {{"Content-Type", "application/zip"}}));
  const auto problem = wait_for_job(port(), made["job"]["id"])["problem"];
  EXPECT_EQ(problem["type"], "/problems/malformed-model") << problem;
  EXPECT_THAT(problem.value("detail", ""), HasSubstr("no .gltf, .glb, .vrm, .obj, .ply or .stl file"));
  EXPECT_EQ(problem["advice"], "export-as-glb");
}

/// A misspelt parameter would otherwise be a wish that nobody has heard.
TEST_F(BadInput, UnknownParameter_IsRefusedByEveryRouteWithThoseItHas) {
  const auto document = json_of(request(port(), "GET", "/openapi.json"));
  for (const auto& [pattern, item] : document["paths"].items())
    for (const auto& [name, operation] : item.items()) {
      std::string method = name, path = pattern;
      if (!path.starts_with("/v1/")) continue;
      for (char& c : method) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
      for (auto open = path.find('{'); open != std::string::npos; open = path.find('{'))
        path.replace(open, path.find('}', open) + 1 - open, "x");
      SCOPED_TRACE(method + " " + path);
      const auto problem = json_of(request(port(), method, path + "?lmit=1"));
      EXPECT_EQ(problem["type"], "/problems/invalid-argument") << problem;
      EXPECT_EQ(problem["pointer"], "?lmit");
      for (auto parameter : operation.value("parameters", json::array())) {
        if (parameter.contains("$ref"))
          parameter = document.at(json::json_pointer(parameter["$ref"].get<std::string>().substr(1)));
        if (parameter["in"] != "query") continue;
        EXPECT_THAT(problem.value("detail", ""), HasSubstr(parameter["name"].get<std::string>()));
      }
    }
  EXPECT_EQ(request(port(), "GET", "/healthz?lmit=1").status, 200) << "probes may add their own";
  EXPECT_EQ(json_of(request(port(), "GET", "/v1/models?lmit=1"))["detail"],
            "there is no parameter \"lmit\" here; this route has limit and after");
  EXPECT_EQ(json_of(request(port(), "GET", "/v1/voices?limit=1"))["detail"],
            "there is no parameter \"limit\" here; this route has none");
}

TEST_F(BadInput, QueryParameterGivenTwice_IsNamed) {
  const auto problem = json_of(request(port(), "GET", "/v1/models?limit=1&after=&limit=1"));
  EXPECT_EQ(problem["type"], "/problems/invalid-argument") << problem;
  EXPECT_EQ(problem["pointer"], "?limit");
  EXPECT_EQ(problem["detail"], "the parameter \"limit\" is given twice");
  EXPECT_EQ(request(port(), "GET", "/healthz?probe=1&probe=2").status, 200) << "probes may add their own";
}

TEST_F(BadInput, Pointers_EscapeWhatNamesHold) {
  const auto model = import_grid(port());
  EXPECT_EQ(put(model, R"({"points":{"a/b~c":{"vertex":1}}})")["pointer"], "/points/a~1b~0c");
  EXPECT_EQ(json_of(request(port(), "PATCH", "/v1/models/" + model, R"({"x/y":1})", json_type))["pointer"], "/x~1y");
  EXPECT_EQ(
      json_of(request(port(), "PATCH", "/v1/models/" + model, R"({"roles":{"0/1":"skin"}})", json_type))["pointer"],
      "/roles/0~11");
}

/// `semblante propose` writes the axes of a head that it has turned upright: its positions are those of the file.
TEST_F(BadInput, PointsWithAxes_AreInThoseOfTheModelsFile) {
  const auto model = import_grid(port());
  const std::string points = R"("points":{"2.1":{"position":[-1,1,0]}}})";  // vertex 12 of the file
  const auto as_is = put(model, "{" + points);
  EXPECT_EQ(as_is["points"]["2.1"], (json{{"vertex", 12}, {"position", {-1.0, 1.0, 0.0}}}));
  EXPECT_EQ(put(model, R"({"to_mpeg4_axes":[[1,0,0],[0,1,0],[0,0,1]],"vertex_index_base":0,)" + points), as_is);

  const auto turned = request(port(), "PATCH", "/v1/models/" + model, R"({"frame":{"up":"+Z","front":"-Y"}})",
                              {{"Content-Type", "application/merge-patch+json"}});
  ASSERT_EQ(turned.status, 202) << turned.body;
  const auto location = turned.headers.at("location");
  EXPECT_EQ(wait_for_job(port(), location.substr(location.rfind('/') + 1))["state"], "done");
  const std::string axes = R"({"to_mpeg4_axes":[[1,0,0],[0,0,1],[0,-1,0]],)";
  EXPECT_EQ(put(model, axes + points)["points"]["2.1"], (json{{"vertex", 12}, {"position", {-1.0, 0.0, -1.0}}}));
  EXPECT_TRUE(put(model, "{" + points)["points"]["2.1"]["vertex"].is_null()) << "it is in the axes of the model";

  for (const char* const refused : {"[[1,0,0],[0,1,0]]", "[[1,0,0],[0,1,0],[0,0]]", "[[-1,0,0],[0,1,0],[0,0,1]]",
                                    "[[1,0,0],[1,0,0],[0,0,1]]", "7"}) {
    const auto answer = put(model, std::string(R"({"to_mpeg4_axes":)") + refused + "," + points);
    EXPECT_EQ(answer["type"], "/problems/invalid-field") << refused;
    EXPECT_EQ(answer["pointer"], "/to_mpeg4_axes") << refused;
  }
  EXPECT_EQ(put(model, R"({"vertex_index_base":1,)" + points)["pointer"], "/vertex_index_base");
}

/// As many points as anything asks for, on vertices of import_grid's model.
nlohmann::json points_on_grid(const nlohmann::json& head_center) {
  nlohmann::json points{{"7.1", head_center}};
  int vertex = 4;
  for (const char* id : {"2.1", "2.2", "2.3", "8.1", "8.2", "9.3", "9.15", "11.4"}) {
    points[id] = {{"vertex", vertex}};
    vertex += 9;
  }
  return points;
}

/// A recording of the stream with some seconds in it.
std::string recording_of(int port, const std::string& stream) {
  const auto made = json_of(request(port, "POST", "/v1/streams/" + stream + "/recordings", "{}", json_type));
  const auto target = "/v1/recordings/" + made["id"].get<std::string>();
  EXPECT_TRUE(testing::eventually([&] {
    request(port, "POST", "/v1/streams/" + stream + "/frames", R"({"frames":[{"faps":{"3":80}}]})", json_type);
    return json_of(request(port, "GET", target))["duration"] >= 2000;
  }));
  return made["id"];
}

/// What the documentation shows as right must be taken: each JSON body's example goes to its route.
TEST_F(BadInput, ExamplesOfTheDocument_AreGoodInput) {
  const auto document = json_of(request(port(), "GET", "/openapi.json"));
  const auto model = import_grid(port());
  ASSERT_EQ(parametrize_grid(port(), model).value("state", ""), "done");  // for the example of a clip
  const auto set =
      json_of(request(port(), "POST", "/v1/expressions", R"({"name":"own","displacements":{}})", json_type));
  request(port(), "POST", "/v1/streams", R"({"name":"kept"})", json_type);
  const auto kept = recording_of(port(), "kept");
  std::size_t sent = 0;
  // Put before post: a parametrization needs points, proposals need eight.
  for (const std::string method : {"put", "patch", "post"}) {
    for (const auto& [path, item] : document["paths"].items()) {
      if (!item.contains(method) || !item[method].contains("requestBody")) continue;
      const auto& bodies = item[method]["requestBody"]["content"];
      if (!bodies.contains("application/json")) continue;
      SCOPED_TRACE(method + " " + path);
      auto example = bodies["application/json"].value("example", nlohmann::json());
      ASSERT_TRUE(example.is_object()) << "a body without an example";
      // The document speaks of a real head; here is a grid of one part and 81 vertices, and no sample.
      if (example.contains("points")) example["points"] = points_on_grid(example["points"]["7.1"]);
      if (example.contains("roles")) example["roles"] = {{"0", example["roles"]["3"]}};
      if (example.contains("model")) example["model"] = model;
      if (path.ends_with("/speech")) example["take_over"] = true;  // the performance of the example before still plays
      if (example.contains("recording")) example["recording"] = recording_of(port(), "hello");
      auto target = path;
      if (const auto at = target.find("{model}"); at != std::string::npos) target.replace(at, 7, model);
      if (const auto at = target.find("{stream}"); at != std::string::npos) target.replace(at, 8, "hello");
      if (const auto at = target.find("{expression}"); at != std::string::npos)
        target.replace(at, 12, set["id"].get<std::string>());
      if (const auto at = target.find("{recording}"); at != std::string::npos) target.replace(at, 11, kept);
      auto upper = method;
      for (auto& c : upper) c = static_cast<char>(std::toupper(c));
      const auto reply = request(port(), upper, target, example.dump(), json_type);
      EXPECT_LT(reply.status, 300) << example << " " << reply.body;
      ++sent;
    }
  }
  EXPECT_EQ(sent, 19U);
}

/// curl --data sends a form's type unless it is told otherwise.
TEST_F(BadInput, WrongMediaType_IsToldTheRightOne) {
  const Fields form = {{"Content-Type", "application/x-www-form-urlencoded"}};
  const auto frames = request(port(), "POST", "/v1/streams", R"({"name":"form"})", form);
  EXPECT_EQ(frames.status, 415);
  EXPECT_THAT(json_of(frames).value("detail", ""), HasSubstr("application/json"));
  const auto model = request(port(), "POST", "/v1/models?filename=a.obj", grid_obj(4), form);
  EXPECT_EQ(model.status, 415);
  EXPECT_THAT(json_of(model).value("detail", ""), HasSubstr("application/octet-stream"));
}

/// Read as UTF-8, "é" of another charset would be no text, or another one.
TEST_F(BadInput, JsonOfAnotherCharset_IsRefused) {
  const auto create = [](const char* name, const char* type) {
    return request(port(), "POST", "/v1/streams", json{{"name", name}}.dump(), {{"Content-Type", type}});
  };
  for (const char* other : {"application/json; charset=utf-16", "application/json;charset=\"ISO-8859-1\""}) {
    const auto refused = create("charset", other);
    EXPECT_EQ(refused.status, 415) << other;
    EXPECT_THAT(json_of(refused).value("detail", ""), HasSubstr("UTF-8"));
  }
  EXPECT_EQ(create("charset-utf-8", "application/json; charset=\"UTF-8\"").status, 201);
  EXPECT_EQ(create("charset-ascii", "application/json; charset=us-ascii").status, 201);
}

/// A compressed body would fail its import much later, as a file of no format.
TEST_F(BadInput, CompressedBody_IsRefusedBeforeItIsStored) {
  const auto with_coding = [](const char* path, const std::string& body, const char* type, const char* coding) {
    return request(port(), "POST", path, body, {{"Content-Type", type}, {"Content-Encoding", coding}});
  };
  const auto model = with_coding("/v1/models?filename=a.obj", "\x1F\x8B\x08 and more", "model/obj", "gzip");
  EXPECT_EQ(model.status, 415) << model.body;
  EXPECT_THAT(json_of(model).value("detail", ""), HasSubstr("Content-Encoding"));
  EXPECT_EQ(with_coding("/v1/streams", "x", "application/json", "br").status, 415);
  EXPECT_EQ(with_coding("/v1/models?filename=a.obj", grid_obj(4), "model/obj", "identity").status, 202);
}

TEST_F(BadInput, NamesOfUploads_AreWholeCharacters_AndNeverBlank) {
  std::string long_name = "a";
  for (int i = 0; i < 200; ++i) long_name += "%C3%A9";  // of two bytes
  const Fields type = {{"Content-Type", "model/obj"}};
  const auto named = request(port(), "POST", "/v1/models?filename=" + long_name + ".obj", grid_obj(4), type);
  ASSERT_EQ(named.status, 202) << named.body;
  EXPECT_EQ(named.body.find("\xEF\xBF\xBD"), std::string::npos) << "half a character: " << named.body;
  // U+202E: what follows is shown from right to left.
  const auto turned = request(port(), "POST", "/v1/models?filename=a%E2%80%AEb.obj", grid_obj(4), type);
  ASSERT_EQ(turned.status, 202) << turned.body;
  EXPECT_EQ(json_of(turned)["model"]["name"], "ab");
  EXPECT_EQ(request(port(), "POST", "/v1/models?filename=a.obj&name=%20%20", grid_obj(4), type).status, 422);
  // U+200B and U+2060 have no width.
  EXPECT_EQ(request(port(), "POST", "/v1/models?filename=a.obj&name=%E2%80%8B%E2%81%A0", grid_obj(4), type).status,
            422);
  const auto unseen = request(port(), "POST", "/v1/models?filename=%E2%80%8B.obj", grid_obj(4), type);
  ASSERT_EQ(unseen.status, 202) << unseen.body;
  EXPECT_EQ(json_of(unseen)["model"]["name"], "Untitled");
}

TEST_F(BadInput, FormWithTwoFiles_IsRefused_NotHalfOfItTaken) {
  const auto part = [](const std::string& name, const std::string& content) {
    return "--Q\r\nContent-Disposition: form-data; name=\"file\"; filename=\"" + name + "\"\r\n\r\n" + content + "\r\n";
  };
  const auto reply =
      request(port(), "POST", "/v1/models", part("a.obj", grid_obj(4)) + part("a.mtl", "newmtl a") + "--Q--",
              {{"Content-Type", "multipart/form-data; boundary=Q"}});
  EXPECT_EQ(reply.status, 422) << reply.body;
  EXPECT_EQ(json_of(reply).value("advice", ""), "send-all-files");
}

TEST_F(BadInput, BrokenHandshakes_GetProblemDocuments) {
  request(port(), "POST", "/v1/streams", R"({"name":"shake"})", json_type);
  const auto handshake = [](const std::string& version, const std::string& key) {
    return parse_reply(raw_exchange(port(),
                                    "GET /v1/streams/shake HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\n"
                                    "Connection: Upgrade\r\nSec-WebSocket-Version: " +
                                        version + "\r\nSec-WebSocket-Key: " + key + "\r\n\r\n"));
  };
  const auto old = handshake("8", "AAAAAAAAAAAAAAAAAAAAAA==");
  EXPECT_EQ(old.status, 426);
  EXPECT_EQ(old.headers.at("sec-websocket-version"), "13");
  EXPECT_EQ(json_of(old)["type"], "/problems/upgrade-required");
  const auto short_key = handshake("13", "abc");
  EXPECT_EQ(short_key.status, 400);
  EXPECT_EQ(json_of(short_key)["type"], "/problems/malformed-request");
}

/// SPEC.md: `version` is the highest the client knows; the header says which one is spoken.
TEST_F(BadInput, HelloOfALaterVersion_IsAnsweredInOurs) {
  request(port(), "POST", "/v1/streams", R"({"name":"later"})", json_type);
  WebSocket later(port(), "/v1/streams/later", "semblante.v1.json");
  later.send_text(R"({"type":"hello","version":99,"role":"subscribe"})");
  const auto header = json::parse(later.receive().value_or("{}"));
  EXPECT_EQ(header["type"], "header");
  EXPECT_EQ(header["version"], 1);
  WebSocket never(port(), "/v1/streams/later", "semblante.v1.json");
  never.send_text(R"({"type":"hello","version":0,"role":"subscribe"})");
  EXPECT_EQ(json::parse(never.receive().value_or("{}"))["where"], "/version");
}

/// The limits are those of SPEC.md: 256 KiB of binary, 1 MiB of JSON.
TEST_F(BadInput, LongMessages_AreTakenUpToTheLimitOfTheirSubprotocol) {
  request(port(), "POST", "/v1/streams", R"({"name":"long"})", json_type);
  WebSocket json_socket(port(), "/v1/streams/long", "semblante.v1.json");
  json_socket.send_text(R"({"type":"hello","version":1,"role":"subscribe","pad":")" + std::string(900'000, ' ') +
                        "\"}");
  EXPECT_EQ(json::parse(json_socket.receive().value_or("{}"))["type"], "header");
  WebSocket too_long(port(), "/v1/streams/long", "semblante.v1.json");
  too_long.send_text(std::string((1U << 20U) + 1, ' '));
  EXPECT_EQ(too_long.receive(), std::nullopt);
  EXPECT_EQ(too_long.close_code(), 1009);
  WebSocket binary(port(), "/v1/streams/long", "semblante.v1");
  binary.send(std::string((1U << 18U) + 1, ' '), true);
  EXPECT_EQ(binary.receive(), std::nullopt);
  EXPECT_EQ(binary.close_code(), 1009);
}

// ---- what surrounds the pieces of a chunked body ----------------------------------------------------------------

/// The most memory the server has had, bytes.
std::uint64_t peak_memory(pid_t pid) {
  std::ifstream status("/proc/" + std::to_string(pid) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return std::stoull(line.substr(6)) * 1024;
  ADD_FAILURE() << "no VmHWM";
  return 0;
}

Reply chunked(int port, const std::string& chunks) {
  return parse_reply(raw_exchange(
      port,
      "GET /version HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\nTransfer-Encoding: chunked\r\n\r\n" + chunks));
}

void expect_slug(const Reply& reply, int status, const std::string& slug) {
  EXPECT_EQ(reply.status, status) << reply.body;
  const auto problem = json::parse(reply.body, nullptr, false);
  ASSERT_TRUE(problem.is_object()) << reply.body;
  EXPECT_EQ(problem.value("type", ""), "/problems/" + slug);
  EXPECT_FALSE(problem.value("detail", "").empty());
}

TEST_F(BadInput, TrailerOf66000Bytes_IsRefused) {
  expect_slug(chunked(port(), "0\r\nX: " + std::string(66'000, 'a') + "\r\n\r\n"), 431, "header-too-large");
}

TEST_F(BadInput, MegabytesOfTrailers_AreRefusedAndNotKept) {
  std::string trailers = "0\r\n";
  while (trailers.size() < (std::size_t{48} << 20U)) trailers += "X: " + std::string(60'000, 'a') + "\r\n";
  const auto before = peak_memory(server().pid());
  expect_slug(chunked(port(), trailers + "\r\n"), 431, "header-too-large");
  EXPECT_LT(peak_memory(server().pid()) - before, std::uint64_t{8} << 20U);
}

TEST_F(BadInput, ThousandsOfSmallTrailers_AreRefused) {
  std::string trailers = "0\r\n";
  for (int i = 0; i < 20'000; ++i) trailers += "a" + std::to_string(i) + ":b\r\n";
  expect_slug(chunked(port(), trailers + "\r\n"), 431, "header-too-large");
}

TEST_F(BadInput, GiantChunkLines_AreRefused) {
  const std::string chunk = "\r\nx\r\n0\r\n\r\n";
  expect_slug(chunked(port(), "1;" + std::string(8U << 20U, 'e') + chunk), 400, "malformed-request");
  expect_slug(chunked(port(), std::string(1U << 20U, '0') + "1" + chunk), 400, "malformed-request");
  std::string many;
  for (int i = 0; i < 100; ++i) many += "1;" + std::string(1000, 'e') + "\r\nx\r\n";
  expect_slug(chunked(port(), many + "0\r\n\r\n"), 400, "malformed-request");
  expect_slug(chunked(port(), "0;" + std::string(66'000, 'e') + "\r\n\r\n"), 400, "malformed-request");
}

TEST_F(BadInput, SmallTrailersAndExtensions_AreTaken) {
  const auto reply = chunked(port(), "3;a=b\r\nabc\r\n1\r\nd\r\n0;last\r\nX: y\r\nZ: w\r\n\r\n");
  EXPECT_EQ(reply.status, 200) << reply.body;
}

TEST_F(BadInput, HeaderOfThousandsOfFields_IsRefused) {
  std::string fields, parameters = "?";
  for (int i = 0; i < 1200; ++i) {  // well below 16 KiB
    fields += "a" + std::to_string(i) + ":\r\n";
    parameters += "&a" + std::to_string(i);
  }
  expect_slug(parse_reply(raw_exchange(port(), "GET /version HTTP/1.1\r\nHost: localhost\r\n" + fields + "\r\n")), 431,
              "header-too-large");
  expect_slug(parse_reply(raw_exchange(port(), "GET /version" + parameters + " HTTP/1.1\r\nHost: localhost\r\n\r\n")),
              431, "header-too-large");
}

}  // namespace
}  // namespace semblante::test
