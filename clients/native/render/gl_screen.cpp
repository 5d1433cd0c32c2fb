#include "clients/native/render/gl_screen.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include <GLES3/gl3.h>
#include <glm/vec2.hpp>

#include "clients/native/render/backdrop.h"
#include "clients/native/render/gl_program.h"
#include "clients/native/render/shaders.h"
#include "clients/native/render/text_quads.h"

namespace semblante::render {
namespace {

/// Letters have this share of the smaller side of the window as their height, in whole pixels of the font.
constexpr int lines_in_a_window = 30;

/// What the head is drawn on: several samples for each pixel, and their mean as a texture.
struct Layer {
  GLuint samples_framebuffer = 0, color = 0, depth = 0;
  GLuint framebuffer = 0, texture = 0;
  int width = 0, height = 0, samples = 0;

  Layer() = default;
  Layer(const Layer&) = delete;
  Layer& operator=(const Layer&) = delete;
  ~Layer() { drop(); }

  void drop() {
    glDeleteFramebuffers(1, &samples_framebuffer);
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteRenderbuffers(1, &color);
    glDeleteRenderbuffers(1, &depth);
    glDeleteTextures(1, &texture);
  }

  Status resize(int w, int h, int wanted) {
    if (w == width && h == height && wanted == samples) {
      return Unit{};
    }
    drop();
    width = w;
    height = h;
    samples = wanted;
    GLint most = 1;
    glGetInternalformativ(GL_RENDERBUFFER, GL_SRGB8_ALPHA8, GL_SAMPLES, 1, &most);
    const GLsizei count = std::clamp(wanted, 1, std::max(most, 1));
    glGenRenderbuffers(1, &color);
    glGenRenderbuffers(1, &depth);
    glBindRenderbuffer(GL_RENDERBUFFER, color);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, count > 1 ? count : 0, GL_SRGB8_ALPHA8, w, h);
    glBindRenderbuffer(GL_RENDERBUFFER, depth);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, count > 1 ? count : 0, GL_DEPTH_COMPONENT24, w, h);
    glGenFramebuffers(1, &samples_framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, samples_framebuffer);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
    const bool is_complete = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_SRGB8_ALPHA8, w, h);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    if (!is_complete || glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
      samples = 0;
      return Error{ErrorCode::internal, "framebuffer", "the driver does not support a framebuffer of this size"};
    }
    return Unit{};
  }

  void average() const {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, samples_framebuffer);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }
};

}  // namespace

struct GlScreen::Impl {
  GLuint present_program = 0, words_program = 0;
  GLuint no_attributes = 0, words_array = 0, words_buffer = 0;
  Layer layer;
  int width = 0, height = 0;

  Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    glDeleteProgram(present_program);
    glDeleteProgram(words_program);
    glDeleteVertexArrays(1, &no_attributes);
    glDeleteVertexArrays(1, &words_array);
    glDeleteBuffers(1, &words_buffer);
  }

  Status start() {
    auto present = link_program(shaders::present_vertex, shaders::present_fragment);
    if (!present) {
      return std::move(present).error();
    }
    present_program = *present;
    auto words = link_program(shaders::words_vertex, shaders::words_fragment);
    if (!words) {
      return std::move(words).error();
    }
    words_program = *words;
    glGenVertexArrays(1, &no_attributes);
    glGenVertexArrays(1, &words_array);
    glBindVertexArray(words_array);
    glGenBuffers(1, &words_buffer);
    glBindBuffer(GL_ARRAY_BUFFER, words_buffer);
    glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, sizeof(glm::vec2), nullptr);
    glEnableVertexAttribArray(0);
    return Unit{};
  }

  void present() const {
    glUseProgram(present_program);
    glUniform3fv(glGetUniformLocation(present_program, "top"), 1, backdrop_top.data());
    glUniform3fv(glGetUniformLocation(present_program, "bottom"), 1, backdrop_bottom.data());
    glUniform1i(glGetUniformLocation(present_program, "head"), 0);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, layer.texture);
    glBindVertexArray(no_attributes);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }

  void draw_words(std::string_view text) const {
    const std::vector<TextQuad> letters = text_quads(text);
    TextQuad all{0, 0, 0, text_line_height};
    for (const TextQuad& q : letters) {
      all.right = std::max(all.right, q.right);
      all.bottom = std::max(all.bottom, q.bottom);
    }
    const float margin = text_line_height / 2;
    const int wanted = std::max(1, std::min(width, height) / (lines_in_a_window * static_cast<int>(text_line_height)));
    const int fitting = static_cast<int>(static_cast<float>(width) / (all.right + 4 * margin));
    const auto scale = static_cast<float>(std::clamp(wanted, 1, std::max(fitting, 1)));
    const glm::vec2 start{(static_cast<float>(width) - all.right * scale) / 2,
                          static_cast<float>(height) - (all.bottom + 2 * margin) * scale};
    std::vector<glm::vec2> corners;
    const auto add = [&](const TextQuad& q) {
      const auto at = [&](float x, float y) {
        const glm::vec2 pixel = start + scale * glm::vec2(x, y);
        return glm::vec2(2 * pixel.x / static_cast<float>(width) - 1, 1 - 2 * pixel.y / static_cast<float>(height));
      };
      for (const glm::vec2 corner : {at(q.left, q.top), at(q.left, q.bottom), at(q.right, q.top), at(q.right, q.top),
                                     at(q.left, q.bottom), at(q.right, q.bottom)}) {
        corners.push_back(corner);
      }
    };
    add({all.left - margin, all.top - margin, all.right + margin, all.bottom + margin / 2});
    for (const TextQuad& q : letters) {
      add(q);
    }
    glBindVertexArray(words_array);
    glBindBuffer(GL_ARRAY_BUFFER, words_buffer);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size() * sizeof(glm::vec2)), corners.data(),
                 GL_STREAM_DRAW);
    glUseProgram(words_program);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    const GLint color = glGetUniformLocation(words_program, "tint");
    glUniform4f(color, 0.1F, 0.1F, 0.12F, 0.75F);
    glDrawArrays(GL_TRIANGLES, 0, 6);
    glUniform4f(color, 1, 1, 1, 1);
    glDrawArrays(GL_TRIANGLES, 6, static_cast<GLsizei>(corners.size()) - 6);
    glDisable(GL_BLEND);
  }
};

GlScreen::GlScreen(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
GlScreen::~GlScreen() = default;
GlScreen::GlScreen(GlScreen&&) noexcept = default;
GlScreen& GlScreen::operator=(GlScreen&&) noexcept = default;

Result<GlScreen> GlScreen::create() {
  auto impl = std::make_unique<Impl>();
  if (auto started = impl->start(); !started) {
    return std::move(started).error();
  }
  return GlScreen(std::move(impl));
}

Status GlScreen::draw(GlHead* head, const Camera& camera, int width, int height, int samples, std::string_view words) {
  Impl& impl = *impl_;
  impl.width = width;
  impl.height = height;
  if (auto sized = impl.layer.resize(width, height, samples); !sized) {
    return sized;
  }
  if (head != nullptr) {
    head->draw(camera, impl.layer.samples_framebuffer, width, height);
  } else {
    glBindFramebuffer(GL_FRAMEBUFFER, impl.layer.samples_framebuffer);
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT);
  }
  impl.layer.average();
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, width, height);
  glDisable(GL_DEPTH_TEST);
  impl.present();
  if (!words.empty()) {
    impl.draw_words(words);
  }
  if (const GLenum fault = glGetError(); fault != GL_NO_ERROR) {
    return Error{ErrorCode::internal, "opengl", "fault " + std::to_string(fault)};
  }
  return Unit{};
}

Picture GlScreen::read() const {
  const Impl& impl = *impl_;
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(impl.width) * impl.height * 4);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glReadPixels(0, 0, impl.width, impl.height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  Picture picture(impl.width, impl.height, {0, 0, 0});
  for (int y = 0; y < impl.height; ++y) {
    const std::uint8_t* row = &pixels[static_cast<std::size_t>(impl.height - 1 - y) * impl.width * 4];
    for (int x = 0; x < impl.width; ++x) {
      std::copy_n(row + std::ptrdiff_t{x} * 4, 3,
                  picture.rgb.begin() + (static_cast<std::ptrdiff_t>(y) * impl.width + x) * 3);
    }
  }
  return picture;
}

}  // namespace semblante::render
