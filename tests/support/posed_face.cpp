#include "tests/support/posed_face.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "core/pipeline/points_file.h"
#include "tests/oracle/real_heads.h"
#include "tests/support/sample_head_model.h"

namespace semblante::bench {
namespace {

std::string read_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  return {std::istreambuf_iterator<char>(in), {}};
}

template <typename T>
T value_or_throw(const std::string& of, Result<T> result) {
  if (!result) throw std::runtime_error(of + ": " + result.error().message);
  return *std::move(result);
}

Rig parametrize_or_throw(const Head& head, WeightMethod method) {
  ParametrizeOptions options;
  options.weights = method;
  return value_or_throw(head.name, parametrize(head.model, head.surface, head.points, options));
}

}  // namespace

Head sample_head() {
  Head head{"sample head", testing::sample_head_model(), {}, testing::sample_head_points()};
  head.surface = build_surface(head.model);
  return head;
}

Head read_head(const std::filesystem::path& model, const std::filesystem::path& points) {
  const std::string bytes = read_text(model);
  auto imported =
      value_or_throw(model.string(), import_head({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()},
                                                 {model.filename().string(), std::nullopt, {}}));
  auto file = value_or_throw(points.string(), parse_feature_points(read_text(points)));
  auto marked = value_or_throw(points.string(), mark_by_file(std::move(imported), std::move(file)));
  return {model.stem().string(), std::move(marked.model), std::move(marked.surface), std::move(marked.points)};
}

std::vector<Head> known_heads() {
  std::vector<Head> heads;
  heads.push_back(sample_head());
  const auto faces = oracle::faces_folder();
  if (!faces) return heads;
  const auto add = [&](const char* name, const char* model, const char* points) {
    heads.push_back(read_head(*faces / name / model, *faces / name / points));
    heads.back().name = name;
  };
  add("ict-facekit", "neutral.obj", "ict-facekit.fps.json");
  add("makehuman", "head.glb", "makehuman.fps.json");
  add("mediapipe-canonical", "face_model_with_iris.obj", "mediapipe-canonical.fps.json");
  return heads;
}

std::vector<Head> heads_with_lids() {
  std::vector<Head> heads = known_heads();
  std::erase_if(heads, [](const Head& head) { return head.name == "mediapipe-canonical"; });
  for (const testing::FamilyMember& member : testing::sample_family()) {
    if (member.traits == SampleHeadTraits{} || member.traits.form == SampleHeadForm::scan) continue;
    if (member.traits.closed_eyes) continue;  // they only open
    Head head{member.name, testing::sample_head_model(member.traits), {}, testing::sample_head_points(member.traits)};
    head.surface = build_surface(head.model);
    heads.push_back(std::move(head));
  }
  return heads;
}

PosedFace::PosedFace(const Head& head, WeightMethod method)
    : head_(head), rig_(parametrize_or_throw(head, method)), kernel_rig_(make_kernel_rig(rig_)) {}

PartRole PosedFace::role_of(std::uint32_t file_vertex) const {
  return rig_.parts[rig_.part_of_vertex[file_vertex].value()].role;
}

std::vector<glm::vec3> PosedFace::pose(const semblante_frame& frame) const {
  const semblante_rig view = kernel_rig_.view();
  semblante_pose pose;
  semblante_evaluate(&view, &frame, &pose);
  const semblante_face face = make_kernel_face(rig_, &head_.model.positions[0].x);
  std::vector<glm::vec3> positions(head_.model.positions.size());
  semblante_deform(&face, &pose, &positions[0].x);
  return positions;
}

semblante_frame frame_of(std::uint8_t viseme, std::uint8_t expression) {
  semblante_frame frame{};
  frame.viseme1 = viseme;
  frame.viseme_blend = SEMBLANTE_BLEND_MAX;
  frame.expression1 = expression;
  frame.intensity1 = SEMBLANTE_BLEND_MAX;
  return frame;
}

semblante_frame frame_of(std::initializer_list<std::pair<int, float>> faps) {
  semblante_frame frame{};
  for (const auto& [number, value] : faps) frame.fap[number] = value;
  return frame;
}

std::vector<semblante_frame> head_turns() {
  std::vector<semblante_frame> frames;
  for (const int fap : {48, 49, 50}) {
    for (const float angle : {-60000.0F, 60000.0F}) frames.push_back(frame_of({{fap, angle}}));
  }
  frames.push_back(frame_of({{48, 30000.0F}, {49, 30000.0F}}));
  return frames;
}

std::vector<Triangle> neck_triangles(const PosedFace& face) {
  const std::vector<std::uint8_t>& turn = face.rig().turn_of_vertex;
  std::vector<Triangle> neck;
  for (const Triangle& t : face.head().model.triangles) {
    if (std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return turn[v] > 0 && turn[v] < 255; }))
      neck.push_back(t);
  }
  return neck;
}

}  // namespace semblante::bench
