// SPDX-License-Identifier: MIT
// Writes points, lines and polygons in the XML format of VTK (.vtp) for ParaView. Source: "VTK file
// formats", XML, PolyData. The arrays follow the XML as raw appended data; each one begins with its
// number of bytes (header_type UInt64).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <locale>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/io/output_file.hpp"

namespace moreau {

/// The types that the numbers of an array can have.
template <class T>
concept VtkNumber = std::same_as<T, float> || std::same_as<T, double> ||
    std::same_as<T, std::int32_t> || std::same_as<T, std::uint32_t>;

/// Name of a number type in VTK's XML.
template <VtkNumber T>
constexpr std::string_view vtk_type_name() {
  if constexpr (std::same_as<T, float>) return "Float32";
  if constexpr (std::same_as<T, double>) return "Float64";
  if constexpr (std::same_as<T, std::int32_t>) return "Int32";
  if constexpr (std::same_as<T, std::uint32_t>) return "UInt32";
}

namespace detail {

/// Whether a text can be an XML attribute without escapes.
inline bool is_plain_xml(std::string_view text) {
  return std::none_of(text.begin(), text.end(), [](char c) {
    return static_cast<unsigned char>(c) < ' ' || c == '\x7f' || c == '"' || c == '<' || c == '&';
  });
}

}  // namespace detail

/// One data set. Its cells are vertices, lines and polygons; the file stores them in this order,
/// and cell arrays must have the same order. clear() keeps the memory for the next file.
class VtkPolyData {
 public:
  /// Kinds of cells, in the order of a file.
  enum class Cells : std::uint8_t { vertices, lines, polygons };
  /// Whether the values of an array belong to points or to cells.
  enum class On : std::uint8_t { points, cells };
  /// The largest number of points, and of corners of the cells of a kind: their indices have 32 bits.
  static constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();

  VtkPolyData() = default;
  /// @param fewer a lower limit than `most`
  explicit VtkPolyData(std::size_t fewer) : most_(std::min(fewer, most)) {}

  /// Removes all data and keeps the memory.
  void clear() {
    points_.clear();
    for (auto& kind : cells_) kind = {};
    arrays_.clear();
    appended_.clear();
  }

  /// Adds a point.
  /// @param x world axes [m]; a plane vector gets z = 0
  /// @returns the index of the point
  /// @throws std::invalid_argument if there are `most` points
  template <class Vector>
  std::int32_t add_point(const Vector& x) {
    require(point_count() < most_, "VtkPolyData::add_point", "points", point_count() + 1, too_many);
    for (int k = 0; k < 3; ++k) points_.push_back(k < x.size() ? static_cast<float>(x[k]) : 0.0f);
    return static_cast<std::int32_t>(point_count() - 1);
  }
  /// Adds a cell.
  /// @param points indices of its points, as add_point() returned them; not checked
  /// @throws std::invalid_argument if the cells of this kind would have more than `most` corners
  void add_cell(Cells kind, std::span<const std::int32_t> points) {
    CellList& cells = cells_[static_cast<std::size_t>(kind)];
    require(points.size() <= most_ - cells.points.size(), "VtkPolyData::add_cell", "corners",
            cells.points.size() + points.size(), too_many);
    cells.points.insert(cells.points.end(), points.begin(), points.end());
    cells.ends.push_back(static_cast<std::int32_t>(cells.points.size()));
  }

  std::size_t point_count() const { return points_.size() / 3; }  ///< number of points
  /// Number of cells of all kinds.
  std::size_t cell_count() const {
    std::size_t count = 0;
    for (const CellList& kind : cells_) count += kind.ends.size();
    return count;
  }

  /// Adds an array with values for all points or all cells so far.
  /// @param components values per point or cell; they are consecutive in `values`
  /// @param values     in any unit
  /// @throws std::invalid_argument if the number of values is not components times the number of
  ///         points or cells, or if the name is empty or contains a control character or one of
  ///         " < > &
  template <VtkNumber T>
  void add_array(On place, std::string_view name, std::size_t components,
                 std::span<const T> values) {
    require(!name.empty() && detail::is_plain_xml(name) && name.find('>') == name.npos,
            "VtkPolyData::add_array", "name", name, "must be a plain name");
    const std::size_t count = place == On::points ? point_count() : cell_count();
    require(values.size() == components * count, "VtkPolyData::add_array", name, values.size(),
            "values must be components times points or cells");
    arrays_.push_back({place, count, element(name, components, values)});
  }

  /// Writes the .vtp file, whole or not at all.
  /// @throws std::invalid_argument if points or cells were added after an array of them
  /// @throws std::system_error naming the path if the file cannot be written
  void write(const std::filesystem::path& path) {
    for (const Array& array : arrays_) {
      const std::size_t now = array.place == On::points ? point_count() : cell_count();
      require(array.count == now, "VtkPolyData::write", "values of an array", array.count,
              "must be those of all points or cells: add arrays last");
    }
    const std::size_t kept = appended_.size();
    std::string xml = header();
    xml += "<Points>\n" + element("Points", 3, std::span<const float>(points_)) + "</Points>\n";
    constexpr std::array names = {"Verts", "Lines", "Polys"};
    for (std::size_t kind = 0; kind < names.size(); ++kind) {
      const CellList& cells = cells_[kind];
      xml += std::string("<") + names[kind] + ">\n";
      xml += element("connectivity", 1, std::span<const std::int32_t>(cells.points));
      xml += element("offsets", 1, std::span<const std::int32_t>(cells.ends));
      xml += std::string("</") + names[kind] + ">\n";
    }
    xml += arrays("PointData", On::points) + arrays("CellData", On::cells);
    xml += "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
    xml += appended_;
    xml += "\n</AppendedData>\n</VTKFile>\n";
    appended_.resize(kept);
    write_atomically(path, xml);
  }

 private:
  static constexpr const char* too_many =
      "are more than a file can number: take a lower VtkOptions::fineness, or write several files";

  struct CellList {
    std::vector<std::int32_t> points, ends;
  };
  struct Array {
    On place;
    std::size_t count;  ///< of the points or cells
    std::string element;
  };

  std::string header() const {
    const auto count = [](std::string_view name, std::size_t n) {
      return " NumberOf" + std::string(name) + "=\"" + std::to_string(n) + '"';
    };
    const char* order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
    return "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"" +
           std::string(order) + "\" header_type=\"UInt64\">\n<PolyData>\n<Piece" +
           count("Points", point_count()) + count("Verts", cells_[0].ends.size()) +
           count("Lines", cells_[1].ends.size()) + count("Strips", 0) +
           count("Polys", cells_[2].ends.size()) + ">\n";
  }

  std::string arrays(const std::string& tag, On place) const {
    std::string xml = "<" + tag + ">\n";
    for (const Array& array : arrays_)
      if (array.place == place) xml += array.element;
    return xml + "</" + tag + ">\n";
  }

  /// XML element of an array; appends its bytes to appended_.
  template <VtkNumber T>
  std::string element(std::string_view name, std::size_t components, std::span<const T> values) {
    const std::size_t offset = appended_.size();
    const std::uint64_t bytes = values.size_bytes();
    appended_.append(reinterpret_cast<const char*>(&bytes), sizeof bytes);
    appended_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
    return "<DataArray type=\"" + std::string(vtk_type_name<T>()) + "\" Name=\"" +
           std::string(name) + "\" NumberOfComponents=\"" + std::to_string(components) +
           "\" format=\"appended\" offset=\"" + std::to_string(offset) + "\"/>\n";
  }

  std::size_t most_ = most;
  std::vector<float> points_;
  std::array<CellList, 3> cells_;
  std::vector<Array> arrays_;
  std::string appended_;
};

/// A .pvd file: a list of files with their times, which ParaView plays as an animation.
class PvdSeries {
 public:
  /// Does not write a file; add() does.
  explicit PvdSeries(std::filesystem::path path) : path_(std::move(path)) {}

  /// Adds a file to the list and rewrites the .pvd file, which is therefore complete at any time.
  /// @param time [s]
  /// @param file name relative to the folder of the .pvd file
  /// @param part ParaView shows files with the same time together, as parts 0, 1, ...
  /// @throws std::invalid_argument if the name is empty or contains a control character or one of
  ///         " < &, if the time is not finite, or if part < 0
  /// @throws std::system_error naming the path if the .pvd file cannot be written; the list is then
  ///         unchanged, so the file can be added again
  void add(double time, std::string_view file, int part = 0) {
    require(std::isfinite(time), "PvdSeries::add", "time", time, "must be finite");
    require(!file.empty(), "PvdSeries::add", "file", "''", "must be a name");
    require(detail::is_plain_xml(file), "PvdSeries::add", "file", file,
            "must have no control character and none of \" < &");
    require(part >= 0, "PvdSeries::add", "part", part, "must be >= 0");
    std::ostringstream line;
    line.imbue(std::locale::classic());
    line.precision(17);
    line << "<DataSet timestep=\"" << time << "\" part=\"" << part << "\" file=\"" << file
         << "\"/>\n";
    std::string lines = lines_ + line.str();
    write_atomically(path_,
                     "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n"
                     "<Collection>\n" +
                         lines + "</Collection>\n</VTKFile>\n");
    lines_ = std::move(lines);
  }

 private:
  friend struct SerializationAccess;
  auto serialized_members() { return std::tie(lines_); }

  std::filesystem::path path_;
  std::string lines_;
};

}  // namespace moreau
