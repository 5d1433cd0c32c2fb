// semblante-render: draws a model file from several sides.

#include <algorithm>
#include <iostream>

#include <CLI/CLI.hpp>

#include "clients/native/render/renderer.h"
#include "clients/native/tools/run_tool.h"
#include "clients/native/tools/shots.h"
#include "core/anatomy/part_roles.h"
#include "core/import/model_formats.h"
#include "core/materials/painted_eyes.h"
#include "core/pipeline/standing.h"
#include "tests/pictures/contact_sheet.h"
#include "tests/pictures/posed_head.h"

namespace semblante::pictures {
namespace {

struct Arguments {
  std::filesystem::path model;
  std::filesystem::path out;
  std::vector<std::string> shots = {"front",      "three-quarter",      "left",       "below",
                                    "front:face", "three-quarter:face", "front:eyes", "front:mouth"};
  std::string size = "420x480";
  int columns = 4;
  bool separate = false;
};

Status run(const Arguments& arguments) {
  const auto size = tools::parse_size(arguments.size);
  if (!size) {
    return size.error();
  }
  const auto shots = tools::parse_shots(arguments.shots);
  if (!shots) {
    return shots.error();
  }
  auto imported = load_model(arguments.model);
  if (!imported) {
    return std::move(imported).error();
  }
  auto head = stand_head(*std::move(imported), {});
  if (!head) {
    return head.error();
  }
  for (const std::string& warning : head->warnings.all()) {
    std::cerr << "semblante-render: " << warning << '\n';
  }
  const std::vector<Part> parts = describe_parts(head->model, head->surface, {}, {});
  paint_eyes(head->model, head->surface, parts, guessed_eyes(parts));
  std::vector<PartRole> roles(head->model.positions.size());
  for (std::size_t v = 0; v < roles.size(); ++v) {
    roles[v] = parts[head->surface.part_of[head->surface.surface_of[v].value()].value()].role;
  }
  auto scene = render::build_scene(head->model, {.points = {}, .role_of_vertex = roles});
  if (!scene) {
    return std::move(scene).error();
  }
  auto renderer = render::Renderer::create(*std::move(scene));
  if (!renderer) {
    return std::move(renderer).error();
  }
  for (const std::string& warning : renderer->scene().warnings) {
    std::cerr << "semblante-render: " << warning << '\n';
  }
  std::vector<LabelledPicture> pictures;
  for (const tools::Shot& shot : *shots) {
    auto picture = renderer->draw(shot.view, shot.subject, *size);
    if (!picture) {
      return std::move(picture).error();
    }
    pictures.push_back({shot.name, *std::move(picture)});
  }
  if (!arguments.separate) {
    const bool one = pictures.size() == 1;
    return write_png(
        one ? pictures[0].picture : contact_sheet(pictures, arguments.model.filename().string(), arguments.columns),
        arguments.out);
  }
  std::filesystem::create_directories(arguments.out);
  for (const LabelledPicture& picture : pictures) {
    std::string name = picture.label + ".png";
    std::replace(name.begin(), name.end(), ':', '-');
    if (auto written = write_png(picture.picture, arguments.out / name); !written) {
      return written;
    }
  }
  return Unit{};
}

}  // namespace
}  // namespace semblante::pictures

int main(int argc, char** argv) {
  semblante::pictures::Arguments arguments;
  CLI::App app{"Draws a head from several sides, without a window.", "semblante-render"};
  app.add_option("model", arguments.model, semblante::model_file_titles())->required();
  app.add_option("-o,--out", arguments.out, "PNG to write: one shot, or a sheet of all; with --separate a folder")
      ->required();
  app.add_option("-s,--shot", arguments.shots,
                 "VIEW or VIEW:SUBJECT, repeatable; views front three-quarter left below "
                 "right above back, subjects all face eyes mouth")
      ->capture_default_str();
  app.add_option("--size", arguments.size, "size of one image in pixels")->capture_default_str();
  app.add_option("--columns", arguments.columns, "columns of the sheet")->capture_default_str();
  app.add_flag("--separate", arguments.separate, "write one file per shot");
  return semblante::tools::run_tool(app, argc, argv, [&] { return semblante::pictures::run(arguments); });
}
