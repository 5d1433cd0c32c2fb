// `semblante convert`: faces in time from one format to another.
#include <algorithm>

#include <gtest/gtest.h>

#include "server/recordings/recording_writer.h"
#include "tests/integration/cli/program.h"

namespace semblante::test {
namespace {

std::string mask(const std::vector<int>& faps) {
  std::string text;
  for (int fap = 1; fap <= 68; ++fap) {
    const bool present = std::find(faps.begin(), faps.end(), fap) != faps.end();
    text.append(fap > 1 ? " " : "").append(present ? "1" : "0");
  }
  return text + "\n";
}

TEST(Convert, FapFile_ToFramesAndBack_IsTheSame) {
  const Workspace work;
  const std::string fap =
      work.write("in.fap", "2.1 semblante 25 2\n" + mask({3, 19}) + "0 10 -20\n" + mask({3, 19}) + "1 30 0\n");
  ASSERT_EQ(run_semblante({"convert", fap, "--out", work.path("out.json")}).exit_code, 0);
  EXPECT_EQ(read_text(work.path("out.json")),
            "{\"frames\": [\n{\"time\":0,\"faps\":{\"3\":10,\"19\":-20}},\n{\"time\":40,\"faps\":{\"3\":30}}\n]}\n");
  ASSERT_EQ(run_semblante({"convert", work.path("out.json"), "--out", work.path("back.fap")}).exit_code, 0);
  EXPECT_EQ(read_text(work.path("back.fap")), read_text(fap));
}

TEST(Convert, AbsentFaps_AreZeroOrKept) {
  const Workspace work;
  const std::string fap = work.write("in.fap", "2.1 x 25 2\n" + mask({3}) + "0 10\n" + mask({}) + "1\n");
  EXPECT_EQ(run_semblante({"convert", fap, "--out", "-", "--out-format", "frames"}).out,
            "{\"frames\": [\n{\"time\":0,\"faps\":{\"3\":10}},\n{\"time\":40}\n]}\n");
  EXPECT_EQ(run_semblante({"convert", fap, "--out", "-", "--out-format", "frames", "--absent", "keep"}).out,
            "{\"frames\": [\n{\"time\":0,\"faps\":{\"3\":10}},\n{\"time\":40,\"faps\":{\"3\":10}}\n]}\n");
}

TEST(Convert, Performance_ToFramesAndBack_SaysTheSame) {
  const Workspace work;
  const std::string performance = work.write("in.json", R"({"format":"semblante.performance","version":1,"duration":200,
    "cues":[{"time":0,"fap":"open_jaw","keys":[[0,0],[100,400],[200,0]],"easing":"linear"},
            {"time":50,"duration":100,"expression":"joy","value":1,"attack":0,"release":0}]})");
  ASSERT_EQ(run_semblante({"convert", performance, "--out", work.path("frames.json"), "--rate", "20"}).exit_code, 0);
  const std::string frames =
      "{\"frames\": [\n{\"time\":0},\n"
      "{\"time\":50,\"expression\":{\"select1\":1,\"intensity1\":63,\"select2\":0,\"intensity2\":0},\"faps\":{\"3\":"
      "200}},\n"
      "{\"time\":100,\"expression\":{\"select1\":1,\"intensity1\":63,\"select2\":0,\"intensity2\":0},\"faps\":{\"3\":"
      "400}},\n"
      "{\"time\":150,\"faps\":{\"3\":200}},\n{\"time\":200}\n]}\n";
  EXPECT_EQ(read_text(work.path("frames.json")), frames);
  ASSERT_EQ(run_semblante({"convert", work.path("frames.json"), "--out", work.path("back.json"), "--out-format",
                           "performance", "--tolerance", "0"})
                .exit_code,
            0);
  ASSERT_EQ(run_semblante({"convert", work.path("back.json"), "--out", work.path("again.json"), "--rate", "20",
                           "--out-format", "frames"})
                .exit_code,
            0);
  EXPECT_EQ(read_text(work.path("again.json")).substr(0, frames.size() - 4), frames.substr(0, frames.size() - 4))
      << "and a frame more: the recording's last one lasts as long as the others";
  const Outcome outcome = run_semblante(
      {"convert", work.write("bad.json", R"({"format":"semblante.performance","version":1,"cues":[{"time":0}]})"),
       "--out", work.path("out.fap")});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("/cues/0"), std::string::npos) << outcome.err;
}

TEST(Convert, Faults_NameFileAndPlace) {
  const Workspace work;
  const std::string fap = work.write("in.fap", "2.1 x 25 1\n" + mask({3}) + "0 zehn\n");
  Outcome outcome = run_semblante({"convert", fap, "--out", work.path("out.json")});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("in.fap: line 3, word 2"), std::string::npos) << outcome.err;
  const std::string frames = work.write("in.json", R"({"frames":[{"faps":{"99":1}}]})");
  outcome = run_semblante({"convert", frames, "--out", work.path("out.fap")});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("/frames/0/faps/99"), std::string::npos) << outcome.err;
  outcome = run_semblante({"convert", frames, "--out", work.path("out.xyz")});
  EXPECT_EQ(outcome.exit_code, 2);
}

TEST(Convert, TakeOfLiveLink_ToFramesAndBack) {
  const Workspace work;
  const std::string take = work.write("take.csv",
                                      "Timecode,BlendShapeCount,EyeBlinkLeft,JawOpen,HeadYaw\r\n"
                                      "00:32:09:58.000,61,1.0,0.5,0.25\r\n00:32:10:00.000,61,2.0,0,0\r\n");
  const Outcome there = run_semblante({"convert", take, "--out", work.path("take.json")});
  EXPECT_EQ(there.exit_code, 0) << there.err;
  EXPECT_NE(there.err.find("1 coefficients outside 0 to 1"), std::string::npos) << there.err;
  const std::string frames = read_text(work.path("take.json"));
  EXPECT_NE(frames.find("\"3\":340"), std::string::npos) << frames;
  EXPECT_NE(frames.find("\"49\":-25000"), std::string::npos) << frames;
  EXPECT_NE(frames.find("\"time\":33"), std::string::npos) << frames;
  ASSERT_EQ(run_semblante({"convert", work.path("take.json"), "--out", work.path("back.csv")}).exit_code, 0);
  const std::string back = read_text(work.path("back.csv"));
  EXPECT_TRUE(back.starts_with("Timecode,BlendShapeCount,EyeBlinkLeft,")) << back;
  EXPECT_NE(back.find("\n00:00:00:00.000,61,1.0000000000,"), std::string::npos) << back;
  const std::string broken = work.write("broken.csv", "Timecode,JawOpen\n00:00:00:00,open\n");
  const Outcome refused = run_semblante({"convert", broken, "--out", work.path("x.json")});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("broken.csv: line 2: column 2: 'open'"), std::string::npos) << refused.err;
}

TEST(Convert, Recording_IsReadAsFrames_WithoutItsTornEnd) {
  using namespace semblante::recordings;
  const Workspace work;
  auto writer = RecordingWriter::create(work.path("talk.srec"), Header{});
  ASSERT_TRUE(writer);
  FaceFrame jaw;
  jaw.level[3] = 2;
  ASSERT_TRUE((*writer)->add({5, 1000, {{0, {}}, {70, jaw}}}));
  ASSERT_TRUE((*writer)->flush());
  const std::string whole = read_text(work.path("talk.srec"));
  const std::string cut = work.write("torn.srec", whole + "CHNK and no more");
  const Outcome clean = run_semblante({"convert", work.path("talk.srec"), "--out", work.path("talk.json")});
  EXPECT_EQ(clean.exit_code, 0) << clean.err;
  EXPECT_EQ(clean.err, "");
  EXPECT_EQ(read_text(work.path("talk.json")), "{\"frames\": [\n{\"time\":0},\n{\"time\":70,\"faps\":{\"3\":8}}\n]}\n");
  const Outcome torn = run_semblante({"convert", cut, "--out", work.path("torn.json")});
  EXPECT_EQ(torn.exit_code, 0);
  EXPECT_NE(torn.err.find("byte " + std::to_string(whole.size())), std::string::npos) << torn.err;
  EXPECT_EQ(read_text(work.path("torn.json")), read_text(work.path("talk.json")));
  EXPECT_EQ(run_semblante({"convert", work.path("talk.srec"), "--out", work.path("talk.fap")}).exit_code, 0);
  EXPECT_EQ(run_semblante({"convert", work.path("talk.json"), "--out", work.path("other.srec")}).exit_code, 2);
}

TEST(Convert, Oddities_AreWarningsUnlessQuiet) {
  const Workspace work;
  const std::string fap = work.write("in.fap", "2.1 x 25 7\n" + mask({3}) + "0 inf\n");
  const Outcome outcome = run_semblante({"convert", fap, "--out", work.path("out.json")});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("line 1: the number of frames in the header"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("line 3: a value is infinite"), std::string::npos) << outcome.err;
  EXPECT_EQ(run_semblante({"convert", fap, "--out", work.path("out.json"), "--quiet"}).err, "");
}

}  // namespace
}  // namespace semblante::test
