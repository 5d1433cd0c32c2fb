#include "tests/integration/client/sample_server.h"

#include <cstdlib>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/wait.h"

namespace semblante::testing {

SampleServer::SampleServer() {
  std::string pattern = (std::filesystem::temp_directory_path() / "semblante-client-XXXXXX").string();
  folder_ = mkdtemp(pattern.data());
  ChildProcess generator({SEMBLANTE_SAMPLE_HEAD, folder_.string()});
  EXPECT_EQ(generator.wait(patience), 0);
  process_ = std::make_unique<ChildProcess>(
      std::vector<std::string>{SEMBLANTE_SERVER, "serve", "--port", "0", "--data", (folder_ / "data").string(),
                               "--sample", model_file().string(), "--demo", "--log-level", "warning"});
  const std::string line = process_->read_line(patience);
  const std::size_t at = line.find("http://");
  auto url = client::parse_url(at == std::string::npos ? std::string_view() : std::string_view(line).substr(at));
  EXPECT_TRUE(url) << "the server said: " << line;
  http_ = std::make_unique<client::HttpClient>(url ? *url : client::Url{"127.0.0.1", "1", ""});
  EXPECT_TRUE(eventually([&] {
    const auto model = http_->get("/v1/models/sample");
    return model && nlohmann::json::parse(model->body, nullptr, false).value("state", "") == "parametrized";
  })) << "the sample head is not parametrized";
}

SampleServer::~SampleServer() {
  process_->interrupt();
  EXPECT_EQ(process_->wait(patience), 0) << "the server stops cleanly";
  std::filesystem::remove_all(folder_);
}

std::string SampleServer::url() const {
  const auto& address = http_->server().url;
  return "http://" + address.host + ":" + address.port;
}

void SampleServer::create_stream(const std::string& name, std::optional<double> viseme_share) const {
  nlohmann::json body = {{"name", name}, {"model", "sample"}, {"batch_interval", 0}};
  if (viseme_share) {
    body["viseme_share"] = *viseme_share;
  }
  const auto made = http_->post("/v1/streams", body.dump(), "application/json");
  ASSERT_TRUE(made) << made.error().message;
  ASSERT_EQ(made->status, 201) << made->body;
}

void SampleServer::post_frames(const std::string& stream, const std::string& frames) const {
  const auto posted =
      http_->post("/v1/streams/" + stream + "/frames", R"({"frames":)" + frames + "}", "application/json");
  ASSERT_TRUE(posted) << posted.error().message;
  ASSERT_EQ(posted->status, 202) << posted->body;
}

nlohmann::json SampleServer::stream(const std::string& name) const {
  const auto answer = http_->get("/v1/streams/" + name);
  return answer ? nlohmann::json::parse(answer->body, nullptr, false) : nlohmann::json();
}

void SampleServer::wait_for_subscribers(const std::string& stream, int count) const {
  ASSERT_TRUE(eventually([&] {
    const auto said = this->stream(stream);
    return said.is_object() && said.value("subscribers", -1) == count;
  }));
}

}  // namespace semblante::testing
