#include "clients/native/render/renderer.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <GLES3/gl3.h>

#include "clients/native/render/downsample.h"
#include "clients/native/render/gl_context.h"
#include "clients/native/render/gl_head.h"

namespace semblante::render {
namespace {

constexpr int min_side = 16;
constexpr int max_side = 4096;
/// Above this many drawn pixels a side the picture is fine enough with 2 x 2 samples.
constexpr int fine_side = 1024;

struct Target {
  GLuint framebuffer = 0;
  GLuint color = 0;
  GLuint depth = 0;
  int width = 0;
  int height = 0;

  void resize(int w, int h) {
    if (w == width && h == height) {
      return;
    }
    if (framebuffer == 0) {
      glGenFramebuffers(1, &framebuffer);
      glGenRenderbuffers(1, &color);
      glGenRenderbuffers(1, &depth);
    }
    width = w;
    height = h;
    glBindRenderbuffer(GL_RENDERBUFFER, color);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_SRGB8_ALPHA8, w, h);
    glBindRenderbuffer(GL_RENDERBUFFER, depth);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, w, h);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
  }
};

}  // namespace

struct Renderer::Impl {
  std::unique_ptr<GlContext> context;
  GlHead head;
  Target target;

  // What the head holds is of this context, not of another renderer's.
  ~Impl() { context->make_current(); }
};

Renderer::Renderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

Result<Renderer> Renderer::create(Scene scene) {
  auto context = GlContext::create();
  if (!context) {
    return std::move(context).error();
  }
  auto head = GlHead::create(std::move(scene));
  if (!head) {
    return std::move(head).error();
  }
  return Renderer(std::unique_ptr<Impl>(new Impl{*std::move(context), *std::move(head), {}}));
}

const Scene& Renderer::scene() const { return impl_->head.scene(); }

Status Renderer::set_positions(std::span<const glm::vec3> positions) {
  impl_->context->make_current();
  return impl_->head.set_positions(positions);
}

Result<Picture> Renderer::draw(const Camera& camera, PictureSize size) {
  if (std::min(size.width, size.height) < min_side || std::max(size.width, size.height) > max_side) {
    return Error{ErrorCode::invalid_argument, "size", "width and height must be 16 to 4096 pixels"};
  }
  Impl& impl = *impl_;
  impl.context->make_current();
  const int factor = std::max(size.width, size.height) > fine_side ? 2 : 3;
  impl.target.resize(size.width * factor, size.height * factor);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    return Error{ErrorCode::internal, "framebuffer", "the driver does not support a framebuffer of this size"};
  }
  impl.head.draw(camera, impl.target.framebuffer, impl.target.width, impl.target.height);
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(impl.target.width) * impl.target.height * 4);
  glReadPixels(0, 0, impl.target.width, impl.target.height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  if (const GLenum fault = glGetError(); fault != GL_NO_ERROR) {
    return Error{ErrorCode::internal, "opengl", "fault " + std::to_string(fault)};
  }
  return downsample(pixels, size.width, size.height, factor);
}

Result<Picture> Renderer::draw(View view, Subject subject, PictureSize size) {
  const Subjects& subjects = scene().subjects;
  const float aspect = static_cast<float>(size.width) / static_cast<float>(std::max(size.height, 1));
  return draw(frame_box(subjects[subject], subjects.all, view, aspect), size);
}

}  // namespace semblante::render
