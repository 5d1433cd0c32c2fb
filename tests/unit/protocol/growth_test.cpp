// Every reader of the protocol's texts and bytes takes time in proportion to their number, whatever stands in them.

#include "tests/support/growth.h"

#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "core/performance/performance.h"
#include "protocol/cpp/fap_file.h"
#include "protocol/cpp/fap_file_frames.h"
#include "protocol/cpp/frame_codec.h"
#include "protocol/cpp/json_codec.h"
#include "protocol/cpp/packed_codec.h"
#include "protocol/cpp/performance_document.h"
#include "protocol/cpp/rig_document.h"
#include "protocol/cpp/weights_format.h"

namespace semblante {
namespace {

using test::expect_linear;
using Make = std::function<std::string(std::size_t)>;

/// `one` n times, between commas.
std::string list(std::size_t n, const std::function<std::string(std::size_t)>& one) {
  std::string text;
  for (std::size_t i = 0; i < n; ++i) text.append(i == 0 ? "" : ",").append(one(i));
  return text;
}
std::string list(std::size_t n, const std::string& one) {
  return list(n, [&](std::size_t) { return one; });
}

// ---- performance documents

std::string document(const std::string& cues, const std::string& more = "") {
  return R"({"format":"semblante.performance","version":1,)" + more + R"("cues":[)" + cues + "]}";
}

void expect_linear_performance(const std::string& what, std::size_t most, const Make& make) {
  expect_linear("performance: " + what, {.from = most / 256 + 1, .most = most}, make, [](const std::string& text) {
    const auto script = read_performance(text);
    if (script) (void)Performance::compile(*script);
  });
}

TEST(ProtocolGrowth, Performance) {
  expect_linear_performance("cues one after another", 100'000, [](std::size_t n) {
    return document(list(
        n, [](std::size_t i) { return R"({"time":)" + std::to_string(i) + R"(,"duration":1,"fap":3,"value":1})"; }));
  });
  for (const std::size_t at_once : {60, 64, 70}) {
    expect_linear_performance("cues that overlap, " + std::to_string(at_once) + " at once", 100'000,
                              [at_once](std::size_t n) {
                                return document(list(n, [at_once](std::size_t i) {
                                  return R"({"time":)" + std::to_string(i * 10) + R"(,"duration":)" +
                                         std::to_string(at_once * 10 - 5) + R"(,"fap":3,"value":1})";
                                }));
                              });
  }
  expect_linear_performance("cues at one moment on many targets", 4000, [](std::size_t n) {
    return document(list(n, [](std::size_t i) {
      return R"({"time":0,"duration":10000,"fap":)" + std::to_string(3 + i % 66) + R"(,"value":1})";
    }));
  });
  expect_linear_performance("short cues under long ones", 100'000, [](std::size_t n) {
    return document(list(n, [](std::size_t i) {
      return R"({"time":)" + std::to_string(i) + R"(,"duration":)" + (i % 40 == 0 ? "1000" : "1") +
             R"(,"head":{"yaw":1}})";
    }));
  });
  expect_linear_performance("keys of one cue", 900'000, [](std::size_t n) {
    return document(R"({"time":0,"fap":3,"keys":[)" +
                    list(n, [](std::size_t i) { return "[" + std::to_string(i) + ",1]"; }) + "]}");
  });
  expect_linear_performance("keys of many cues", 100'000, [](std::size_t n) {
    return document(list(n, [](std::size_t i) {
      return R"({"time":)" + std::to_string(i * 10) + R"(,"fap":3,"keys":[[0,1],[2,3]],"easing":[0,0,1,1]})";
    }));
  });
  expect_linear_performance("members that are none", 400'000, [](std::size_t n) {
    return document("", list(n, [](std::size_t i) { return "\"m" + std::to_string(i) + "\":{}"; }) + ",");
  });
  expect_linear_performance("members of a cue", 400'000, [](std::size_t n) {
    return document("{" + list(n, [](std::size_t i) { return "\"m" + std::to_string(i) + "\":0"; }) + "}");
  });
  expect_linear_performance("empty lists in place of keys", 900'000, [](std::size_t n) {
    return document(R"({"time":0,"fap":3,"keys":[)" + list(n, "[]") + "]}");
  });
  expect_linear_performance("empty cues", 900'000, [](std::size_t n) { return document(list(n, "{}")); });
  expect_linear_performance("a note", 8'000'000,
                            [](std::size_t n) { return document("", "\"note\":\"" + std::string(n, 'x') + "\","); });
}

// ---- stream messages and files of frames

TEST(ProtocolGrowth, JsonFrames) {
  const auto message = [](const std::string& what, std::size_t most, const Make& make) {
    expect_linear("message: " + what, {.from = most / 64 + 1, .most = most}, make, [](const std::string& text) {
      (void)decode_json(R"({"type":"frames",)" + text.substr(1));
      (void)decode_json_frames(text);
    });
  };
  const auto values = [](const std::string& what, std::size_t most, const Make& make) {
    expect_linear("file of frames: " + what, {.from = most / 64 + 1, .most = most}, make,
                  [](const std::string& text) { (void)decode_json_values(text); });
  };
  const auto frames = [](const std::string& one) -> Make {
    return [one](std::size_t n) { return R"({"frames":[)" + list(n, one) + "]}"; };
  };
  std::string all_faps;
  for (int fap = 3; fap <= 68; ++fap) all_faps += (fap == 3 ? "\"" : ",\"") + std::to_string(fap) + "\":1";
  const std::string full = R"({"faps":{)" + all_faps + "}}";
  const std::string arkit = R"({"arkit":[)" + list(61, "0.5") + R"(],"oculus":[)" + list(15, "0.5") + "]}";
  message("frames of all FAPs", 1024, frames(full));
  message("frames of coefficients", 1024, frames(arkit));
  message("empty frames", 180'000, frames("{}"));
  message("members that are none", 60'000, [](std::size_t n) {
    return R"({"frames":[{"faps":{)" + list(n, [](std::size_t i) { return "\"" + std::to_string(i) + "\":{}"; }) +
           "}}]}";
  });
  message("members beside the frames", 60'000, [](std::size_t n) {
    return R"({"frames":[{}],)" + list(n, [](std::size_t i) { return "\"" + std::to_string(i) + "\":[]"; }) + "}";
  });
  values("frames of all FAPs", 20'000, frames(full));
  values("frames of coefficients", 20'000, frames(arkit));
  values("empty frames", 100'000, frames("{}"));
  values("more frames than are read", 1'000'000, frames("{}"));
  values("one frame of many members", 180'000, [](std::size_t n) {
    return R"({"frames":[{"faps":{)" + list(n, [](std::size_t i) { return "\"" + std::to_string(i) + "\":1"; }) +
           "}}]}";
  });
}

TEST(ProtocolGrowth, Rig) {
  const auto rig = [](const std::string& what, const Make& make) {
    expect_linear("rig: " + what, {.from = 500, .most = 90'000}, make,
                  [](const std::string& text) { (void)read_rig(text); });
  };
  const std::string start = R"({"format":"semblante.rig","version":1,"name":"x",)";
  rig("parts",
      [&](std::size_t n) { return start + R"("parts":[)" + list(n, R"({"name":"p","role":"other"})") + "]}"; });
  rig("levels", [&](std::size_t n) {
    return start + R"("lod":0,"levels":[)" + list(n, R"({"vertices":3,"triangles":1,"bytes":9})") + "]}";
  });
  rig("members", [&](std::size_t n) {
    return start + list(n, [](std::size_t i) { return "\"" + std::to_string(i) + "\":{}"; }) + "}";
  });
  rig("warnings", [&](std::size_t n) { return start + R"("warnings":[)" + list(n, "\"careful\"") + "]}"; });
}

TEST(ProtocolGrowth, Weights) {
  expect_linear(
      "weights", {.from = 2000, .most = 400'000},
      [](std::size_t n) {
        InfluenceTable table;
        table.vertex_count = static_cast<std::uint32_t>(n);
        for (std::size_t v = 0; v < n; ++v) {
          for (const std::uint8_t point : {1, 5, 30})
            table.rows.push(FeaturePointId(point), static_cast<float>(v % 100 + point) / 200.0F);
          table.rows.end_row();
        }
        table.rigid.assign(n, 0);
        return encode_weights(table);
      },
      [](const std::vector<std::uint8_t>& bytes) { EXPECT_TRUE(decode_weights(bytes)); });
}

/// Bytes of messages; each is bounded, a connection is not.
TEST(ProtocolGrowth, BinaryMessages) {
  const auto some_frames = [](std::size_t n) {
    Frames frames;
    frames.sequence = 1;
    for (std::size_t i = 0; i < n; ++i) {
      TimedFrame frame;
      frame.time = static_cast<std::uint32_t>(i);
      for (std::size_t fap = first_low_level_fap; fap <= last_low_level_fap; ++fap)
        frame.state.level[fap] = static_cast<std::int16_t>((i * 7 + fap) % 50);
      frames.frames.push_back(frame);
    }
    return frames;
  };
  const test::Growth one_message = {.from = 16, .most = max_frames_per_message};
  expect_linear(
      "frames", one_message,
      [&](std::size_t n) {
        PackedEncoder encoder((Keyframe()));
        std::vector<std::vector<std::uint8_t>> messages;
        messages.push_back(encoder.keyframe());
        messages.push_back(encoder.encode(some_frames(n)));
        return messages;
      },
      [](const std::vector<std::vector<std::uint8_t>>& messages) {
        FrameDecoder decoder;
        for (const auto& message : messages) EXPECT_TRUE(decoder.decode(message));
      });
  expect_linear(
      "bytes that are no message", {.from = 1000, .most = 8'000'000},
      [](std::size_t n) { return std::vector<std::uint8_t>(n, 0x80); },
      [](const std::vector<std::uint8_t>& bytes) {
        FrameDecoder decoder;
        for (std::uint8_t type = 0; type < 32; ++type) {
          std::vector<std::uint8_t> message = bytes;
          message[0] = type;
          (void)decoder.decode(message);
        }
      });
}

// ---- .fap files

TEST(ProtocolGrowth, FapFile) {
  const auto fap = [](const std::string& what, std::size_t most, const Make& make) {
    expect_linear(".fap: " + what, {.from = most / 1024 + 1, .most = most}, make, [](const std::string& text) {
      const auto reading = read_fap_file(text);
      if (reading) (void)frames_of(reading->file);
    });
  };
  std::string mask;
  std::string values;
  for (int i = 1; i <= 68; ++i) {
    mask += i > 2 ? "1 " : "0 ";
    values += i > 2 ? " 7" : "";
  }
  const std::string header = "2.1 x 25 1\n";
  fap("frames", 99'000, [&](std::size_t n) {
    std::string text = header;
    for (std::size_t i = 0; i < n; ++i)
      text.append(mask).append("\n").append(std::to_string(i)).append(values).append("\n");
    return text;
  });
  fap("frames in falling order", 99'000, [&](std::size_t n) {
    std::string text = header;
    for (std::size_t i = n; i-- > 0;)
      text.append(mask).append("\n").append(std::to_string(i)).append(values).append("\n");
    return text;
  });
  fap("frames of one number", 99'000, [&](std::size_t n) {
    std::string text = header;
    for (std::size_t i = 0; i < n; ++i) text.append(mask).append("\n1").append(values).append("\n");
    return text;
  });
  const auto repeated = [&](const std::string& what, std::size_t most, const std::string& begin, const std::string& one,
                            const std::string& end) {
    fap(what, most, [=](std::size_t n) {
      std::string text = begin;
      for (std::size_t i = 0; i < n; ++i) text += one;
      return text + end;
    });
  };
  const std::string frame = mask + "\n0" + values + "\n";
  repeated("comments", 1'000'000, header, "# nothing\n", frame);
  repeated("empty lines", 8'000'000, header, "\n", frame);
  repeated("comments of one byte", 8'000'000, header, "#\r", frame);
  repeated("a name of many words", 8'000'000, "2.1", " a", " 25 1\n" + frame);
  repeated("a mask without an end", 8'000'000, header, "1 ", "\n");
  repeated("values without an end", 8'000'000, header + mask + "\n0", " 1", "\n");
  repeated("blanks", 8'000'000, header, " ", "\n" + frame);
}

}  // namespace
}  // namespace semblante
