// SPDX-License-Identifier: MIT
// A picture in linear light, and the PNG file it is saved as.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/io/output_file.hpp"

namespace rendering {

using Color = Eigen::Vector3f;  ///< red, green, blue in linear light, 0..1

/// The linear light of a colour given as on a screen, 0xRRGGBB.
inline Color screen_color(unsigned rgb) {
  const auto linear = [](unsigned byte) {
    return std::pow(static_cast<float>(byte & 255u) / 255.0f, 2.2f);
  };
  return {linear(rgb >> 16), linear(rgb >> 8), linear(rgb)};
}

class Image {
 public:
  Image(int width, int height, const Color& background)
      : width_(width), height_(height), pixels_(std::size_t(width) * std::size_t(height)) {
    moreau::require(width > 0 && height > 0, "Image", "width", width, "and height must be > 0");
    std::fill(pixels_.begin(), pixels_.end(), background);
  }
  int width() const { return width_; }
  int height() const { return height_; }
  /// Column from the left, row from above.
  Color& operator()(int column, int row) { return pixels_[index(column, row)]; }
  const Color& operator()(int column, int row) const { return pixels_[index(column, row)]; }

  /// Mean over squares of factor x factor pixels.
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

/// Deflate (RFC 1951) with the fixed codes: repetitions found through the last place where the same
/// three bytes stood.
class Deflate {
 public:
  /// The zlib stream (RFC 1950) of some bytes.
  static std::string zlib(std::string_view data) {
    Deflate out;
    out.bytes_ = "\x78\x01";
    out.bits(1, 1);  // the last block,
    out.bits(1, 2);  // with fixed codes
    out.compress(data);
    out.literal(256);
    if (out.used_ > 0) out.bits(0, 8 - out.used_);
    std::uint32_t a = 1, b = 0;
    for (const char c : data) {
      a = (a + static_cast<unsigned char>(c)) % 65521;
      b = (b + a) % 65521;
    }
    for (int shift = 24; shift >= 0; shift -= 8)
      out.bytes_ += static_cast<char>((b << 16 | a) >> shift & 255u);
    return std::move(out.bytes_);
  }

 private:
  static constexpr std::size_t longest = 258, window = 32768, chain = 32;

  void compress(std::string_view data) {
    std::vector<std::int64_t> head(1u << 15, -1), before(data.size(), -1);
    const auto hash = [&](std::size_t i) {
      const auto byte = [&](std::size_t k) { return std::uint32_t(std::uint8_t(data[i + k])); };
      return ((byte(0) | byte(1) << 8 | byte(2) << 16) * 0x9E3779B1u) >> 17;
    };
    const auto remember = [&](std::size_t i) {
      if (i + 3 > data.size()) return;
      before[i] = head[hash(i)];
      head[hash(i)] = static_cast<std::int64_t>(i);
    };
    for (std::size_t i = 0; i < data.size();) {
      std::size_t length = 0, distance = 0, tries = 0;
      std::int64_t at = i + 3 <= data.size() ? head[hash(i)] : -1;
      for (; at >= 0 && i - std::size_t(at) <= window && tries < chain; ++tries) {
        const auto start = std::size_t(at);
        std::size_t same = 0;
        while (same < longest && i + same < data.size() && data[start + same] == data[i + same])
          ++same;
        if (same > length) {
          length = same;
          distance = i - start;
        }
        at = before[start];
      }
      if (length < 3) length = 1;
      if (length == 1)
        literal(std::uint8_t(data[i]));
      else
        repeat(length, distance);
      for (std::size_t k = 0; k < length; ++k) remember(i + k);
      i += length;
    }
  }

  /// Lowest bit first.
  void bits(std::uint32_t value, int count) {
    for (int k = 0; k < count; ++k) {
      current_ |= (value >> k & 1u) << used_;
      if (++used_ < 8) continue;
      bytes_ += static_cast<char>(current_);
      current_ = 0;
      used_ = 0;
    }
  }
  void code(std::uint32_t value, int count) {  // Huffman codes come highest bit first
    for (int k = count - 1; k >= 0; --k) bits(value >> k & 1u, 1);
  }
  void literal(std::uint32_t symbol) {
    if (symbol < 144)
      code(0x30 + symbol, 8);
    else if (symbol < 256)
      code(0x190 + symbol - 144, 9);
    else if (symbol < 280)
      code(symbol - 256, 7);
    else
      code(0xC0 + symbol - 280, 8);
  }
  void repeat(std::size_t length, std::size_t distance) {
    // Groups of symbols whose extra bits double in reach: four symbols per number of extra bits for
    // lengths, two for distances; 258 has a symbol of its own.
    if (length == longest) {
      literal(285);
    } else {
      const auto [symbol, extra, rest] = group(length - 3, 4);
      literal(257 + symbol);
      bits(rest, extra);
    }
    const auto [symbol, extra, rest] = group(distance - 1, 2);
    code(symbol, 5);
    bits(rest, extra);
  }
  struct Group {
    std::uint32_t symbol;
    int extra;
    std::uint32_t rest;
  };
  static Group group(std::size_t value, std::uint32_t per_extra) {
    std::uint32_t symbol = 0, start = 0;
    int extra = 0;
    while (value >= start + (1u << extra)) {
      start += 1u << extra;
      ++symbol;
      if (symbol >= 2 * per_extra && symbol % per_extra == 0) ++extra;
    }
    return {symbol, extra, static_cast<std::uint32_t>(value) - start};
  }

  std::string bytes_;
  std::uint32_t current_ = 0;
  int used_ = 0;
};

/// The bytes of a PNG file (W3C recommendation), 8 bits per channel; each row is stored as the
/// differences from the pixel to the left or from the row above, whichever are smaller.
inline std::string png(const Image& image) {
  const auto to_byte = [](float light) {
    return static_cast<std::uint8_t>(
        std::lround(255 * std::pow(std::clamp(light, 0.0f, 1.0f), 1 / 2.2f)));
  };
  const std::size_t stride = 3 * std::size_t(image.width());
  std::vector<std::uint8_t> above(stride, 0), row(stride);
  std::string raw;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x)
      for (int c = 0; c < 3; ++c) row[std::size_t(3 * x + c)] = to_byte(image(x, y)[c]);
    std::array<std::string, 2> filtered = {"\1", "\2"};
    std::array<int, 2> size = {0, 0};
    for (std::size_t i = 0; i < stride; ++i) {
      const std::array<int, 2> guess = {i < 3 ? 0 : row[i - 3], above[i]};
      for (std::size_t f = 0; f < 2; ++f) {
        const auto difference = static_cast<std::int8_t>(row[i] - guess[f]);
        filtered[f] += static_cast<char>(difference);
        size[f] += std::abs(int(difference));
      }
    }
    raw += filtered[size[0] <= size[1] ? 0 : 1];
    std::swap(above, row);
  }
  const auto number = [](std::uint32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 255u);
    return bytes;
  };
  const auto chunk = [&](const std::string& content) {
    std::uint32_t crc = 0xFFFFFFFFu;
    for (const char c : content) {
      crc ^= std::uint8_t(c);
      for (int k = 0; k < 8; ++k) crc = crc >> 1 ^ (0xEDB88320u & (0u - (crc & 1u)));
    }
    return number(static_cast<std::uint32_t>(content.size() - 4)) + content + number(~crc);
  };
  using namespace std::string_literals;
  return "\x89PNG\r\n\x1a\n"s +
         chunk("IHDR" + number(static_cast<std::uint32_t>(image.width())) +
               number(static_cast<std::uint32_t>(image.height())) + "\x08\x02\0\0\0"s) +
         chunk("IDAT" + Deflate::zlib(raw)) + chunk("IEND"s);
}

/// @throws std::system_error naming the path
inline void write_png(const std::filesystem::path& path, const Image& image) {
  moreau::write_atomically(path, png(image));
}

}  // namespace rendering
