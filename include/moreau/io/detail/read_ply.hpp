// SPDX-License-Identifier: MIT
// PLY (Stanford polygon format), as a text or binary: the coordinates of its vertices and the corners
// of its faces. Other properties and elements are read over.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "moreau/io/detail/mesh_file.hpp"

namespace moreau::detail {

/// Reads a PLY file.
class PlyReader {
 public:
  /// @throws std::runtime_error naming the line, vertex or face of the first error
  static MeshFile read(std::string_view bytes) {
    PlyReader reader(bytes);
    for (const Element& element : reader.elements_) reader.read_element(element);
    reader.require_end();
    return std::move(reader.file_);
  }

 private:
  enum class Type { none, i8, u8, i16, u16, i32, u32, f32, f64 };
  struct Property {
    Type count = Type::none;  ///< of a list: the type of its length
    Type type = Type::none;
    std::string name;
  };
  struct Element {
    std::string name;
    std::size_t count = 0;
    std::vector<Property> properties;
  };

  explicit PlyReader(std::string_view bytes) : bytes_(bytes) {
    // The header is text, what follows it may be binary.
    const std::string_view mark = "end_header";
    const std::size_t end = bytes.find(mark);
    if (!bytes.starts_with("ply"))
      MeshWords(bytes.substr(0, 64)),
          throw std::runtime_error("no PLY file: it must begin with 'ply'");
    if (end == std::string_view::npos)
      throw std::runtime_error("the file ends before 'end_header'");
    MeshWords header(bytes.substr(0, end));
    read_header(header);
    at_ = bytes.find('\n', end);
    at_ = at_ == std::string_view::npos ? bytes.size() : at_ + 1;
    if (is_text_) words_.emplace(bytes.substr(at_));
  }

  void read_header(MeshWords& header) {
    header.next();
    for (std::string_view word = header.next(); !word.empty(); word = header.next()) {
      if (word == "format") {
        const std::string_view format = header.next();
        is_text_ = format == "ascii";
        is_big_ = format == "binary_big_endian";
        if (!is_text_ && !is_big_ && format != "binary_little_endian")
          header.fail("format '" + shown(format) + "' must be ascii or binary");
      } else if (word == "element") {
        Element& element = elements_.emplace_back();
        element.name = header.next();
        double count = 0;
        const std::string_view number = header.next();
        if (!parse_number(number, count) || !(count >= 0 && count < 4294967295.))
          header.fail("'" + shown(number) + "' must be the number of elements");
        element.count = static_cast<std::size_t>(count);
        if (element.count > bytes_.size())
          header.fail("the file is too short for " + shown(number) + " elements");
      } else if (word == "property") {
        if (elements_.empty()) header.fail("a property must belong to an element");
        elements_.back().properties.push_back(property_of(header));
      } else if (word != "comment" && word != "obj_info") {
        header.fail("'" + shown(word) + "' is no keyword of a PLY file");
      }
      header.rest_of_line();
    }
    for (const Element& element : elements_)
      for (const char* axis : {"x", "y", "z"})
        if (element.name == "vertex") require_coordinate(element, axis);
  }
  /// A vertex with "X" in place of "x" would lie at x = 0.
  static void require_coordinate(const Element& element, const std::string& axis) {
    const auto& all = element.properties;
    const auto is_it = [&](const Property& one) { return one.name == axis; };
    const auto at = std::find_if(all.begin(), all.end(), is_it);
    if (at == all.end() || at->count != Type::none || std::count_if(at, all.end(), is_it) > 1)
      throw std::runtime_error("element vertex must have one property " + axis + ", a number");
  }
  static Property property_of(MeshWords& header) {
    Property property;
    std::string_view word = header.next_of_line();
    if (word == "list") {
      property.count = type_of(header, header.next_of_line());
      word = header.next_of_line();
    }
    property.type = type_of(header, word);
    property.name = header.next_of_line();
    return property;
  }
  static Type type_of(const MeshWords& header, std::string_view word) {
    constexpr struct {
      const char *name, *other;
      Type type;
    } types[] = {{"char", "int8", Type::i8},      {"uchar", "uint8", Type::u8},
                 {"short", "int16", Type::i16},   {"ushort", "uint16", Type::u16},
                 {"int", "int32", Type::i32},     {"uint", "uint32", Type::u32},
                 {"float", "float32", Type::f32}, {"double", "float64", Type::f64}};
    for (const auto& one : types)
      if (word == one.name || word == one.other) return one.type;
    header.fail("'" + shown(word) + "' is no type of a PLY file");
  }

  [[noreturn]] void fail(const Element& element, std::size_t i, const std::string& what) const {
    throw std::runtime_error(element.name + " " + std::to_string(i) + ": " + what);
  }
  /// @param is_coordinate whether its digits count
  double take(Type type, const Element& element, std::size_t i, bool is_coordinate = false) {
    if (is_text_) {
      const std::string_view word = words_->next();
      if (word.empty()) fail(element, i, "the file ends before it is complete");
      double value = 0;
      if (!parse_number(word, value)) words_->fail("'" + shown(word) + "' must be a number");
      if ((type == Type::f32 || type == Type::f64) && is_coordinate && std::isfinite(value))
        words_->number(word, file_.digits);
      return value;
    }
    file_.is_binary = true;
    constexpr std::size_t sizes[] = {0, 1, 1, 2, 2, 4, 4, 4, 8};
    const std::size_t size = sizes[static_cast<int>(type)];
    if (bytes_.size() - at_ < size) fail(element, i, "the file ends before it is complete");
    const std::size_t begin = at_;
    at_ += size;
    switch (type) {
      case Type::i8:
        return static_cast<std::int8_t>(unsigned_at<std::uint8_t>(bytes_, begin));
      case Type::u8:
        return unsigned_at<std::uint8_t>(bytes_, begin);
      case Type::i16:
        return static_cast<std::int16_t>(unsigned_at<std::uint16_t>(bytes_, begin, is_big_));
      case Type::u16:
        return unsigned_at<std::uint16_t>(bytes_, begin, is_big_);
      case Type::i32:
        return static_cast<std::int32_t>(unsigned_at<std::uint32_t>(bytes_, begin, is_big_));
      case Type::u32:
        return unsigned_at<std::uint32_t>(bytes_, begin, is_big_);
      case Type::f32:
        if (is_coordinate) file_.digits = std::max(file_.digits, 7);
        return double(std::bit_cast<float>(unsigned_at<std::uint32_t>(bytes_, begin, is_big_)));
      default:
        if (is_coordinate) file_.digits = 16;
        return std::bit_cast<double>(unsigned_at<std::uint64_t>(bytes_, begin, is_big_));
    }
  }

  /// Throws if the file goes on after the triangles that the header counts.
  void require_end() {
    const std::string_view left = is_text_ ? words_->rest() : bytes_.substr(at_);
    if (left.find_first_not_of(" \t\r\n\f\v") != std::string_view::npos)
      throw std::runtime_error("the file has more elements than its header says");
  }

  void read_element(const Element& element) {
    if (element.name == "tristrips")
      throw std::runtime_error("the file holds strips of triangles: save it with faces");
    std::vector<double> values;
    for (std::size_t i = 0; i < element.count; ++i) {
      Eigen::Vector3d x = Eigen::Vector3d::Zero();
      for (const Property& property : element.properties) {
        values.clear();
        double count = 1;
        if (property.count != Type::none) {
          count = take(property.count, element, i);
          if (!(count >= 0 && count <= double(bytes_.size())))
            fail(element, i, "its list has a wrong length");
        }
        const bool is_coordinate =
            element.name == "vertex" && property.name.size() == 1 &&
            std::string_view("xyz").find(property.name[0]) != std::string_view::npos;
        for (double k = 0; k < count; ++k)
          values.push_back(take(property.type, element, i, is_coordinate));
        if (element.name == "face" && property.count != Type::none &&
            (property.name == "vertex_indices" || property.name == "vertex_index"))
          add_face(element, i, values);
        for (int axis = 0; axis < 3; ++axis)
          if (property.name.size() == 1 && property.name[0] == "xyz"[axis] && values.size() == 1)
            x[axis] = values[0];
      }
      if (element.name != "vertex") continue;
      if (!x.allFinite()) fail(element, i, "coordinates must be finite");
      file_.vertices.push_back(x);
    }
  }
  void add_face(const Element& element, std::size_t i, const std::vector<double>& values) {
    if (values.size() < 3)
      fail(element, i,
           "has " + std::to_string(values.size()) + " corners: points and lines bound no solid");
    corners_.clear();
    for (const double v : values) {
      if (!(v >= 0 && v < double(file_.vertices.size())) || v != std::floor(v))
        fail(element, i,
             "a corner must be one of the " + std::to_string(file_.vertices.size()) +
                 " vertices before it, counted from 0");
      corners_.push_back(static_cast<std::uint32_t>(v));
    }
    file_.add_polygon(corners_);
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
  bool is_text_ = true, is_big_ = false;
  std::vector<Element> elements_;
  std::vector<std::uint32_t> corners_;
  std::optional<MeshWords> words_;
  MeshFile file_;
};

}  // namespace moreau::detail
