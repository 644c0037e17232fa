// SPDX-License-Identifier: MIT
// Reads ParaView files for tests.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <doctest/doctest.h>
#include <filesystem>
#include <string>
#include <vector>

#include "moreau/io/vtk_poly_data.hpp"

#include "io/temporary_folder.hpp"

/// Reads the files of VtkPolyData. It understands only the subset of XML that these files use.
class Vtp {
 public:
  explicit Vtp(const std::filesystem::path& path) : text_(read(path)) {
    const std::string marker = "<AppendedData encoding=\"raw\">\n_";
    const auto start = text_.find(marker);
    REQUIRE(start != std::string::npos);
    bytes_ = start + marker.size();
    end_ = text_.rfind("\n</AppendedData>\n</VTKFile>\n");
    REQUIRE(end_ != std::string::npos);
    CHECK(text_.find("header_type=\"UInt64\"") < start);
    CHECK(text_.find("byte_order=\"LittleEndian\"") < start);
  }
  std::size_t count(const std::string& what) const {
    return std::stoul(attribute(text_.find("<Piece"), "NumberOf" + what));
  }
  /// The array with the given name in a section, for example in "CellData".
  template <class T>
  std::vector<T> array(const std::string& section, const std::string& name) const {
    const auto begin = text_.find("<" + section + ">");
    const auto at = text_.find("Name=\"" + name + "\"", begin);
    REQUIRE(at < text_.find("</" + section + ">", begin));
    const auto tag = text_.rfind("<DataArray", at);
    CHECK(attribute(tag, "type") == moreau::vtk_type_name<T>());
    CHECK(attribute(tag, "format") == "appended");
    const std::size_t offset = bytes_ + std::stoul(attribute(tag, "offset"));
    std::uint64_t size = 0;
    std::memcpy(&size, text_.data() + offset, sizeof size);
    REQUIRE(offset + sizeof size + size <= end_);
    std::vector<T> values(size / sizeof(T));
    std::memcpy(values.data(), text_.data() + offset + sizeof size, size);
    return values;
  }

 private:
  std::string attribute(std::size_t from, const std::string& name) const {
    const auto at = text_.find(name + "=\"", from) + name.size() + 2;
    return text_.substr(at, text_.find('"', at) - at);
  }
  std::string text_;
  std::size_t bytes_ = 0, end_ = 0;
};
