// SPDX-License-Identifier: MIT
// A picture in linear light, and its PNG file.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#ifndef MOREAU_WITHOUT_PNG
#include <png.h>
#endif

#include "moreau/core/error.hpp"
#include "moreau/io/output_file.hpp"

namespace moreau::rendering {

using Color = Eigen::Vector3f;  ///< red, green, blue in linear light, 0..1

/// The colour in linear light of a screen colour 0xRRGGBB.
inline Color screen_color(unsigned rgb) {
  const auto linear = [](unsigned byte) {
    return std::pow(static_cast<float>(byte & 255u) / 255.0f, 2.2f);
  };
  return {linear(rgb >> 16), linear(rgb >> 8), linear(rgb)};
}

/// A grid of pixels.
class Image {
 public:
  /// All pixels have the colour of the background.
  /// @throws std::invalid_argument for a width or height that is not positive
  Image(int width, int height, const Color& background) : width_(width), height_(height) {
    require(width > 0, "Image", "width", width, "must be > 0");
    require(height > 0, "Image", "height", height, "must be > 0");
    pixels_.assign(std::size_t(width) * std::size_t(height), background);
  }
  int width() const { return width_; }    ///< number of columns
  int height() const { return height_; }  ///< number of rows
  /// The pixel in a column, from the left, and a row, from the top.
  Color& operator()(int column, int row) { return pixels_[index(column, row)]; }
  /// The same.
  const Color& operator()(int column, int row) const { return pixels_[index(column, row)]; }

  /// The picture reduced by a factor: means over squares of factor x factor pixels.
  Image reduced(int factor) const {
    Image small(width_ / factor, height_ / factor, Color::Zero());
    const float share = 1.0f / static_cast<float>(factor * factor);
    for (int row = 0; row < small.height_ * factor; ++row)
      for (int column = 0; column < small.width_ * factor; ++column)
        small(column / factor, row / factor) += share * (*this)(column, row);
    return small;
  }

 private:
  std::size_t index(int column, int row) const {
    return std::size_t(row) * std::size_t(width_) + std::size_t(column);
  }
  int width_, height_;
  std::vector<Color> pixels_;
};

#ifndef MOREAU_WITHOUT_PNG
/// Red, green and blue of every pixel in rows from the top, 8 bits each, encoded with gamma 2.2.
inline std::vector<std::uint8_t> screen_bytes(const Image& image) {
  const auto to_byte = [](float light) {
    return static_cast<std::uint8_t>(
        std::lround(255 * std::pow(std::clamp(light, 0.0f, 1.0f), 1 / 2.2f)));
  };
  std::vector<std::uint8_t> bytes;
  bytes.reserve(3 * std::size_t(image.width()) * std::size_t(image.height()));
  for (int row = 0; row < image.height(); ++row)
    for (int column = 0; column < image.width(); ++column)
      for (const float light : image(column, row)) bytes.push_back(to_byte(light));
  return bytes;
}
#endif

/// Writes the picture as a PNG file, whole or not at all. If the macro MOREAU_WITHOUT_PNG is defined
/// in all files of a program, the program needs no libpng; the function then writes no picture, and
/// says so on the standard output.
/// @throws std::runtime_error or std::system_error naming the path
inline void write_png(const std::filesystem::path& path, const Image& image) {
#ifndef MOREAU_WITHOUT_PNG
  png_image head{};
  head.version = PNG_IMAGE_VERSION;
  head.width = static_cast<png_uint_32>(image.width());
  head.height = static_cast<png_uint_32>(image.height());
  head.format = PNG_FORMAT_RGB;
  const std::vector<std::uint8_t> pixels = screen_bytes(image);
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(head);
  std::string file(size, '\0');
  if (png_image_write_to_memory(&head, file.data(), &size, 0, pixels.data(), 0, nullptr) == 0)
    throw std::runtime_error("cannot write " + path.string() + ": " + head.message);
  write_atomically(path, std::string_view(file.data(), size));
#else
  static_cast<void>(image);
  std::printf("%s is left out: this program was built without libpng\n", path.c_str());
#endif
}

}  // namespace moreau::rendering
