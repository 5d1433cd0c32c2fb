#include "core/import/foreign_file.h"

#include <algorithm>
#include <array>

#include "core/import/model_formats.h"
#include "core/import/text.h"
#include "core/types/letter_case.h"

namespace semblante::import {
namespace {

enum class Kind : std::uint8_t { scene, archive, picture };

/// A format without a reader. Its files begin with `magic`, if it has one; in a zip they are known by `ending`.
struct ForeignFormat {
  std::string_view title;
  Kind kind;
  std::string_view ending;
  std::string_view magic;
};

constexpr auto foreign_formats = std::to_array<ForeignFormat>({
    {"FBX", Kind::scene, ".fbx", "Kaydara FBX Binary"},
    {"FBX", Kind::scene, ".fbx", "; FBX "},
    {"USD", Kind::scene, ".usda", "#usda "},
    {"USD", Kind::scene, ".usdc", "PXR-USDC"},
    {"USD", Kind::scene, ".usd", ""},
    {"USD", Kind::scene, ".usdz", ""},
    {"Blender", Kind::scene, ".blend", "BLENDER"},
    {"Maya", Kind::scene, ".ma", "//Maya ASCII"},
    {"Maya", Kind::scene, ".mb", ""},
    {"3ds Max", Kind::scene, ".max", ""},
    {"Cinema 4D", Kind::scene, ".c4d", "QC4DC4D6"},
    {"ZBrush", Kind::scene, ".ztl", ""},
    {"COLLADA", Kind::scene, ".dae", ""},
    {"X3D", Kind::scene, ".x3d", ""},
    {"VRML", Kind::scene, ".wrl", "#VRML "},
    {"3DS", Kind::scene, ".3ds", ""},
    {"3MF", Kind::scene, ".3mf", ""},
    {"3MF", Kind::scene, ".model", ""},
    {"OFF", Kind::scene, ".off", "OFF\n"},
    {"OFF", Kind::scene, ".off", "OFF\r\n"},
    {"Alembic", Kind::scene, ".abc", "Ogawa\xFF"},
    {"STEP", Kind::scene, ".stp", "ISO-10303-21;"},
    {"STEP", Kind::scene, ".step", ""},
    {"RAR", Kind::archive, ".rar", "Rar!\x1A\x07"},
    {"7-Zip", Kind::archive, ".7z", "7z\xBC\xAF\x27\x1C"},
    {"gzip", Kind::archive, ".gz", "\x1F\x8B\x08"},
    {"Zstandard", Kind::archive, ".zst", "\x28\xB5\x2F\xFD"},
    {"ZIP", Kind::archive, ".zip", ""},
    {"PNG", Kind::picture, "", "\x89PNG"},
    {"JPEG", Kind::picture, "", "\xFF\xD8\xFF"},
});

Advice advice_for(Kind kind) {
  switch (kind) {
    case Kind::scene:
      return Advice::export_as_glb;
    case Kind::archive:
      return Advice::unpack;
    case Kind::picture:
      break;
  }
  return Advice::choose_model;
}

std::string sentence_of(Kind kind, std::string_view title) {
  const std::string name(title);
  switch (kind) {
    case Kind::scene:
      return "the format of the file is " + name + ", none of " + model_file_titles();
    case Kind::archive:
      return "the file is packed (" + name + ")";
    case Kind::picture:
      break;
  }
  return "the file is a picture (" + name + "), not a model";
}

ForeignFile foreign(Kind kind, std::string_view title) { return {sentence_of(kind, title), advice_for(kind)}; }

/// A 3DS file begins with the letters MM and its own size. The letters alone may begin any file.
bool is_3ds(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < 6 || bytes[0] != 'M' || bytes[1] != 'M') return false;
  std::uint64_t size = 0;
  for (std::size_t i = 6; i-- > 2;) size = size << 8 | bytes[i];
  return size == bytes.size();
}

}  // namespace

std::optional<ForeignFile> foreign_file(std::span<const std::uint8_t> bytes) {
  std::string_view text = as_text(bytes);
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  for (const ForeignFormat& format : foreign_formats) {
    if (!format.magic.empty() && text.starts_with(format.magic)) return foreign(format.kind, format.title);
  }
  if (is_3ds(bytes)) return foreign(Kind::scene, "3DS");
  if (text.starts_with("version https://git-lfs")) {
    return ForeignFile{"the file is a pointer of Git LFS in place of the model", Advice::fetch_from_lfs};
  }
  const std::size_t begin = std::min(text.find_first_not_of(" \t\r\n"), text.size());
  const std::string head = lower_case(text.substr(begin, 4096));
  if (head.starts_with("<!doctype html") || head.starts_with("<html")) {
    return ForeignFile{"the file is a web page, not a model", Advice::download_model};
  }
  if (!head.starts_with('<')) return std::nullopt;
  if (head.find("<collada") != std::string::npos) return foreign(Kind::scene, "COLLADA");
  if (head.find("<x3d") != std::string::npos) return foreign(Kind::scene, "X3D");
  return std::nullopt;
}

std::optional<ForeignFile> foreign_zip(const std::vector<std::string>& names) {
  for (const ForeignFormat& format : foreign_formats) {
    if (format.ending.empty()) continue;
    for (const std::string& name : names) {
      if (!lower_case(name).ends_with(format.ending)) continue;
      return ForeignFile{"the zip has no model but " + shown(name), advice_for(format.kind)};
    }
  }
  return std::nullopt;
}

}  // namespace semblante::import
