#include "core/import/obj_reader.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <vector>

#include "core/import/model_builder.h"
#include "core/import/obj_materials.h"
#include "core/import/polygon.h"
#include "core/import/text.h"
#include "core/import/vertex_colors.h"
#include "core/types/letter_case.h"
#include "core/types/printable.h"

namespace semblante::import {
namespace {

/// Reads line by line into flat arrays, then splits the polygons: `f` may precede the `v` it refers to, and splitting
/// needs positions.
class ObjReader {
 public:
  ObjReader(std::span<const std::uint8_t> bytes, const ImportLimits& limits, const ResourceReader& resources)
      : builder_(limits), limits_(limits), lines_(without_bom(as_text(bytes))) {
    if (resources) library_.emplace(builder_, resources);
  }

  Result<Model> read() {
    if (lines_.rest().find('\0') != std::string_view::npos) {
      return Error{ErrorCode::malformed, "", "not an OBJ file: it contains zero bytes, but an OBJ file is text"};
    }
    while (const auto line = lines_.next_logical()) {
      if (Status status = read_line(*line); !status) return status.error();
    }
    if (unknown_lines_ > 0 && polygons_.empty()) {
      return Error{ErrorCode::malformed, first_unknown_, "not an OBJ statement, and the file has no faces"};
    }
    if (Status status = check_forward_references(); !status) return status.error();
    if (library_) {
      for (Material& material : builder_.model.materials) library_->fill(material);
    }
    add_colors();
    add_triangles();
    if (unknown_lines_ > 0) {
      builder_.warn(std::to_string(unknown_lines_) + " lines are not OBJ statements and were skipped; the first is " +
                    first_unknown_);
    }
    if (short_faces_ > 0) builder_.warn(std::to_string(short_faces_) + " faces with fewer than 3 corners were omitted");
    return std::move(builder_).finish("obj");
  }

 private:
  /// The beginning of a run of polygons with the same name and material.
  struct Section {
    std::size_t first_polygon;
    std::string name;
    int material;
  };
  /// An index larger than the number of elements read so far, and its line. Only rising ones are kept, so the first one
  /// out of range at the end is the first in the file.
  struct ForwardReference {
    std::uint32_t index;
    std::size_t line;
  };

  static std::string_view without_bom(std::string_view text) {
    return text.substr(0, 3) == "\xEF\xBB\xBF" ? text.substr(3) : text;
  }

  [[nodiscard]] Error error(ErrorCode code, std::string message) const {
    return {code, lines_.where(), std::move(message)};
  }

  Status read_line(std::string_view rest) {
    const std::string_view keyword = next_token(rest);
    if (keyword.empty() || keyword.front() == '#') return Unit{};
    if (keyword == "v") return read_position(rest);
    if (keyword == "vt") return read_uv(rest);
    if (keyword == "vn") return read_normal(rest);
    if (keyword == "f" || keyword == "fo") return read_face(rest);
    if (keyword == "o" || keyword == "g") {
      name_ = printable(trimmed(rest));  // truncated, because every section keeps a copy
      start_section();
    } else if (keyword == "usemtl") {
      return use_material(trimmed(rest));
    } else if (keyword == "mtllib") {
      use_libraries(trimmed(rest));
    } else if (!is_ignored(keyword) && unknown_lines_++ == 0) {
      first_unknown_ = lines_.where();
    }
    return Unit{};
  }

  /// Smoothing, points, lines, free-form curves and display hints: valid, but not used.
  static bool is_ignored(std::string_view keyword) {
    static constexpr std::array<std::string_view, 33> ignored = {
        "s",     "p",     "l",    "mg",       "vp",       "cstype", "deg",    "bmat",       "step",
        "curv",  "curv2", "surf", "parm",     "trim",     "hole",   "scrv",   "sp",         "end",
        "con",   "bevel", "lod",  "c_interp", "d_interp", "maplib", "usemap", "shadow_obj", "trace_obj",
        "ctech", "stech", "call", "csh",      "bsp",      "bzp"};
    for (const std::string_view word : ignored) {
      if (keyword == word) return true;
    }
    return false;
  }

  static std::string_view trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
  }

  /// Reads `minimum` to `out.size()` numbers; missing ones keep their values, the rest of the line is ignored.
  Status read_numbers(std::string_view& rest, std::string_view what, std::size_t minimum, std::span<float> out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
      const std::string_view token = next_token(rest);
      if (token.empty() || token.front() == '#') {
        if (i >= minimum) return Unit{};
        return error(ErrorCode::truncated, std::string(what) + " has " + std::to_string(i) + " numbers, but needs " +
                                               std::to_string(minimum));
      }
      switch (parse_number(token, out[i])) {
        case NumberFault::none:
          break;
        case NumberFault::not_a_number:
          return error(ErrorCode::malformed, std::string(what) + " has " + shown(token) + " in place of a number");
        case NumberFault::not_finite:
          return error(ErrorCode::not_finite,
                       std::string(what) + " has " + shown(token) + ", which is not a finite number");
      }
    }
    return Unit{};
  }

  /// x y z, then optionally w (of rational curves), which is ignored, or a colour with or without an opacity.
  Status read_position(std::string_view rest) {
    std::array<float, 3> p{};
    if (Status status = read_numbers(rest, "v", 3, p); !status) return status;
    if (builder_.model.positions.size() >= limits_.max_vertices) return too_many("vertices", limits_.max_vertices);
    builder_.model.positions.emplace_back(p[0], p[1], p[2]);
    read_color(rest);
    return Unit{};
  }

  /// The numbers after the position that was read last.
  void read_color(std::string_view rest) {
    glm::vec3 color = no_color;
    std::size_t count = 0;
    for (auto token = next_token(rest); !token.empty() && token.front() != '#'; token = next_token(rest), ++count) {
      float number = 0.0F;
      if (count < 3 && parse_number(token, number) == NumberFault::none) color[static_cast<int>(count)] = number;
    }
    if (count < 3) return;
    colors_.resize(builder_.model.positions.size(), no_color);
    colors_.back() = color;
    faulty_colors_ += is_color(color) ? 0 : 1;
  }

  Status read_uv(std::string_view rest) {
    std::array<float, 2> uv{};
    if (Status status = read_numbers(rest, "vt", 1, uv); !status) return status;
    if (builder_.model.uvs.size() >= limits_.max_vertices) return too_many("texture coordinates", limits_.max_vertices);
    builder_.model.uvs.emplace_back(uv[0], 1.0F - uv[1]);  // v of OBJ has its origin at the bottom
    return Unit{};
  }

  /// One that is no number, which exporters write for a triangle without area, is none, like one without length.
  Status read_normal(std::string_view rest) {
    std::array<float, 3> n{};
    if (Status status = read_numbers(rest, "vn", 3, n); !status) {
      if (status.error().code != ErrorCode::not_finite) return status;
      n = {};
    }
    if (builder_.model.normals.size() >= limits_.max_vertices) return too_many("normals", limits_.max_vertices);
    builder_.model.normals.emplace_back(n[0], n[1], n[2]);
    return Unit{};
  }

  [[nodiscard]] Error too_many(std::string_view what, std::size_t limit) const {
    return error(ErrorCode::too_large, "more than " + std::to_string(limit) + " " + std::string(what));
  }

  Status read_face(std::string_view rest) {
    const std::size_t first = corners_.size();
    for (std::string_view token = next_token(rest); !token.empty() && token.front() != '#'; token = next_token(rest)) {
      Corner corner;
      if (Status status = read_corner(token, corner); !status) return status;
      corners_.push_back(corner);
    }
    const std::size_t count = corners_.size() - first;
    if (count < 3) {
      corners_.resize(first);
      ++short_faces_;
      return Unit{};
    }
    if (count - 2 > limits_.max_triangles - triangles_) return too_many("triangles", limits_.max_triangles);
    triangles_ += count - 2;
    polygons_.push_back(static_cast<std::uint32_t>(first));
    return Unit{};
  }

  /// "v", "v/vt", "v//vn" or "v/vt/vn".
  Status read_corner(std::string_view token, Corner& corner) {
    const std::string_view whole = token;
    const auto take = [&token] {
      const std::size_t slash = token.find('/');
      const std::string_view part = token.substr(0, slash);
      token = slash == std::string_view::npos ? std::string_view{} : token.substr(slash + 1);
      return part;
    };
    const std::string_view v = take();
    const std::string_view vt = take();
    const std::string_view vn = token;
    const Model& model = builder_.model;
    if (Status s = read_index(v, whole, "vertex", model.positions.size(), forward_v_, corner.vertex); !s) return s;
    if (!vt.empty()) {
      if (Status s = read_index(vt, whole, "texture coordinate", model.uvs.size(), forward_vt_, corner.uv); !s)
        return s;
    }
    if (!vn.empty()) return read_index(vn, whole, "normal", model.normals.size(), forward_vn_, corner.normal);
    return Unit{};
  }

  /// Counted from 1, or negative: backwards from the last one read.
  Status read_index(std::string_view text, std::string_view corner, std::string_view what, std::size_t count,
                    std::vector<ForwardReference>& forward, std::uint32_t& out) {
    std::int64_t number = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (text.empty() || fault == std::errc::invalid_argument || end != text.data() + text.size()) {
      return error(ErrorCode::malformed,
                   "f has " + shown(corner) + " in place of a corner (v, v/vt, v//vn or v/vt/vn)");
    }
    const auto available = static_cast<std::int64_t>(count);
    if (fault != std::errc{} || number == 0 || number < -available ||
        number > static_cast<std::int64_t>(limits_.max_vertices)) {
      return error(ErrorCode::out_of_range, "f refers to " + std::string(what) + " " + std::string(text.substr(0, 24)) +
                                                ", but there are " + std::to_string(count));
    }
    out = static_cast<std::uint32_t>(number > 0 ? number - 1 : available + number);
    if (out >= count && (forward.empty() || out > forward.back().index)) forward.push_back({out, lines_.line()});
    return Unit{};
  }

  [[nodiscard]] Status check_forward_references() const {
    const Model& model = builder_.model;
    if (Status s = check_forward(forward_v_, "vertex", model.positions.size()); !s) return s;
    if (Status s = check_forward(forward_vt_, "texture coordinate", model.uvs.size()); !s) return s;
    return check_forward(forward_vn_, "normal", model.normals.size());
  }

  static Status check_forward(const std::vector<ForwardReference>& forward, std::string_view what, std::size_t count) {
    for (const auto& [index, line] : forward) {
      if (index >= count) {
        return Error{ErrorCode::out_of_range, "line " + std::to_string(line),
                     "f refers to " + std::string(what) + " " + std::to_string(std::uint64_t{index} + 1) +
                         ", but there are " + std::to_string(count)};
      }
    }
    return Unit{};
  }

  /// One file, whose name may have blanks, or several that each end in ".mtl".
  void use_libraries(std::string_view names) {
    const auto is_one = [](std::string_view name) { return lower_case(name).ends_with(".mtl"); };
    bool are_several = true;
    for (std::string_view rest = names; are_several && !trimmed(rest).empty();) are_several = is_one(next_token(rest));
    if (!are_several) return use_library(names);
    for (std::string_view rest = names; !trimmed(rest).empty();) use_library(next_token(rest));
  }

  /// Reads a material file, if resources are available.
  void use_library(std::string_view name) {
    constexpr int max_libraries = 16;
    if (libraries_++ >= max_libraries) return;
    if (library_) {
      library_->read_library(name);
    } else if (libraries_ == 1) {
      builder_.warn(
          "the material file " + shown(name) +
          " was not read, so materials have default colours; send a zip of the OBJ file, its material file and images");
    }
  }

  Status use_material(std::string_view name) {
    const auto [entry, is_new] =
        material_by_name_.try_emplace(std::string(name), static_cast<int>(builder_.model.materials.size()));
    if (is_new) {
      if (builder_.model.materials.size() >= max_materials) return too_many("materials", max_materials);
      Material material;
      material.name = std::string(name);
      builder_.model.materials.push_back(std::move(material));
    }
    material_ = entry->second;
    start_section();
    return Unit{};
  }

  void start_section() {
    if (!sections_.empty() && sections_.back().first_polygon == polygons_.size()) sections_.pop_back();
    sections_.push_back({polygons_.size(), name_, material_});
  }

  void add_colors() {
    if (colors_.empty()) return;
    append_colors(colors_, full_light(colors_, ColorNumbers::reals), ColorSpace::srgb, builder_.model.colors);
    builder_.model.colors.resize(builder_.model.positions.size(), white);
    colors_.resize(builder_.model.positions.size(), no_color);
    if (faulty_colors_ > 0) builder_.warn(warning_of_faulty_colors(faulty_colors_));
  }

  /// Whether the polygons from `first` to before `end` show colours of vertices. They do not if their material has an
  /// image: programs write its colours to the vertices too, and the product would be too dark.
  [[nodiscard]] bool are_colored(std::size_t first, std::size_t end, int material) const {
    if (colors_.empty() || first == end) return false;
    if (material >= 0 && builder_.model.materials[static_cast<std::size_t>(material)].base_color_image >= 0)
      return false;
    const std::size_t last = end < polygons_.size() ? polygons_[end] : corners_.size();
    const auto corners = std::span(corners_).subspan(polygons_[first], last - polygons_[first]);
    return std::any_of(corners.begin(), corners.end(), [&](const Corner& c) { return is_color(colors_[c.vertex]); });
  }

  /// A material without its colour: the vertices have it instead. Material files have a grey beside such vertices.
  int without_color(int material) {
    if (material < 0) return material;
    Material copy = builder_.model.materials[static_cast<std::size_t>(material)];
    const glm::vec4 uncolored(1.0F, 1.0F, 1.0F, copy.base_color.a);
    if (copy.base_color == uncolored) return material;
    const auto [entry, is_new] =
        without_color_.try_emplace(material, static_cast<int>(builder_.model.materials.size()));
    if (!is_new) return entry->second;
    copy.base_color = uncolored;
    builder_.model.materials.push_back(std::move(copy));
    return entry->second;
  }

  void begin_section(std::size_t section) {
    const Section& s = sections_[section];
    const std::size_t end = section + 1 < sections_.size() ? sections_[section + 1].first_polygon : polygons_.size();
    const bool are_these_colored = are_colored(s.first_polygon, end, s.material);
    builder_.begin_primitive(s.name, are_these_colored ? without_color(s.material) : s.material, are_these_colored);
  }

  void add_triangles() {
    const std::size_t before = sections_.empty() ? polygons_.size() : sections_.front().first_polygon;
    builder_.begin_primitive("", -1, are_colored(0, before, -1));
    Triangulator triangulator;
    std::vector<glm::vec3> positions;
    std::size_t section = 0;
    for (std::size_t i = 0; i < polygons_.size(); ++i) {
      for (; section < sections_.size() && sections_[section].first_polygon <= i; ++section) {
        begin_section(section);
      }
      const std::size_t end = i + 1 < polygons_.size() ? polygons_[i + 1] : corners_.size();
      const std::span<const Corner> corners = std::span(corners_).subspan(polygons_[i], end - polygons_[i]);
      positions.clear();
      for (const Corner& corner : corners) positions.push_back(builder_.model.positions[corner.vertex]);
      for (const auto& [a, b, c] : triangulator.split(positions)) {
        builder_.add_triangle(corners[a], corners[b], corners[c]);
      }
    }
  }

  ModelBuilder builder_;
  const ImportLimits& limits_;
  LineReader lines_;
  std::vector<Corner> corners_;
  std::vector<std::uint32_t> polygons_;  ///< first corner of each
  std::size_t triangles_ = 0;
  std::vector<Section> sections_;
  std::string name_;
  int material_ = -1;
  std::map<std::string, int, std::less<>> material_by_name_;
  std::vector<ForwardReference> forward_v_, forward_vt_, forward_vn_;
  std::size_t short_faces_ = 0;
  std::size_t unknown_lines_ = 0;
  std::string first_unknown_;
  std::optional<ObjMaterials> library_;
  int libraries_ = 0;
  GivenColors colors_;  ///< of the first vertices: empty, or up to the last that has one
  std::size_t faulty_colors_ = 0;
  std::map<int, int> without_color_;  ///< the number of each material's copy
};

}  // namespace

Result<Model> read_obj(std::span<const std::uint8_t> bytes, const ImportLimits& limits,
                       const ResourceReader& resources) {
  return ObjReader(bytes, limits, resources).read();
}

}  // namespace semblante::import
