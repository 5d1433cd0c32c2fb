// Every route and every role on a stream, with no token, an expired, a revoked, a too weak and the right one.

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/integration/cli/program.h"
#include "tests/integration/server/model_flow.h"
#include "tests/integration/server/open_request.h"

namespace semblante::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

const std::vector<std::string> scopes = {"none", "read", "publish", "edit", "admin"};

Fields bearer(const std::string& token) { return {{"Authorization", "Bearer " + token}}; }

class Scopes : public ::testing::Test {
 protected:
  Scopes() {
    for (const auto& scope : scopes)
      if (scope != "none") tokens_[scope] = make({"--scope", scope});
    server_ = std::make_unique<ServerProcess>(
        data_.path(),
        std::vector<std::string>{"--require-tokens", "--client-requests", "0", "--client-failures", "1000000"});
  }
  std::string make(std::vector<std::string> options) {
    options.insert(options.begin(), {"token", "create", "--data", data_.path().string()});
    const auto made = run_semblante(options);
    EXPECT_EQ(made.exit_code, 0) << made.err;
    auto token = first_line(made.out);
    // A running server looks for new tokens once a second.
    if (server_) {
      EXPECT_TRUE(semblante::testing::eventually(
          [&] { return as(token, "GET", "/v1/session").body.find(R"("scope":"none")") == std::string::npos; }));
    }
    return token;
  }
  [[nodiscard]] int port() const { return server_->port(); }
  Reply as(const std::string& token, const std::string& method, const std::string& target,
           const std::string& body = {}) {
    auto fields = token.empty() ? Fields{} : bearer(token);
    if (!body.empty()) fields.emplace_back("Content-Type", "application/json");
    return request(port(), method, target, body, fields);
  }
  /// A token that has expired, or is revoked, by the time this returns.
  std::string expired() {
    const std::string token =
        json::parse(as(tokens_["admin"], "POST", "/v1/tokens", R"({"scope":"admin","expires_in":1})").body)["secret"];
    EXPECT_TRUE(semblante::testing::eventually(
        [&] { return as(token, "GET", "/v1/models").body.find("has expired") != std::string::npos; }));
    return token;
  }
  std::string revoked() {
    const auto made = json::parse(as(tokens_["admin"], "POST", "/v1/tokens", R"({"scope":"admin"})").body);
    const std::string secret = made["secret"], id = made["token"]["id"];
    EXPECT_EQ(as(secret, "GET", "/v1/models").status, 200);
    EXPECT_EQ(as(tokens_["admin"], "DELETE", "/v1/tokens/" + id).status, 204);
    return secret;
  }

  TemporaryFolder data_;
  std::map<std::string, std::string> tokens_;
  std::unique_ptr<ServerProcess> server_;
};

struct Operation {
  std::string method, target, scope;
};

std::vector<Operation> operations(const std::string& document) {
  std::vector<Operation> list;
  const auto parsed = json::parse(document);
  for (const auto& [path, item] : parsed["paths"].items()) {
    auto target = path;
    // Things that do not exist: the answer is about the token first.
    for (auto at = target.find('{'); at != std::string::npos; at = target.find('{'))
      target.replace(at, target.find('}') - at + 1, "nothing");
    for (const auto& [method, operation] : item.items()) {
      std::string upper = method;
      for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
      list.push_back({upper, target, operation["x-scope"]});
    }
  }
  return list;
}

TEST_F(Scopes, EveryRoute_AsksForItsScope) {
  const auto expired_token = expired(), revoked_token = revoked();
  const auto all = operations(request(port(), "GET", "/openapi.json").body);
  ASSERT_GT(all.size(), 50U);
  for (const auto& [method, target, scope] : all) {
    SCOPED_TRACE(method + " " + target);
    const auto status = [&, m = method, t = target](const std::string& token) { return as(token, m, t).status; };
    const auto needed = std::find(scopes.begin(), scopes.end(), scope) - scopes.begin();
    if (needed == 0) {
      EXPECT_NE(status(""), 401);
      EXPECT_NE(status(""), 403);
      continue;
    }
    EXPECT_EQ(status(""), 401);
    EXPECT_EQ(status(expired_token), 401);
    EXPECT_EQ(status(revoked_token), 401);
    for (long i = 1; i < needed; ++i)
      EXPECT_EQ(status(tokens_[scopes[static_cast<std::size_t>(i)]]), 403) << scopes[static_cast<std::size_t>(i)];
    const auto right = status(tokens_[scope]);
    EXPECT_NE(right, 401);
    EXPECT_NE(right, 403);
  }
}

TEST_F(Scopes, EveryRoleOnAStream_AsksForItsScope) {
  ASSERT_EQ(as(tokens_["edit"], "POST", "/v1/streams", R"({"name":"stage"})").status, 201);
  const auto expired_token = expired(), revoked_token = revoked();
  const auto opened = [&](const std::string& token) {
    return WebSocket(port(), "/v1/streams/stage", "semblante.v1.json", token.empty() ? Fields{} : bearer(token))
        .handshake()
        .status;
  };
  EXPECT_EQ(opened(""), 401);
  EXPECT_EQ(opened(expired_token), 401);
  EXPECT_EQ(opened(revoked_token), 401);
  EXPECT_EQ(opened("smb_none_of_ours"), 401);
  const auto hello = [&](const std::string& role, const std::string& token) {
    WebSocket socket(port(), "/v1/streams/stage", "semblante.v1.json", bearer(token));
    EXPECT_EQ(socket.handshake().status, 101);
    socket.send_text(json{{"type", "hello"}, {"version", 1}, {"role", role}}.dump());
    return socket.receive().value_or("");
  };
  EXPECT_THAT(hello("subscribe", tokens_["read"]), HasSubstr("\"header\""));
  EXPECT_THAT(hello("publish", tokens_["read"]), HasSubstr("\"unauthorized\""));
  EXPECT_THAT(hello("publish", tokens_["publish"]), HasSubstr("\"header\""));
}

TEST_F(Scopes, Subprotocol_CarriesTheToken_AndIsNotSaidBack) {
  ASSERT_EQ(as(tokens_["edit"], "POST", "/v1/streams", R"({"name":"stage"})").status, 201);
  WebSocket socket(port(), "/v1/streams/stage", "semblante.v1.json, semblante.bearer." + tokens_["read"]);
  EXPECT_EQ(socket.handshake().status, 101);
  EXPECT_EQ(socket.handshake().headers.at("sec-websocket-protocol"), "semblante.v1.json");
}

TEST_F(Scopes, RevokedToken_ClosesItsStreams) {
  ASSERT_EQ(as(tokens_["edit"], "POST", "/v1/streams", R"({"name":"stage"})").status, 201);
  const auto made = json::parse(as(tokens_["admin"], "POST", "/v1/tokens", R"({"scope":"read"})").body);
  const std::string secret = made["secret"];
  WebSocket socket(port(), "/v1/streams/stage", "semblante.v1.json", bearer(secret));
  WebSocket other(port(), "/v1/streams/stage", "semblante.v1.json", bearer(tokens_["read"]));
  for (auto* one : {&socket, &other}) one->send_text(R"({"type":"hello","version":1,"role":"subscribe"})");
  ASSERT_TRUE(socket.receive());
  ASSERT_EQ(run_semblante({"token", "revoke", "--data", data_.path().string(), made["token"]["id"]}).exit_code, 0);
  while (socket.receive()) {
  }
  EXPECT_EQ(socket.close_code(), 1008);
  EXPECT_EQ(as(secret, "GET", "/v1/models").status, 401);
  EXPECT_TRUE(other.receive());
  EXPECT_EQ(other.close_code(), 0) << "the others stay";
}

TEST_F(Scopes, RevokedToken_EndsTheUploadThatItHasBegun) {
  const auto made = json::parse(as(tokens_["admin"], "POST", "/v1/tokens", R"({"scope":"edit"})").body);
  const auto file = grid_obj(4);
  OpenRequest upload(port(),
                     "POST /v1/models?filename=late.obj HTTP/1.1\r\nHost: localhost\r\nContent-Type: model/obj\r\n" +
                         std::string("Authorization: Bearer ") + made["secret"].get<std::string>() +
                         "\r\nContent-Length: " + std::to_string(file.size()) + "\r\n\r\n");
  upload.send(file.substr(0, 10));
  ASSERT_TRUE(semblante::testing::eventually([&] { return !std::filesystem::is_empty(data_.path() / "tmp"); }))
      << "it was let in";
  const std::string id = made["token"]["id"];
  ASSERT_EQ(as(tokens_["admin"], "DELETE", "/v1/tokens/" + id).status, 204);
  upload.send(file.substr(10));
  EXPECT_EQ(upload.answer().status, 401);
  EXPECT_EQ(as(tokens_["admin"], "GET", "/v1/models").body.find("late"), std::string::npos);
}

TEST_F(Scopes, TokenOfOneStream_OpensItAndTheFaceItShows) {
  const auto edit = tokens_["edit"];
  const auto model = json::parse(request(port(), "POST", "/v1/models?name=Grid&filename=grid.obj", grid_obj(9),
                                         {{"Content-Type", "model/obj"}, bearer(edit).front()})
                                     .body)["model"]["id"];
  const auto other = json::parse(request(port(), "POST", "/v1/models?name=Other&filename=other.obj", grid_obj(8),
                                         {{"Content-Type", "model/obj"}, bearer(edit).front()})
                                     .body)["model"]["id"];
  ASSERT_EQ(as(edit, "POST", "/v1/streams", json{{"name", "mine"}, {"model", model}}.dump()).status, 201);
  ASSERT_EQ(as(edit, "POST", "/v1/streams", R"({"name":"theirs"})").status, 201);
  const auto token = make({"--scope", "edit", "--stream", "mine"});
  EXPECT_EQ(as(token, "GET", "/v1/streams/mine").status, 200);
  EXPECT_EQ(as(token, "GET", "/v1/streams/theirs").status, 403);
  EXPECT_EQ(as(token, "POST", "/v1/streams/theirs/frames", "{}").status, 403);
  EXPECT_NE(as(token, "POST", "/v1/streams/mine/frames", "{}").status, 403);
  EXPECT_EQ(as(token, "GET", "/v1/models/" + model.get<std::string>()).status, 200);
  EXPECT_EQ(as(token, "DELETE", "/v1/models/" + model.get<std::string>()).status, 403) << "only reading";
  EXPECT_EQ(as(token, "GET", "/v1/models/" + other.get<std::string>()).status, 403);
  for (const auto* list : {"/v1/models", "/v1/streams", "/v1/recordings", "/v1/expressions"})
    EXPECT_EQ(as(token, "GET", list).status, 403) << list;
  EXPECT_EQ(as(token, "POST", "/v1/streams", "{}").status, 403);
}

TEST_F(Scopes, TokenOfOneModel_OpensItAndItsJobs) {
  const auto edit = tokens_["edit"];
  const auto upload = [&](const char* name, int side) {
    return json::parse(request(port(), "POST", "/v1/models?name=A&filename=" + std::string(name) + ".obj",
                               grid_obj(side), {{"Content-Type", "model/obj"}, bearer(edit).front()})
                           .body);
  };
  const auto mine = upload("mine", 9), theirs = upload("theirs", 8);
  const std::string id = mine["model"]["id"], job = mine["job"]["id"], other_job = theirs["job"]["id"];
  const auto token = make({"--scope", "edit", "--model", id});
  EXPECT_EQ(as(token, "GET", "/v1/models/" + id).status, 200);
  EXPECT_EQ(as(token, "PATCH", "/v1/models/" + id, R"({"name":"B"})").status, 200);
  EXPECT_EQ(as(token, "GET", "/v1/jobs/" + job).status, 200);
  EXPECT_EQ(as(token, "GET", "/v1/jobs/" + other_job).status, 403);
  EXPECT_EQ(as(token, "GET", "/v1/models/" + theirs["model"]["id"].get<std::string>()).status, 403);
  EXPECT_EQ(as(token, "GET", "/v1/models").status, 403);
}

TEST_F(Scopes, PublicStream_IsOpenForReading_AndNothingElse) {
  const auto edit = tokens_["edit"];
  const std::string model = json::parse(request(port(), "POST", "/v1/models?name=Grid&filename=grid.obj", grid_obj(9),
                                                {{"Content-Type", "model/obj"}, bearer(edit).front()})
                                            .body)["model"]["id"];
  const auto create = [&](const char* name, bool is_public) {
    return as(edit, "POST", "/v1/streams", json{{"name", name}, {"model", model}, {"is_public", is_public}}.dump());
  };
  ASSERT_EQ(create("closed", false).status, 201);
  EXPECT_EQ(as("", "GET", "/v1/models/" + model).status, 401);
  const auto open = create("open", true);
  ASSERT_EQ(open.status, 201);
  EXPECT_EQ(json::parse(open.body)["is_public"], true);
  EXPECT_EQ(as("", "GET", "/v1/streams/open").status, 200);
  EXPECT_EQ(as("", "GET", "/v1/streams/closed").status, 401);
  EXPECT_EQ(as("", "GET", "/v1/models/" + model).status, 200);
  EXPECT_NE(as("", "GET", "/v1/models/" + model + "/rig.json").status, 401);
  EXPECT_EQ(as("", "GET", "/v1/models/" + model + "/feature-points").status, 401);
  EXPECT_EQ(as("", "GET", "/v1/streams/open/recordings").status, 401);
  EXPECT_EQ(as("", "GET", "/v1/streams").status, 401);
  EXPECT_EQ(as("", "DELETE", "/v1/streams/open").status, 401);
  WebSocket socket(port(), "/v1/streams/open", "semblante.v1.json");
  ASSERT_EQ(socket.handshake().status, 101);
  socket.send_text(R"({"type":"hello","version":1,"role":"publish"})");
  EXPECT_THAT(socket.receive().value_or(""), HasSubstr("\"unauthorized\""));
}

TEST_F(Scopes, Tickets_AreForOneRequestInAnAddress) {
  ASSERT_EQ(as(tokens_["edit"], "POST", "/v1/streams", R"({"name":"stage"})").status, 201);
  const auto ticket = [&](const std::string& path) {
    const auto made = as(tokens_["read"], "POST", "/v1/tickets", json{{"path", path}}.dump());
    EXPECT_EQ(made.status, 201);
    return json::parse(made.body)["ticket"].get<std::string>();
  };
  const auto one = ticket("/v1/models");
  EXPECT_EQ(as("", "GET", "/v1/models?ticket=" + one).status, 200);
  EXPECT_EQ(as("", "GET", "/v1/models?ticket=" + one).status, 401) << "used up";
  EXPECT_EQ(as("", "GET", "/v1/streams?ticket=" + ticket("/v1/models")).status, 401) << "for another address";
  EXPECT_EQ(as("", "POST", "/v1/streams?ticket=" + ticket("/v1/streams"), "{}").status, 401) << "only for reading";
  EXPECT_EQ(WebSocket(port(), "/v1/streams/stage?ticket=" + ticket("/v1/streams/stage"), "semblante.v1.json")
                .handshake()
                .status,
            101);
}

TEST_F(Scopes, Cookie_IsForOwnPagesOnly) {
  ASSERT_EQ(as(tokens_["edit"], "POST", "/v1/streams", R"({"name":"stage"})").status, 201);
  EXPECT_EQ(as("", "POST", "/v1/session", R"({"token":"smb_a_b"})").status, 401);
  const auto session = as("", "POST", "/v1/session", json{{"token", tokens_["edit"]}}.dump());
  ASSERT_EQ(session.status, 200);
  EXPECT_EQ(json::parse(session.body)["scope"], "edit");
  const auto set = session.headers.at("set-cookie");
  EXPECT_THAT(set, HasSubstr("HttpOnly"));
  EXPECT_THAT(set, HasSubstr("SameSite=Strict"));
  const auto cookie = set.substr(0, set.find(';'));
  const auto with = [&](const std::string& method, const std::string& origin) {
    Fields fields = {{"Cookie", "a=b; " + cookie}};
    if (!origin.empty()) fields.emplace_back("Origin", origin);
    return request(port(), method, "/v1/streams", {}, fields).status;
  };
  const std::string own = "http://127.0.0.1";
  EXPECT_EQ(with("GET", ""), 200);
  EXPECT_EQ(with("POST", own), 201);
  EXPECT_EQ(with("POST", ""), 401) << "every browser sends the Origin of a POST";
  EXPECT_EQ(with("GET", "https://evil.example"), 401);
  EXPECT_EQ(with("POST", "https://evil.example"), 403);
  const auto opens = [&](const Fields& more) {
    Fields fields = {{"Cookie", cookie}};
    fields.insert(fields.end(), more.begin(), more.end());
    return WebSocket(port(), "/v1/streams/stage", "semblante.v1.json", fields).handshake().status;
  };
  EXPECT_EQ(opens({{"Origin", own}}), 101);
  EXPECT_EQ(opens({}), 401);
  EXPECT_EQ(opens({{"Origin", "https://evil.example"}}), 403);
  EXPECT_THAT(request(port(), "DELETE", "/v1/session").headers.at("set-cookie"), HasSubstr("Max-Age=0"));
}

TEST_F(Scopes, Tokens_AreListedWithoutTheirSecrets) {
  const auto listed = as(tokens_["admin"], "GET", "/v1/tokens");
  ASSERT_EQ(listed.status, 200);
  EXPECT_EQ(json::parse(listed.body)["tokens"].size(), 4U);
  for (const auto& [scope, token] : tokens_) EXPECT_EQ(listed.body.find(token.substr(20)), std::string::npos);
  const auto wrong = [&](const json& body) { return as(tokens_["admin"], "POST", "/v1/tokens", body.dump()).status; };
  EXPECT_EQ(wrong({{"scope", "none"}}), 422);
  EXPECT_EQ(wrong({{"scope", "read"}, {"stream", "nothing"}}), 422);
  EXPECT_EQ(wrong({{"scope", "read"}, {"expires_in", 0}}), 422);
  EXPECT_EQ(wrong({{"scope", "read"}, {"colour", "red"}}), 422);
  EXPECT_EQ(as(tokens_["admin"], "DELETE", "/v1/tokens/nothing").status, 404);
}

TEST(TokenCommand, OfAFolderThatIsNoDataFolder_MakesNothing) {
  const TemporaryFolder folder;
  const auto run = [](std::vector<std::string> arguments, const std::filesystem::path& data) {
    arguments.insert(arguments.begin(), "token");
    arguments.insert(arguments.end(), {"--data", data.string()});
    return run_semblante(arguments);
  };
  const std::vector<std::vector<std::string>> commands = {
      {"create", "--scope", "admin"}, {"list"}, {"revoke", "nothing"}};
  const auto missing = folder.path() / "misspelt", foreign = folder.path() / "letters", empty = folder.path() / "new";
  std::filesystem::create_directory(foreign);
  std::ofstream(foreign / "to-ana.txt") << "Dear Ana";
  std::filesystem::create_directory(empty);
  for (const auto& command : commands) {
    const auto of_missing = run(command, missing), of_foreign = run(command, foreign);
    EXPECT_EQ(of_missing.exit_code, 2) << command.front();
    EXPECT_THAT(of_missing.err, HasSubstr("there is no folder " + missing.string())) << command.front();
    EXPECT_FALSE(std::filesystem::exists(missing)) << command.front();
    EXPECT_EQ(of_foreign.exit_code, 2) << command.front();
    EXPECT_THAT(of_foreign.err, HasSubstr("there is no semblante.sqlite in " + foreign.string())) << command.front();
    EXPECT_FALSE(std::filesystem::exists(foreign / "semblante.sqlite")) << command.front();
  }
  EXPECT_EQ(run({"list"}, empty).exit_code, 2);
  EXPECT_TRUE(std::filesystem::is_empty(empty));
  EXPECT_EQ(run({"create", "--scope", "admin"}, folder.path() / "letters/to-ana.txt").exit_code, 2);
  EXPECT_EQ(run({"create", "--scope", "admin"}, empty).exit_code, 0) << "the first token, before the first start";
  EXPECT_THAT(run({"list"}, empty).out, HasSubstr("admin"));
}

TEST(ScopesDocument, IsWhatTheRoutesSay) {
  EXPECT_EQ(read_text(SEMBLANTE_SOURCE_DIR "/server/access/SCOPES.md"),
            read_text(SEMBLANTE_BINARY_DIR "/generated/server/api/generated/SCOPES.md"))
      << "copy the generated file";
}

}  // namespace
}  // namespace semblante::test
