#include "deploy/sample_head/sample_head.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

#include "deploy/sample_head/body.h"
#include "deploy/sample_head/emit.h"
#include "deploy/sample_head/eyeballs.h"
#include "deploy/sample_head/feature_points.h"
#include "deploy/sample_head/hair.h"
#include "deploy/sample_head/identity.h"
#include "deploy/sample_head/mouth_parts.h"
#include "deploy/sample_head/scan.h"
#include "deploy/sample_head/shirt.h"
#include "deploy/sample_head/skeleton.h"
#include "deploy/sample_head/skin.h"
#include "deploy/sample_head/textures.h"
#include "deploy/sample_head/upper_lid.h"

namespace semblante {

using namespace sample_head_detail;

namespace {

/// Converts sRGB 0..1 to the linear factor of glTF.
glm::vec4 linear(double r, double g, double b) {
  const auto one = [](double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
  return {one(r), one(g), one(b), 1.0};
}

enum Material : std::size_t {
  skin_material,
  eye_material,
  teeth_material,
  tongue_material,
  hair_material,
  cloth_material,
  trousers_material  ///< of a body alone
};

/// Adds parts to a head and numbers vertices as a reader of the file does.
class Assembly {
 public:
  Assembly(SampleHead& head, const SampleHeadTraits& traits) : head_(head), traits_(traits) {}

  using Marks = std::map<std::string, int, std::less<>>;

  void add(const std::string& name, Material material, const HalfMesh& half, const Marks& marks,
           const UvOf& uv_of = skin_uv) {
    EmittedMesh emitted = emit_symmetric(name, material, half, uv_of);
    shape(emitted.mesh);
    for (const auto& [id, vertex] : marks) {
      const auto v = static_cast<std::size_t>(vertex);
      add_point(id, emitted.mesh, emitted.left[v]);
      if (const std::string mirror = mirror_of(id); mirror != id) add_point(mirror, emitted.mesh, emitted.right[v]);
    }
    push(std::move(emitted.mesh));
  }

  void add(Eyeball eye, const std::string& pupil_id) {
    shape(eye.mesh);
    add_point(pupil_id, eye.mesh, eye.pupil);
    push(std::move(eye.mesh));
  }

 private:
  void shape(SampleHeadMesh& mesh) const {
    if (traits_.jaw_width != 1.0 || traits_.face_length != 1.0 || traits_.nose_length != 1.0) reshape(mesh, traits_);
  }
  void add_point(const std::string& id, const SampleHeadMesh& mesh, std::uint32_t vertex) {
    const auto parsed = parse_feature_point(id);
    assert(parsed);
    head_.points.push_back({*parsed, first_ + vertex, mesh.positions[vertex]});
  }
  void push(SampleHeadMesh mesh) {
    first_ += static_cast<std::uint32_t>(mesh.positions.size());
    head_.meshes.push_back(std::move(mesh));
  }

  SampleHead& head_;
  const SampleHeadTraits& traits_;
  std::uint32_t first_ = 0;
};

}  // namespace

SampleHead make_sample_head(const SampleHeadTraits& traits) {
  if (traits.form == SampleHeadForm::scan) {
    SampleHeadTraits scanned = traits;
    scanned.form = SampleHeadForm::bust;
    scanned.closed_eyes = true;
    return scan_of(make_sample_head(scanned));
  }
  SampleHead head;
  const Skin skin = make_skin(traits);
  head.images = {paint_skin(skin.mesh), paint_eye(), paint_teeth(), paint_hair()};
  const glm::vec4 white(1.0F);
  head.materials = {{"skin", white, 0.55F, 0, false}, {"eye", white, 0.15F, 1, false},
                    {"teeth", white, 0.3F, 2, true},  {"tongue", linear(0.78, 0.42, 0.42), 0.45F, std::nullopt, false},
                    {"hair", white, 0.75F, 3, true},  {"cloth", linear(0.36, 0.47, 0.55), 0.9F, std::nullopt, true}};
  const UvOf by_gum = [](const Vec3&, const Paint& paint, Chart) { return Vec2(0.5, 1.0 - paint.lip); };

  Assembly assembly(head, traits);
  assembly.add("skin", skin_material, skin.mesh, skin.marks);
  const UpperLid lid = make_upper_lid(traits.closed_eyes);
  assembly.add("upper lids", skin_material, lid.mesh, lid.marks);
  for (const bool right : {false, true}) assembly.add(make_eyeball(right, eye_material), right ? "3.6" : "3.5");
  const MouthPart upper = make_upper_teeth();
  const MouthPart lower = make_lower_teeth();
  const MouthPart tongue = make_tongue();
  assembly.add("upper teeth", teeth_material, upper.mesh, upper.marks, by_gum);
  assembly.add("lower teeth", teeth_material, lower.mesh, lower.marks, by_gum);
  assembly.add("tongue", tongue_material, tongue.mesh, tongue.marks);
  const Hair hair = make_hair();
  assembly.add("hair", hair_material, hair.mesh, {{"11.5", hair.top}},
               [](const Vec3& p, const Paint&, Chart) { return hair_uv(p); });
  assembly.add("shirt", cloth_material, make_shirt(), {});
  if (traits.form == SampleHeadForm::body) {
    head.materials.push_back({"trousers", linear(0.22, 0.24, 0.3), 0.9F, std::nullopt, true});
    for (const BodyPart& part : make_body_parts()) {
      const UvOf plain = [&](const Vec3&, const Paint&, Chart) { return bare_skin_uv(); };
      const Material material = part.look == BodyPart::Look::skin    ? skin_material
                                : part.look == BodyPart::Look::shirt ? cloth_material
                                                                     : trousers_material;
      assembly.add(part.name, material, part.mesh, {}, plain);
    }
  }
  head.points.push_back({*parse_feature_point("7.1"), std::nullopt, glm::vec3(head_pivot * 0.01)});
  std::sort(head.points.begin(), head.points.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  if (traits.form == SampleHeadForm::body) {
    head.name = "sample-body";
    add_skeleton(head);
  }
  return head;
}

}  // namespace semblante
