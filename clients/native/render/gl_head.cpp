#include "clients/native/render/gl_head.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <GLES3/gl3.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "clients/native/render/gl_program.h"
#include "clients/native/render/shaders.h"

namespace semblante::render {
namespace {

constexpr int first_shadow_side = 2048;

struct DynamicVertex {
  glm::vec3 position;
  glm::vec3 normal;
};

struct StaticVertex {
  glm::vec2 uv;
  Color8 color;
};

template <class T>
const void* offset_of(T value) {
  return reinterpret_cast<const void*>(static_cast<std::uintptr_t>(value));  // NOLINT(performance-no-int-to-ptr)
}

/// Sees the whole scene along `direction` (unit, towards the light), without perspective.
glm::mat4 light_matrix(const Box& scene, glm::vec3 direction) {
  const glm::vec3 centre = scene.centre();
  const float radius = glm::length(scene.size()) * 0.5F;
  const glm::vec3 up = std::abs(direction.y) > 0.95F ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
  return glm::ortho(-radius, radius, -radius, radius, 0.0F, 2.0F * radius) *
         glm::lookAt(centre + direction * radius, centre, up);
}

struct ShadowMap {
  int side = 0;
  GLuint texture = 0;
  GLuint framebuffer = 0;

  ShadowMap() = default;
  ~ShadowMap() { drop(); }
  ShadowMap(const ShadowMap&) = delete;
  ShadowMap& operator=(const ShadowMap&) = delete;

  void drop() {
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteTextures(1, &texture);
  }

  void resize(int pixels) {
    if (pixels == side) {
      return;
    }
    drop();
    side = pixels;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_DEPTH_COMPONENT24, side, side);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture, 0);
  }
};

}  // namespace

struct GlHead::Impl {
  Scene scene;
  GLuint face_program = 0;
  GLuint shadow_program = 0;
  GLuint vertex_array = 0;
  GLuint dynamic_buffer = 0;
  GLuint static_buffer = 0;
  GLuint index_buffer = 0;
  std::vector<GLuint> textures;
  ShadowMap key_shadow;
  ShadowMap front_shadow;
  std::vector<glm::vec3> positions;  ///< #V, as last set
  Box posed_box;

  explicit Impl(Scene s) : scene(std::move(s)) {}
  ~Impl() {
    glDeleteProgram(face_program);
    glDeleteProgram(shadow_program);
    glDeleteVertexArrays(1, &vertex_array);
    for (const GLuint* buffer : {&dynamic_buffer, &static_buffer, &index_buffer}) glDeleteBuffers(1, buffer);
    glDeleteTextures(static_cast<GLsizei>(textures.size()), textures.data());
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  Status start() {
    auto face = link_program(shaders::face_vertex, shaders::face_fragment);
    if (!face) {
      return std::move(face).error();
    }
    face_program = *face;
    auto shadow = link_program(shaders::shadow_vertex, shaders::shadow_fragment);
    if (!shadow) {
      return std::move(shadow).error();
    }
    shadow_program = *shadow;
    upload_fixed();
    upload_textures();
    resize_shadows(first_shadow_side);
    return Unit{};
  }

  void resize_shadows(int side) {
    key_shadow.resize(side);
    front_shadow.resize(side);
  }

  void upload_fixed() {
    glGenVertexArrays(1, &vertex_array);
    glBindVertexArray(vertex_array);
    glGenBuffers(1, &dynamic_buffer);
    glBindBuffer(GL_ARRAY_BUFFER, dynamic_buffer);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(DynamicVertex),
                          offset_of(offsetof(DynamicVertex, position)));
    glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, sizeof(DynamicVertex), offset_of(offsetof(DynamicVertex, normal)));
    std::vector<StaticVertex> fixed(scene.file_vertex.size());
    for (std::size_t r = 0; r < fixed.size(); ++r) {
      fixed[r] = {scene.uvs[r], scene.colors[r]};
    }
    glGenBuffers(1, &static_buffer);
    glBindBuffer(GL_ARRAY_BUFFER, static_buffer);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(fixed.size() * sizeof(StaticVertex)), fixed.data(),
                 GL_STATIC_DRAW);
    glVertexAttribPointer(2, 2, GL_FLOAT, GL_FALSE, sizeof(StaticVertex), offset_of(offsetof(StaticVertex, uv)));
    glVertexAttribPointer(3, 3, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(StaticVertex),
                          offset_of(offsetof(StaticVertex, color)));
    for (GLuint attribute = 0; attribute < 4; ++attribute) {
      glEnableVertexAttribArray(attribute);
    }
    glGenBuffers(1, &index_buffer);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, index_buffer);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(scene.triangles.size() * sizeof(Triangle)),
                 scene.triangles.data(), GL_DYNAMIC_DRAW);
  }

  void upload_textures() {
    textures.resize(scene.textures.size());
    glGenTextures(static_cast<GLsizei>(textures.size()), textures.data());
    for (std::size_t i = 0; i < textures.size(); ++i) {
      const Texture& texture = scene.textures[i];
      glBindTexture(GL_TEXTURE_2D, textures[i]);
      glTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, texture.width, texture.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                   texture.rgba.data());
      glGenerateMipmap(GL_TEXTURE_2D);
      glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
      glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    }
    scene.textures.clear();  // the context holds them now
  }

  [[nodiscard]] static bool is_blended(const Run& run) {
    return run.look.alpha_mode == Material::AlphaMode::blend ||
           (run.look.alpha_mode == Material::AlphaMode::opaque && run.look.alpha < 1.0F);
  }

  [[nodiscard]] static bool is_drawn(const Run& run) { return run.look.alpha > 0.004F && run.triangle_count > 0; }

  void draw_triangles(const Run& run) const {
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(run.triangle_count * 3), GL_UNSIGNED_INT,
                   offset_of(std::size_t{run.first_triangle} * sizeof(Triangle)));
  }

  /// Not lashes, because the shadow of their strips would cover the eye, nor the white round a window before the iris.
  [[nodiscard]] static bool casts_shadow(const Run& run) {
    const bool has_window =
        run.look.substance == Substance::eyeball && run.look.alpha_mode == Material::AlphaMode::mask;
    return is_drawn(run) && !is_blended(run) && !has_window && run.look.substance != Substance::lashes;
  }

  void draw_shadow(const ShadowMap& map, const glm::mat4& to_light) {
    glBindFramebuffer(GL_FRAMEBUFFER, map.framebuffer);
    glViewport(0, 0, map.side, map.side);
    glClear(GL_DEPTH_BUFFER_BIT);
    glUseProgram(shadow_program);
    glUniformMatrix4fv(glGetUniformLocation(shadow_program, "to_light"), 1, GL_FALSE, glm::value_ptr(to_light));
    for (const Run& run : scene.runs) {
      if (casts_shadow(run)) {
        draw_triangles(run);
      }
    }
  }

  /// Far triangles first: what is behind shows through what is before.
  void sort_blended(const Run& run, glm::vec3 eye) {
    std::vector<Triangle> sorted(scene.triangles.begin() + run.first_triangle,
                                 scene.triangles.begin() + run.first_triangle + run.triangle_count);
    const auto distance = [&](const Triangle& t) {
      glm::vec3 sum(0.0F);
      for (const std::uint32_t r : t) {
        sum += positions[scene.file_vertex[r]];
      }
      const glm::vec3 away = sum / 3.0F - eye;
      return glm::dot(away, away);
    };
    std::stable_sort(sorted.begin(), sorted.end(),
                     [&](const Triangle& a, const Triangle& b) { return distance(a) > distance(b); });
    glBufferSubData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLintptr>(run.first_triangle * sizeof(Triangle)),
                    static_cast<GLsizeiptr>(sorted.size() * sizeof(Triangle)), sorted.data());
  }

  [[nodiscard]] GLint uniform(const char* name) const { return glGetUniformLocation(face_program, name); }

  void set_look(const Run& run) const {
    const Look& look = run.look;
    glUniform4f(uniform("base_color"), look.color.r, look.color.g, look.color.b, look.alpha);
    glUniform1f(uniform("roughness"), look.roughness);
    glUniform1f(uniform("specular"), look.specular);
    glUniform1i(uniform("is_skin"), look.substance == Substance::skin || look.substance == Substance::gums ? 1 : 0);
    glUniform1i(uniform("has_texture"), run.texture >= 0 ? 1 : 0);
    glUniform1f(uniform("alpha_cutoff"), look.alpha_mode == Material::AlphaMode::mask ? look.alpha_cutoff : 0.004F);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, run.texture >= 0 ? textures[static_cast<std::size_t>(run.texture)] : 0);
  }

  void draw_face(const Camera& camera, const std::array<glm::vec3, 3>& lights, const std::array<glm::mat4, 2>& to_light,
                 GLuint framebuffer, int width, int height) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, width, height);
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glUseProgram(face_program);
    const float aspect = static_cast<float>(width) / static_cast<float>(height);
    const glm::mat4 to_clip = camera.projection(aspect) * camera.view();
    glUniformMatrix4fv(uniform("to_clip"), 1, GL_FALSE, glm::value_ptr(to_clip));
    glUniformMatrix4fv(uniform("to_light"), 1, GL_FALSE, glm::value_ptr(to_light[0]));
    glUniformMatrix4fv(uniform("to_front_light"), 1, GL_FALSE, glm::value_ptr(to_light[1]));
    glUniform1f(uniform("shadow_offset"), 0.006F * glm::length(posed_box.size()));
    glUniform3fv(uniform("camera"), 1, glm::value_ptr(camera.eye));
    glUniform3fv(uniform("key_direction"), 1, glm::value_ptr(lights[0]));
    glUniform3fv(uniform("fill_direction"), 1, glm::value_ptr(lights[1]));
    glUniform3fv(uniform("rim_direction"), 1, glm::value_ptr(lights[2]));
    glUniform1i(uniform("base_texture"), 0);
    glUniform1i(uniform("key_shadow"), 1);
    glUniform1i(uniform("front_shadow"), 2);
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, key_shadow.texture);
    glActiveTexture(GL_TEXTURE2);
    glBindTexture(GL_TEXTURE_2D, front_shadow.texture);
    for (const bool blended : {false, true}) {
      if (blended) {
        glEnable(GL_BLEND);
        glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
        glDepthMask(GL_FALSE);
      }
      for (const Run& run : scene.runs) {
        if (!is_drawn(run) || is_blended(run) != blended) {
          continue;
        }
        if (blended) {
          sort_blended(run, camera.eye);
        }
        set_look(run);
        draw_triangles(run);
      }
    }
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
  }
};

GlHead::GlHead(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
GlHead::~GlHead() = default;
GlHead::GlHead(GlHead&&) noexcept = default;
GlHead& GlHead::operator=(GlHead&&) noexcept = default;

Result<GlHead> GlHead::create(Scene scene) {
  GlHead head(std::make_unique<Impl>(std::move(scene)));
  if (auto started = head.impl_->start(); !started) {
    return std::move(started).error();
  }
  if (auto set = head.set_positions(head.scene().rest); !set) {
    return std::move(set).error();
  }
  return head;
}

const Scene& GlHead::scene() const { return impl_->scene; }

Status GlHead::set_positions(std::span<const glm::vec3> positions) {
  Impl& impl = *impl_;
  if (positions.size() != impl.scene.rest.size()) {
    return Error{ErrorCode::mismatch, "positions",
                 "the scene has " + std::to_string(impl.scene.rest.size()) + " vertices, not " +
                     std::to_string(positions.size())};
  }
  impl.positions.assign(positions.begin(), positions.end());
  std::vector<glm::vec3> drawn;
  drawn.reserve(impl.scene.file_vertex.size());
  for (const std::uint32_t v : impl.scene.file_vertex) drawn.push_back(positions[v]);
  const std::vector<glm::vec3> normals = impl.scene.normals.compute(drawn);
  std::vector<DynamicVertex> moving;
  moving.reserve(drawn.size());
  impl.posed_box = impl.scene.subjects.all;
  for (std::size_t r = 0; r < drawn.size(); ++r) {
    moving.push_back({drawn[r], normals[r]});
    impl.posed_box.add(drawn[r]);
  }
  glBindBuffer(GL_ARRAY_BUFFER, impl.dynamic_buffer);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(moving.size() * sizeof(DynamicVertex)), moving.data(),
               GL_DYNAMIC_DRAW);
  return Unit{};
}

void GlHead::set_shadow_side(int side) { impl_->resize_shadows(side); }

void GlHead::draw(const Camera& camera, unsigned framebuffer, int width, int height) {
  Impl& impl = *impl_;
  glBindVertexArray(impl.vertex_array);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  // The lights follow the camera by half its angle: profiles are lit well, and a rotation still changes the shading.
  const glm::vec3 towards = glm::normalize(camera.eye - camera.target);
  const float turn = std::atan2(towards.x, towards.z) * 0.6F;
  const glm::mat3 turned(glm::rotate(glm::mat4(1.0F), turn, glm::vec3(0, 1, 0)));
  const std::array<glm::vec3, 3> lights = {turned * glm::normalize(glm::vec3(-0.48F, 0.58F, 0.80F)), towards,
                                           turned * glm::normalize(glm::vec3(0.75F, 0.45F, -0.55F))};
  const std::array<glm::mat4, 2> to_light = {light_matrix(impl.posed_box, lights[0]),
                                             light_matrix(impl.posed_box, lights[1])};
  impl.draw_shadow(impl.key_shadow, to_light[0]);
  impl.draw_shadow(impl.front_shadow, to_light[1]);
  impl.draw_face(camera, lights, to_light, framebuffer, width, height);
}

}  // namespace semblante::render
