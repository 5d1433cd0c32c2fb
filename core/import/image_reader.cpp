#include "core/import/image_reader.h"

#include <cassert>
#include <string>
#include <utility>

#include "core/import/image_size.h"
#include "core/import/image_type.h"
#include "core/import/webp.h"

namespace semblante::import {
namespace {

std::string in_words(const ImageSize& size) { return std::to_string(size.width) + " x " + std::to_string(size.height); }

}  // namespace

Result<Image> ImageReader::read(std::vector<std::uint8_t> bytes) {
  if (bytes.size() > limits_.max_image_bytes) {
    return Error{ErrorCode::too_large, "", "has more than " + std::to_string(limits_.max_image_bytes) + " bytes"};
  }
  const std::string_view type = image_type(bytes);
  if (type == "image/png" || type == "image/jpeg") {
    const auto size = declared_size(bytes);
    if (!size || size->width == 0 || size->height == 0) {
      return Error{ErrorCode::malformed, "",
                   "is a " + std::string(type == "image/png" ? "PNG" : "JPEG") +
                       (size ? " of " + in_words(*size) + " pixels" : " without a whole header") +
                       ", of which nothing can be shown"};
    }
    if (size->width > limits_.max_image_side || size->height > limits_.max_image_side) {
      return Error{ErrorCode::too_large, "",
                   "is an image of " + in_words(*size) + " pixels, more than " +
                       std::to_string(limits_.max_image_side) + " along a side"};
    }
    return Image{std::string(type), std::move(bytes)};
  }
  if (type == "image/ktx2") {
    return Error{ErrorCode::unsupported, "",
                 "is a KTX2 texture (Basis Universal), which cannot be read here; PNG, JPEG and WebP can"};
  }
  if (type != "image/webp") return Error{ErrorCode::unsupported, "", "is neither PNG nor JPEG nor WebP"};
  const auto size = webp_size(bytes);
  if (!size) return size.error();
  if (Status admitted = admit(*size, "WebP"); !admitted) return admitted.error();
  return converted_webp(bytes);
}

Result<Pixels> ImageReader::decode(const Image& image) {
  const auto size = declared_size(image.bytes);
  assert(size && "read() gives no other images");
  const std::string_view format = image.mime_type == "image/png" ? "PNG" : "JPEG";
  if (Status admitted = admit(*size, format); !admitted) return admitted.error();
  return decode_image(image.bytes, *size);
}

Status ImageReader::admit(const ImageSize& size, std::string_view format) {
  if (size.pixels() > limits_.max_image_pixels || size.pixels() > pixels_left_) {
    const bool of_file = size.pixels() <= limits_.max_image_pixels;
    return Error{ErrorCode::too_large, "",
                 "is a " + std::string(format) + " of " + in_words(size) +
                     (of_file ? ", with which all together have more than " : ", more than ") +
                     std::to_string(of_file ? limits_.max_decoded_pixels : limits_.max_image_pixels) + " pixels"};
  }
  pixels_left_ -= size.pixels();
  return Unit{};
}

}  // namespace semblante::import
