// semblante-perform: draws a performance on a head, without a server: one image per frame, or a sheet of given times.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

#include <CLI/CLI.hpp>

#include "clients/native/render/renderer.h"
#include "clients/native/tools/files.h"
#include "clients/native/tools/run_tool.h"
#include "clients/native/tools/shots.h"
#include "core/import/model_formats.h"
#include "core/performance/performance.h"
#include "protocol/cpp/performance_document.h"
#include "tests/pictures/contact_sheet.h"
#include "tests/pictures/posed_head.h"

namespace semblante::pictures {
namespace {

struct Arguments {
  std::filesystem::path model, feature_points, performance, out;
  std::string shot = "front:face";
  std::string size = "340x400";
  double fps = 25.0;
  double from = 0.0;
  double to = 0.0;
  std::vector<double> times;
  int columns = 0;
  WeightMethod weights = WeightMethod::smooth;
};

constexpr double most_pictures = 100'000.0;

Result<Performance> load_performance(const std::filesystem::path& path) {
  const auto bytes = tools::read_file(path);
  if (!bytes) {
    return bytes.error();
  }
  const auto named = [&](Error error) {
    error.where = path.string() + error.where;
    return error;
  };
  const auto script = read_performance({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
  if (!script) {
    return named(script.error());
  }
  auto performance = Performance::compile(*script);
  if (!performance) {
    return named(performance.error());
  }
  return performance;
}

/// The times to draw, ms.
Result<std::vector<double>> moments(const Arguments& arguments, const Performance& performance) {
  if (!arguments.times.empty()) {
    return arguments.times;
  }
  const double end = arguments.to > 0.0 ? arguments.to : performance.duration();
  if (end <= arguments.from) {
    return Error{ErrorCode::missing, "--to", "required: the performance has no end, or ends before --from"};
  }
  const double count = std::ceil((end - arguments.from) * arguments.fps / 1000.0);
  if (count > most_pictures) {
    return Error{ErrorCode::too_large, "--to", "more than 100000 images"};
  }
  std::vector<double> times;
  for (double k = 0.0; k < count; k += 1.0) {
    times.push_back(arguments.from + k * 1000.0 / arguments.fps);
  }
  return times;
}

Status run(const Arguments& arguments) {
  const auto size = tools::parse_size(arguments.size);
  if (!size) {
    return size.error();
  }
  const auto shot = tools::parse_shot(arguments.shot);
  if (!shot) {
    return shot.error();
  }
  const auto performance = load_performance(arguments.performance);
  if (!performance) {
    return performance.error();
  }
  const auto times = moments(arguments, *performance);
  if (!times) {
    return times.error();
  }
  const auto head = load_posed_head(arguments.model, arguments.feature_points, arguments.weights);
  if (!head) {
    return head.error();
  }
  auto scene = render::build_scene(head->model, {.points = head->rig.points, .role_of_vertex = head->roles()});
  if (!scene) {
    return std::move(scene).error();
  }
  auto renderer = render::Renderer::create(*std::move(scene));
  if (!renderer) {
    return std::move(renderer).error();
  }
  const bool sheet = arguments.out.extension() == ".png";
  if (!sheet) {
    std::filesystem::create_directories(arguments.out);
  }
  std::vector<LabelledPicture> pictures;
  for (std::size_t i = 0; i < times->size(); ++i) {
    const double ms = (*times)[i];
    if (auto set = renderer->set_positions(head->pose(performance->frame_at(ms))); !set) {
      return set;
    }
    auto picture = renderer->draw(shot->view, shot->subject, *size);
    if (!picture) {
      return std::move(picture).error();
    }
    if (sheet) {
      pictures.push_back({std::to_string(std::lround(ms)) + " ms", *std::move(picture)});
      continue;
    }
    char name[32];
    std::snprintf(name, sizeof name, "frame-%05zu.png", i);
    if (auto written = write_png(*picture, arguments.out / name); !written) {
      return written;
    }
  }
  if (sheet) {
    const std::string title = performance->name() + "  " + arguments.model.filename().string();
    return write_png(contact_sheet(pictures, title, arguments.columns), arguments.out);
  }
  std::cout << times->size() << " pictures in " << arguments.out.string() << '\n';
  return Unit{};
}

}  // namespace
}  // namespace semblante::pictures

int main(int argc, char** argv) {
  semblante::pictures::Arguments arguments;
  CLI::App app{"Draws a performance on a head: one image per frame, or a sheet of given times.", "semblante-perform"};
  app.add_option("model", arguments.model, semblante::model_file_titles())->required();
  app.add_option("performance", arguments.performance, "JSON of a performance")->required();
  app.add_option("-f,--feature-points", arguments.feature_points, "JSON with the marked points")->required();
  app.add_option("-o,--out", arguments.out, "folder for frame-00000.png and so on; a path that ends in .png: one sheet")
      ->required();
  app.add_option("--fps", arguments.fps, "images per second")->check(CLI::Range(0.01, 1000.0))->capture_default_str();
  app.add_option("--from", arguments.from, "start of the drawn time, ms")->check(CLI::Range(0.0, 86'400'000.0));
  app.add_option("--to", arguments.to, "end of the drawn time, ms; default: the end of the performance")
      ->check(CLI::Range(0.0, 86'400'000.0));
  app.add_option("--times", arguments.times, "times to draw instead of a rate, ms, separated by commas")
      ->delimiter(',')
      ->check(CLI::Range(0.0, 86'400'000.0));
  app.add_option("--shot", arguments.shot, "VIEW or VIEW:SUBJECT")->capture_default_str();
  app.add_option("--size", arguments.size, "size of one image in pixels")->capture_default_str();
  app.add_option("--columns", arguments.columns, "columns of the sheet; 0: about as wide as high");
  app.add_option("--weights", arguments.weights, "method of the weights: " + semblante::pictures::weight_method_list())
      ->type_name("METHOD")
      ->transform(CLI::CheckedTransformer(semblante::pictures::weight_methods()).description(""));
  return semblante::tools::run_tool(app, argc, argv, [&] { return semblante::pictures::run(arguments); });
}
