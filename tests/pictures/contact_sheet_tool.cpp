// semblante-contact-sheet: draws every viseme and expression of a head on sheets.

#include <algorithm>
#include <iostream>

#include <CLI/CLI.hpp>

#include "clients/native/render/renderer.h"
#include "clients/native/tools/run_tool.h"
#include "clients/native/tools/shots.h"
#include "core/expressions/library.h"
#include "core/import/model_formats.h"
#include "tests/pictures/contact_sheet.h"
#include "tests/pictures/posed_head.h"

namespace semblante::pictures {
namespace {

struct Arguments {
  std::filesystem::path model;
  std::filesystem::path feature_points;
  std::filesystem::path out;
  std::vector<std::string> shots = {"front:face", "three-quarter:face"};
  std::vector<std::string> faps;
  std::string size = "340x400";
  std::vector<WeightMethod> weights = {WeightMethod::paper};
  std::uint32_t max_vertices = 0;
  int jpeg_quality = 0;  ///< 0: PNG
  bool matrix = false;
  bool only_faps = false;
};

struct NamedFrame {
  std::string name;
  semblante_frame frame{};
};

struct Sheet {
  std::string name;
  int columns;
  std::vector<NamedFrame> frames;
};

/// A viseme and an expression, both at full strength, blended by Eq. 5; 0 of either has no effect.
semblante_frame frame_of(std::uint8_t viseme, std::uint8_t expression) {
  semblante_frame frame{};
  frame.viseme1 = viseme;
  frame.viseme_blend = SEMBLANTE_BLEND_MAX;
  frame.expression1 = expression;
  frame.intensity1 = SEMBLANTE_BLEND_MAX;
  return frame;
}

std::string name_of(std::uint8_t viseme, std::uint8_t expression) {
  const std::string speech(viseme_library()[viseme].name);
  const std::string mood(expression_library()[expression].name);
  return expression == 0 ? speech : viseme == 0 ? mood : speech + " + " + mood;
}

/// Expressions in columns, visemes in rows; the row `sil` has only the expressions, the column "none" only the visemes.
Sheet matrix() {
  Sheet sheet{"matrix", static_cast<int>(expression_library().size()), {}};
  for (std::uint8_t v = 0; v < viseme_library().size(); ++v) {
    for (std::uint8_t x = 0; x < expression_library().size(); ++x) {
      // Only the first column has the name of the viseme: a cell has no room for both names.
      const std::string name = x == 0 || v == 0 ? name_of(v, x) : "+ " + name_of(0, x);
      sheet.frames.push_back({name, frame_of(v, x)});
    }
  }
  return sheet;
}

Result<std::vector<Sheet>> sheets(const Arguments& arguments) {
  std::vector<Sheet> list;
  if (arguments.matrix) {
    list.push_back(matrix());
  } else if (!arguments.only_faps) {
    Sheet expressions{"expressions", 4, {{"neutral", {}}}};
    for (std::uint8_t i = 1; i < expression_library().size(); ++i) {
      expressions.frames.push_back({name_of(0, i), frame_of(0, i)});
    }
    expressions.frames.push_back({name_of(10, 1), frame_of(10, 1)});
    list.push_back(std::move(expressions));
    Sheet visemes{"visemes", 5, {}};
    for (std::uint8_t i = 0; i < viseme_library().size(); ++i) {
      visemes.frames.push_back({name_of(i, 0), frame_of(i, 0)});
    }
    list.push_back(std::move(visemes));
  }
  if (!arguments.faps.empty()) {
    Sheet own{"faps", 0, {}};
    for (const std::string& text : arguments.faps) {
      auto frame = parse_faps(text);
      if (!frame) {
        return std::move(frame).error();
      }
      own.frames.push_back({text, *frame});
    }
    list.push_back(std::move(own));
  }
  return list;
}

/// Number of faces per row of a sheet that compares methods; each face is drawn with every method.
constexpr int side_by_side = 2;

/// A head with the weights of one method, and its renderer.
struct Posed {
  std::string method;
  PosedHead head;
  render::Renderer renderer;
};

Result<Posed> pose_with(const Arguments& arguments, WeightMethod method) {
  auto head = load_posed_head(arguments.model, arguments.feature_points, method, arguments.max_vertices);
  if (!head) {
    return std::move(head).error();
  }
  if (method == arguments.weights.front()) {
    for (const std::string& warning : head->warnings) {
      std::cerr << "semblante-contact-sheet: " << warning << '\n';
    }
  }
  auto scene = render::build_scene(head->model, {.points = head->rig.points, .role_of_vertex = head->roles()});
  if (!scene) {
    return std::move(scene).error();
  }
  auto renderer = render::Renderer::create(*std::move(scene));
  if (!renderer) {
    return std::move(renderer).error();
  }
  return Posed{std::string(weight_method_names[static_cast<std::size_t>(method)]), *std::move(head),
               *std::move(renderer)};
}

std::string file_name(std::string text, bool jpeg) {
  std::replace(text.begin(), text.end(), ':', '-');
  return text + (jpeg ? ".jpg" : ".png");
}

Status run(const Arguments& arguments) {
  const auto size = tools::parse_size(arguments.size);
  if (!size) {
    return size.error();
  }
  const auto shots = tools::parse_shots(arguments.shots);
  if (!shots) {
    return shots.error();
  }
  auto list = sheets(arguments);
  if (!list) {
    return std::move(list).error();
  }
  std::vector<Posed> posed;
  for (const WeightMethod method : arguments.weights) {
    auto one = pose_with(arguments, method);
    if (!one) {
      return std::move(one).error();
    }
    posed.push_back(*std::move(one));
  }
  std::filesystem::create_directories(arguments.out);
  for (const Sheet& sheet : *list) {
    std::vector<std::vector<LabelledPicture>> pictures(shots->size());
    for (const NamedFrame& named : sheet.frames) {
      for (Posed& face : posed) {
        if (auto set = face.renderer.set_positions(face.head.pose(named.frame)); !set) {
          return set;
        }
        for (std::size_t s = 0; s < shots->size(); ++s) {
          auto picture = face.renderer.draw((*shots)[s].view, (*shots)[s].subject, *size);
          if (!picture) {
            return std::move(picture).error();
          }
          pictures[s].push_back({posed.size() > 1 ? named.name + "  " + face.method : named.name, *std::move(picture)});
        }
      }
    }
    for (std::size_t s = 0; s < shots->size(); ++s) {
      const std::string title = arguments.model.filename().string() + "  " + sheet.name + "  " + (*shots)[s].name;
      const bool jpeg = arguments.jpeg_quality > 0;
      const std::filesystem::path path = arguments.out / file_name(sheet.name + "-" + (*shots)[s].name, jpeg);
      const int columns = posed.size() > 1 ? static_cast<int>(posed.size()) * side_by_side : sheet.columns;
      const render::Picture picture = contact_sheet(pictures[s], title, columns);
      if (auto written = jpeg ? write_jpeg(picture, path, arguments.jpeg_quality) : write_png(picture, path);
          !written) {
        return written;
      }
      std::cout << path.string() << '\n';
    }
  }
  return Unit{};
}

}  // namespace
}  // namespace semblante::pictures

int main(int argc, char** argv) {
  semblante::pictures::Arguments arguments;
  CLI::App app{"Parametrizes a head and draws its 15 visemes and 6 expressions on sheets.", "semblante-contact-sheet"};
  app.add_option("model", arguments.model, semblante::model_file_titles())->required();
  app.add_option("-f,--feature-points", arguments.feature_points, "JSON with the marked points")->required();
  app.add_option("-o,--out", arguments.out, "folder for the sheets, one per shot")->required();
  app.add_option("-s,--shot", arguments.shots, "VIEW or VIEW:SUBJECT, repeatable")->capture_default_str();
  app.add_option("--size", arguments.size, "size of one image in pixels")->capture_default_str();
  app.add_option("--frame", arguments.faps, "an additional face, NUMBER=VALUE,... in FAP units; repeatable");
  app.add_option("--weights", arguments.weights,
                 "method of the weights: " + semblante::pictures::weight_method_list() +
                     "; two of them for a sheet that compares them")
      ->type_name("METHOD")
      ->expected(1, 2)
      ->transform(CLI::CheckedTransformer(semblante::pictures::weight_methods()).description(""));
  app.add_option("--max-vertices", arguments.max_vertices,
                 "draw the level of detail with at most this many vertices; 0: the full mesh");
  app.add_flag("--matrix", arguments.matrix,
               "one sheet of all combinations, visemes in rows, expressions in columns, instead of the two sheets");
  app.add_option("--jpeg", arguments.jpeg_quality, "JPEG of this quality, 1 to 100, instead of PNG")
      ->check(CLI::Range(1, 100));
  app.add_flag("--only-frames", arguments.only_faps, "draw only the faces of --frame, no visemes and expressions");
  return semblante::tools::run_tool(app, argc, argv, [&] { return semblante::pictures::run(arguments); });
}
