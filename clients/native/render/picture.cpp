#include "clients/native/render/picture.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <fstream>

#include "core/gltf/encode_image.h"

namespace semblante::render {

Picture::Picture(int w, int h, Rgb fill) : width(w), height(h), rgb(static_cast<std::size_t>(w) * h * 3) {
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    rgb[i] = fill[i % 3];
  }
}

void Picture::paste(const Picture& other, int x, int y) {
  const int left = std::max(0, x);
  const int right = std::min(width, x + other.width);
  if (left >= right) {
    return;
  }
  for (int row = std::max(0, y); row < std::min(height, y + other.height); ++row) {
    const auto from = other.rgb.begin() + (static_cast<std::ptrdiff_t>(row - y) * other.width + (left - x)) * 3;
    std::copy_n(from, (right - left) * 3, rgb.begin() + (static_cast<std::ptrdiff_t>(row) * width + left) * 3);
  }
}

namespace {

Status write_bytes(const std::vector<std::uint8_t>& bytes, const std::filesystem::path& path) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (bytes.empty() || !file) {
    return Error{ErrorCode::io, path.string(), "could not write the picture"};
  }
  return Unit{};
}

}  // namespace

std::vector<std::uint8_t> encode_png(const Picture& picture) {
  return semblante::encode_png(picture.rgb, picture.width, picture.height, 3);
}

std::vector<std::uint8_t> encode_jpeg(const Picture& picture, int quality) {
  return semblante::encode_jpeg(picture.rgb, picture.width, picture.height, 3, quality);
}

Status write_png(const Picture& picture, const std::filesystem::path& path) {
  return write_bytes(encode_png(picture), path);
}

Status write_jpeg(const Picture& picture, const std::filesystem::path& path, int quality) {
  return write_bytes(encode_jpeg(picture, quality), path);
}

double mean_difference(const Picture& a, const Picture& b) {
  assert(a.rgb.size() == b.rgb.size());
  double sum = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) {
    sum += std::abs(int{a.rgb[i]} - int{b.rgb[i]});
  }
  return a.rgb.empty() ? 0 : sum / static_cast<double>(a.rgb.size());
}

}  // namespace semblante::render
