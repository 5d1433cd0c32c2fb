#include "clients/native/tools/frame_output.h"

#include <algorithm>
#include <optional>
#include <sstream>
#include <system_error>

#include "clients/native/client/mesh_writer.h"
#include "clients/native/render/renderer.h"
#include "clients/native/tools/files.h"

namespace semblante::tools {

struct FrameOutput::Impl {
  const client::Face& face;
  OutputOptions options;
  Shot shot;
  render::PictureSize size;
  std::optional<render::Renderer> renderer;
  std::size_t count = 0;
  std::ostringstream index;

  [[nodiscard]] bool wants(std::string_view format) const {
    return std::find(options.formats.begin(), options.formats.end(), format) != options.formats.end();
  }

  [[nodiscard]] std::filesystem::path path(std::string_view ending) const {
    std::string number = std::to_string(count);
    number.insert(0, number.size() < 5 ? 5 - number.size() : 0, '0');
    return options.folder / ("frame-" + number + std::string(ending));
  }
};

FrameOutput::FrameOutput(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
FrameOutput::FrameOutput(FrameOutput&&) noexcept = default;
FrameOutput& FrameOutput::operator=(FrameOutput&&) noexcept = default;
FrameOutput::~FrameOutput() = default;

Result<FrameOutput> FrameOutput::create(const client::Face& face, const OutputOptions& options) {
  for (const std::string& format : options.formats) {
    if (format != "obj" && format != "ply" && format != "png" && format != "table") {
      return Error{ErrorCode::invalid_argument, format, "the format must be obj, ply, png or table"};
    }
  }
  auto shot = parse_shot(options.shot);
  if (!shot) {
    return std::move(shot).error();
  }
  const auto size = parse_size(options.size);
  if (!size) {
    return size.error();
  }
  std::error_code problem;
  std::filesystem::create_directories(options.folder, problem);
  if (problem) {
    return Error{ErrorCode::io, options.folder.string(), problem.message()};
  }
  auto impl = std::unique_ptr<Impl>(new Impl{face, options, *std::move(shot), *size, std::nullopt, 0, {}});
  impl->index << "frame,sequence,media_time_ms\n";
  if (impl->wants("png")) {
    const FeaturePointSet points = face.feature_points();
    auto scene = render::build_scene(face.model(), {.points = points, .role_of_vertex = face.roles()});
    if (!scene) {
      return std::move(scene).error();
    }
    auto renderer = render::Renderer::create(*std::move(scene));
    if (!renderer) {
      return std::move(renderer).error();
    }
    impl->renderer.emplace(*std::move(renderer));
  }
  return FrameOutput(std::move(impl));
}

Status FrameOutput::write(std::uint64_t sequence, double media_time) {
  Impl& impl = *impl_;
  const std::vector<glm::vec3> positions = impl.face.positions();
  if (impl.wants("obj")) {
    if (auto done = write_file(impl.path(".obj"), client::write_obj(impl.face.model(), positions)); !done) {
      return done;
    }
  }
  if (impl.wants("ply")) {
    if (auto done = write_file(impl.path(".ply"), client::write_ply(impl.face.model(), positions)); !done) {
      return done;
    }
  }
  if (impl.wants("table")) {
    if (auto done = write_file(impl.path(".csv"), client::write_table(positions)); !done) {
      return done;
    }
  }
  if (impl.renderer) {
    if (auto set = impl.renderer->set_positions(positions); !set) {
      return set;
    }
    auto picture = impl.renderer->draw(impl.shot.view, impl.shot.subject, impl.size);
    if (!picture) {
      return std::move(picture).error();
    }
    if (auto done = write_png(*picture, impl.path(".png")); !done) {
      return done;
    }
  }
  impl.index << impl.count << ',' << sequence << ',' << media_time << '\n';
  ++impl.count;
  return Unit{};
}

Status FrameOutput::finish() { return write_file(impl_->options.folder / "frames.csv", impl_->index.str()); }

}  // namespace semblante::tools
