// Prints protocol/vectors/kernel/golden-frames.json: numbers of the literal oracle in double, none of the kernel's.
#include <cmath>
#include <cstdio>
#include <map>
#include <string>

#include "tests/golden/kernel/golden_face.h"
#include "tests/oracle/normals_oracle.h"

namespace semblante {
namespace {

using oracle::operator*;
using oracle::Vec3;
using testing::GoldenFace;
using testing::GoldenFrame;

/// Shortest decimals that name the float.
std::string exact(float value) {
  for (int digits = 1;; ++digits) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*g", digits, static_cast<double>(value));
    if (std::strtof(text, nullptr) == value) return text;
  }
}

std::string list(const float* values, std::size_t count) {
  std::string text = "[";
  for (std::size_t i = 0; i < count; ++i) text += (i == 0 ? "" : ",") + exact(values[i]);
  return text + "]";
}

/// To 7 digits behind the point: a hundredth of the tolerance.
std::string rounded(const std::vector<Vec3>& vectors) {
  std::string text = "[";
  for (const Vec3& v : vectors) {
    for (const double x : v) {
      char number[32];
      std::snprintf(number, sizeof number, "%.7f", x + 0.0);
      std::string digits = number;
      digits.erase(digits.find_last_not_of('0') + 1);
      if (digits.back() == '.') digits.pop_back();
      text += (text.size() == 1 ? "" : ",") + (digits == "-0" ? "0" : digits);
    }
  }
  return text + "]";
}

template <class Items, class Text>
std::string each(const Items& items, const char* between, Text&& text_of) {
  std::string text;
  for (const auto& item : items) text += (text.empty() ? "" : between) + text_of(item);
  return text;
}

std::string sets(const std::vector<float>& table) {
  std::string text;
  for (std::size_t s = 0; s < table.size() / 252; ++s) {
    std::string set;
    for (std::size_t fp = 0; fp < 84; ++fp) {
      const float* d = &table[(s * 84 + fp) * 3];
      if (d[0] == 0.0F && d[1] == 0.0F && d[2] == 0.0F) continue;
      set += (set.empty() ? "" : ",") + ("\"" + std::to_string(fp) + "\":") + list(d, 3);
    }
    text += (s == 0 ? "" : ",\n      ") + ("{" + set + "}");
  }
  return text;
}

std::string triples(const std::vector<float>& values) {
  std::string text;
  for (std::size_t i = 0; i < values.size(); i += 3) text += (i == 0 ? "" : ",") + list(&values[i], 3);
  return text;
}

void print_rig(const GoldenFace& face) {
  const semblante_rig& rig = face.rig;
  std::printf("  \"rig\": {\n    \"fapu\": %s, \"eye_pivot\": [%s,%s], \"head_pivot\": %s, \"viseme_share\": %s,\n",
              list(rig.fapu, 5).c_str(), list(rig.eye_pivot[0], 3).c_str(), list(rig.eye_pivot[1], 3).c_str(),
              list(rig.head_pivot, 3).c_str(), exact(rig.viseme_share).c_str());
  std::printf("    \"irises\": [%s],\n",
              each(rig.iris, ", ", [](const semblante_iris& iris) {
                return "{\"axis\":" + list(iris.axis, 3) + ",\"pupil_radius\":" + exact(iris.pupil_radius) +
                       ",\"iris_radius\":" + exact(iris.iris_radius) + ",\"bend\":" + exact(iris.bend) + "}";
              }).c_str());
  std::printf("    \"tongue\": {\"origin\":%s,\"left\":%s,\"up\":%s,\"half_width\":%s,\"roll_limit\":%s},\n",
              list(rig.tongue.origin, 3).c_str(), list(rig.tongue.left, 3).c_str(), list(rig.tongue.up, 3).c_str(),
              exact(rig.tongue.half_width).c_str(), exact(rig.tongue.roll_limit).c_str());
  std::printf("    \"lids\": [%s],\n", each(rig.lids, ",\n      ", [](const semblante_lids& lids) {
                                         return "{\"gaze\":" + list(lids.gaze, 3) + ",\"slit\":" + exact(lids.slit) +
                                                ",\"opening\":" + exact(lids.opening) +
                                                ",\"gaze_share\":" + list(lids.gaze_share, 2) +
                                                ",\"ball\":" + list(lids.ball, SEMBLANTE_BALL_PLACES) + "}";
                                       }).c_str());
  for (const int is_choice : {0, 1}) {
    std::string entries;
    for (const semblante_companion& c : face.companions) {
      if (c.is_choice != is_choice) continue;
      entries += (entries.empty() ? "[" : ",[") + std::to_string(c.point) + "," + std::to_string(c.leader) + "," +
                 exact(c.share) + "]";
    }
    std::printf("    \"%s\": [%s],\n", is_choice != 0 ? "lower_lip" : "companions", entries.c_str());
  }
  std::printf("    \"visemes\": [\n      %s],\n    \"expressions\": [\n      %s]\n  },\n", sets(face.visemes).c_str(),
              sets(face.expressions).c_str());
}

void print_face(const GoldenFace& face) {
  std::printf("  \"face\": {\n    \"rest\": [%s],\n    \"normals\": [%s],\n", triples(face.rest).c_str(),
              triples(face.normals).c_str());
  std::printf("    \"triangles\": [%s],\n", each(face.triangles, ",", [](const auto& t) {
                                              return "[" + std::to_string(t[0]) + "," + std::to_string(t[1]) + "," +
                                                     std::to_string(t[2]) + "]";
                                            }).c_str());
  std::string rows;
  for (std::size_t v = 0; v < face.rigid.size(); ++v) {
    std::string row;
    for (std::uint32_t k = face.offsets[v]; k < face.offsets[v + 1]; ++k) {
      row += (row.empty() ? "" : ",") + ("[" + std::to_string(face.points[k])) + "," + exact(face.weights[k]) + "]";
    }
    rows += (v == 0 ? "" : ",") + ("[" + row + "]");
  }
  const auto number = [](std::uint8_t value) { return std::to_string(value); };
  std::printf("    \"rows\": [%s],\n    \"rigid\": [%s],\n    \"turn\": [%s]\n  },\n", rows.c_str(),
              each(face.rigid, ",", number).c_str(), each(face.turn, ",", number).c_str());
}

/// Positions and normals of a pose, as the end of a case.
std::string results(const GoldenFace& face, const oracle::Pose& pose) {
  const std::vector<Vec3> positions = oracle::deform(face.view(), face.rig, pose);
  return "\"positions\": " + rounded(positions) + ",\n      \"vertex_normals\": " +
         rounded(oracle::normals(positions, face.triangles, face.rest, face.normals)) + "}";
}

std::string frame_text(const semblante_frame& f) {
  char text[256];
  std::snprintf(text, sizeof text,
                "{\"viseme\":{\"select1\":%d,\"select2\":%d,\"blend\":%d},\"expression\":{\"select1\":%d,"
                "\"intensity1\":%d,\"select2\":%d,\"intensity2\":%d},\"faps\":{",
                f.viseme1, f.viseme2, f.viseme_blend, f.expression1, f.intensity1, f.expression2, f.intensity2);
  std::string faps;
  for (int n = 3; n <= SEMBLANTE_FAP_COUNT; ++n) {
    if (f.fap[n] != 0.0F) faps += (faps.empty() ? "\"" : ",\"") + std::to_string(n) + "\":" + exact(f.fap[n]);
  }
  return text + faps + "}}";
}

/// Half of a rotation, about the same axis.
oracle::Matrix half_of(const oracle::Matrix& m) {
  const double cosine = std::max(-1.0, std::min(1.0, (m[0][0] + m[1][1] + m[2][2] - 1.0) / 2.0));
  const Vec3 axis{m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]};
  const double size = std::sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
  if (size < 1e-12) return m;  // no turn; half a turn does not occur here
  const double angle = std::acos(cosine) / 2.0;
  oracle::Matrix half{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      half[i][j] = (i == j ? std::cos(angle) : 0.0) + (1.0 - std::cos(angle)) * axis[i] * axis[j] / (size * size);
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const double part = std::sin(angle) * axis[i] / size;
    half[(i + 2) % 3][(i + 1) % 3] += part;
    half[(i + 1) % 3][(i + 2) % 3] -= part;
  }
  return half;
}

oracle::Matrix transposed(const oracle::Matrix& m) {
  oracle::Matrix t{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) t[i][j] = m[j][i];
  }
  return t;
}

/// Half way: everything in the mean, rotations half of the one that leads from a to b.
oracle::Pose middle(const oracle::Pose& a, const oracle::Pose& b) {
  oracle::Pose out = a;
  const auto mean = [](Vec3& x, const Vec3& y) {
    for (std::size_t i = 0; i < 3; ++i) x[i] = (x[i] + y[i]) / 2.0;
  };
  for (std::size_t fp = 0; fp < out.fp.size(); ++fp) mean(out.fp[fp], b.fp[fp]);
  for (std::size_t eye = 0; eye < 2; ++eye) {
    mean(out.eye_translation[eye], b.eye_translation[eye]);
    out.eye[eye] = a.eye[eye] * half_of(transposed(a.eye[eye]) * b.eye[eye]);
    out.pupil_growth[eye] = (a.pupil_growth[eye] + b.pupil_growth[eye]) / 2.0;
  }
  out.tongue_roll = (a.tongue_roll + b.tongue_roll) / 2.0;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    for (std::size_t lid = 0; lid < 2; ++lid)
      out.lid_closure[eye][lid] = (a.lid_closure[eye][lid] + b.lid_closure[eye][lid]) / 2.0;
  }
  out.head = a.head * half_of(transposed(a.head) * b.head);
  return out;
}

void print() {
  const GoldenFace face;
  std::printf(
      "{\n  \"about\": \"What any client must give: see README.md beside this file.\",\n"
      "  \"tolerance\": {\"position\": 1e-5, \"normal_degrees\": 0.05},\n");
  print_rig(face);
  print_face(face);
  std::map<std::string, std::pair<std::size_t, oracle::Pose>> poses;
  std::string cases;
  for (const GoldenFrame& frame : testing::golden_frames()) {
    semblante_rig rig = face.rig;
    rig.lip_share = frame.jaw_takes_lip ? 1.0F : 0.0F;
    const oracle::Pose pose = oracle::evaluate(rig, frame.frame);
    poses.emplace(frame.name, std::pair{poses.size(), pose});
    cases += (cases.empty() ? "" : ",\n    ") + ("{\"name\": \"" + frame.name + "\",\n      \"frame\": ") +
             frame_text(frame.frame) + (frame.jaw_takes_lip ? ",\n      \"jaw_takes_lip\": true" : "") + ",\n      " +
             results(face, pose);
  }
  std::string middles;
  for (const auto& [from, to] : testing::golden_middles()) {
    const auto& [a, pose_a] = poses.at(from);
    const auto& [b, pose_b] = poses.at(to);
    middles += (middles.empty() ? "" : ",\n    ") + ("{\"from\": " + std::to_string(a)) +
               ", \"to\": " + std::to_string(b) + ", \"t\": 0.5,\n      " + results(face, middle(pose_a, pose_b));
  }
  std::printf("  \"cases\": [\n    %s],\n  \"interpolations\": [\n    %s]\n}\n", cases.c_str(), middles.c_str());
}

}  // namespace
}  // namespace semblante

int main() { semblante::print(); }
