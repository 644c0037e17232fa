// SPDX-License-Identifier: MIT
// Reads and writes contact problems in the HDF5 format of FCLIB, the Frictional Contact Library (V.
// Acary et al., "FCLIB: a collection of discrete 3D Frictional Contact problems", INRIA RT-444,
// 2014). A local problem can be read and written. It consists of the groups and data sets
//
//     /fclib_local/spacedim, W/{nzmax, m, n, nz, p, i, x}, vectors/{q, mu}
//     /solution/{u, r}
//
// where q is the free velocity, which is called b elsewhere in this library. A global problem can
// only be read. It is the group /fclib_global, with the matrices M and H in place of W and with
// vectors/{f, w, mu}. The matrix H of FCLIB is the transposed contact Jacobian J.
//
// This header is optional: it needs the C library of HDF5. Link hdf5. No other header includes it.
#pragma once

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <hdf5.h>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/io/friction_file.hpp"
#include "moreau/io/output_file.hpp"

namespace moreau {

namespace detail {

/// Owns an open object of the HDF5 library and closes it in the destructor.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);
  /// @param what the action that opened the object, for the error message
  /// @throws std::runtime_error if the id is negative, that is, if the call failed
  Hdf5Handle(hid_t id, Close close, const std::string& what) : id_(id), close_(close) {
    if (id < 0) throw std::runtime_error("HDF5: cannot " + what);
  }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  ~Hdf5Handle() { close_(id_); }
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): as in C

 private:
  hid_t id_;
  Close close_;
};

/// While an object of this class exists, HDF5 prints no error messages. Errors are reported by
/// exceptions instead.
class QuietHdf5 {
 public:
  QuietHdf5() {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  QuietHdf5(const QuietHdf5&) = delete;
  QuietHdf5& operator=(const QuietHdf5&) = delete;
  ~QuietHdf5() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

inline hid_t hdf5_type(double) {
  return H5T_NATIVE_DOUBLE;
}
inline hid_t hdf5_type(int) {
  return H5T_NATIVE_INT;
}

template <class Number>
std::vector<Number> read_hdf5(hid_t group, const std::string& name) {
  const Hdf5Handle set(H5Dopen2(group, name.c_str(), H5P_DEFAULT), &H5Dclose, "open " + name);
  const Hdf5Handle space(H5Dget_space(set), &H5Sclose, "read the size of " + name);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (count < 0) throw std::runtime_error("HDF5: cannot read the size of " + name);
  // A damaged file may state a huge count. Deflate compresses at most by a factor of 1032, and a
  // number has at least one byte before compression.
  if (static_cast<hsize_t>(count) / 1100 > H5Dget_storage_size(set))
    throw std::runtime_error("HDF5: " + name + " claims " + std::to_string(count) +
                             " numbers, more than the file can hold");
  std::vector<Number> numbers(static_cast<std::size_t>(count));
  if (count > 0 &&
      H5Dread(set, hdf5_type(Number()), H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()) < 0)
    throw std::runtime_error("HDF5: cannot read " + name);
  return numbers;
}
inline int read_hdf5_integer(hid_t group, const std::string& name) {
  const std::vector<int> numbers = read_hdf5<int>(group, name);
  require(numbers.size() == 1, "read_fclib", "size of " + name, numbers.size(), "must be 1");
  return numbers[0];
}

template <class Number>
void write_hdf5(hid_t group, const std::string& name, std::span<const Number> numbers) {
  const hsize_t count = numbers.size();
  const Hdf5Handle space(H5Screate_simple(1, &count, nullptr), &H5Sclose, "write " + name);
  const Hdf5Handle set(H5Dcreate2(group, name.c_str(), hdf5_type(Number()), space, H5P_DEFAULT,
                                  H5P_DEFAULT, H5P_DEFAULT),
                       &H5Dclose, "create " + name);
  if (count > 0 &&
      H5Dwrite(set, hdf5_type(Number()), H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()) < 0)
    throw std::runtime_error("HDF5: cannot write " + name);
}
inline void write_hdf5(hid_t group, const std::string& name, int number) {
  write_hdf5(group, name, std::span<const int>(&number, 1));
}
inline void write_hdf5(hid_t group, const std::string& name, const Eigen::VectorXd& numbers) {
  write_hdf5(group, name, std::span<const double>(numbers.data(), std::size_t(numbers.size())));
}

inline Hdf5Handle open_hdf5_group(hid_t parent, const std::string& name) {
  return {H5Gopen2(parent, name.c_str(), H5P_DEFAULT), &H5Gclose, "open the group " + name};
}
inline Hdf5Handle create_hdf5_group(hid_t parent, const std::string& name) {
  return {H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), &H5Gclose,
          "create the group " + name};
}

/// Reads a matrix in the storage of CSparse: compressed rows for nz = -2, compressed columns for nz
/// = -1, nz triplets for nz >= 0. For triplets, p contains the column indices and i the row
/// indices, as in CSparse and in existing files; FCLIB's fclib.h documents p and i the other way
/// round.
/// @param group  group that contains the matrix as the subgroup `name`
/// @param rows_wanted,columns_wanted required size. A file with a different size is rejected, so
///                                   that a damaged file cannot cause a huge allocation
inline RowSparse read_fclib_matrix(hid_t group, const std::string& name, std::size_t rows_wanted,
                                   std::size_t columns_wanted) {
  constexpr const char* self = "read_fclib";
  constexpr int compressed_rows = -2, compressed_columns = -1;
  const auto matrix = open_hdf5_group(group, name);
  const int rows = read_hdf5_integer(matrix, "m"), columns = read_hdf5_integer(matrix, "n");
  const int form = read_hdf5_integer(matrix, "nz");
  const std::vector<int> p = read_hdf5<int>(matrix, "p"), index = read_hdf5<int>(matrix, "i");
  const std::vector<double> x = read_hdf5<double>(matrix, "x");
  require(rows >= 0 && std::size_t(rows) == rows_wanted, self, name + "/m", rows,
          "must equal the size of the vectors");
  require(columns >= 0 && std::size_t(columns) == columns_wanted, self, name + "/n", columns,
          "must equal the size of the vectors");
  Triplets entries;
  if (form >= 0) {
    const auto count = std::size_t(form);
    require(count <= p.size() && count <= index.size() && count <= x.size(), self, name + "/nz",
            form, "must not exceed the entries of p, i and x");
    for (std::size_t k = 0; k < count; ++k) entries.emplace_back(index[k], p[k], x[k]);
    return checked_matrix(rows, columns, entries, self, name);
  }
  require(form == compressed_rows || form == compressed_columns, self, name + "/nz", form,
          "must be -2, -1 or >= 0");
  const bool by_rows = form == compressed_rows;
  const auto outer = std::size_t(by_rows ? rows : columns);
  require(p.size() > outer, self, "size of " + name + "/p", p.size(),
          "must exceed the number of rows or columns");
  for (std::size_t o = 0; o < outer; ++o) {
    const std::string where = name + "/p[" + std::to_string(o + 1) + "]";
    require(p[o] >= 0 && p[o + 1] >= p[o], self, where, p[o + 1], "must not decrease");
    const auto end = std::size_t(p[o + 1]);
    require(end <= index.size() && end <= x.size(), self, where, p[o + 1],
            "must not exceed the entries of i and x");
    for (auto k = std::size_t(p[o]); k < end; ++k)
      by_rows ? entries.emplace_back(int(o), index[k], x[k])
              : entries.emplace_back(index[k], int(o), x[k]);
  }
  return checked_matrix(rows, columns, entries, self, name);
}

/// Reduces the global problem M v = J^T r + f, u = J v + w to a local problem by eliminating v: W =
/// J M^-1 J^T, b = J M^-1 f + w.
/// @param h J^T, as it is stored in files
inline void condense(const RowSparse& mass, const RowSparse& h, const std::vector<double>& f,
                     const std::vector<double>& w, RawFrictionProblem& raw) {
  constexpr const char* self = "read_fclib";
  using Sparse = Eigen::SparseMatrix<double>;
  using Map = Eigen::Map<const Eigen::VectorXd>;
  require(mass.rows() > 0, self, "M", mass.rows(), "must have rows");
  Eigen::SparseLU<Sparse> lu(Sparse{mass});
  require(lu.info() == Eigen::Success, self, "M", mass.rows(), "must be invertible");
  const Sparse by_columns = h;
  const Sparse inverse_h = lu.solve(by_columns);
  raw.delassus = by_columns.transpose() * inverse_h;
  const Eigen::VectorXd free =
      by_columns.transpose() * lu.solve(Map(f.data(), h.rows())) + Map(w.data(), h.cols());
  raw.free_velocity.assign(free.begin(), free.end());
}

template <class S>
void write_fclib_matrix(hid_t group, const FrictionProblem<S>& problem) {
  auto w = problem.delassus;
  w.makeCompressed();
  const auto entries = std::size_t(w.nonZeros());
  write_hdf5(group, "nzmax", int(entries));
  write_hdf5(group, "m", int(w.rows()));
  write_hdf5(group, "n", int(w.cols()));
  write_hdf5(group, "nz", -2);
  write_hdf5(group, "p", std::span<const int>(w.outerIndexPtr(), std::size_t(w.rows()) + 1));
  write_hdf5(group, "i", std::span<const int>(w.innerIndexPtr(), entries));
  write_hdf5(group, "x", std::span<const double>(w.valuePtr(), entries));
}

inline AnyFrictionProblem read_fclib_problem(const std::filesystem::path& path) {
  constexpr const char* self = "read_fclib";
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), &H5Fclose,
                        "open it: missing, not readable, not an HDF5 file, or truncated");
  const bool is_local = H5Lexists(file, "fclib_local", H5P_DEFAULT) > 0;
  require(is_local || H5Lexists(file, "fclib_global", H5P_DEFAULT) > 0, self, "path", path.string(),
          "must hold a group fclib_local or fclib_global");
  const auto group = open_hdf5_group(file, is_local ? "fclib_local" : "fclib_global");
  for (const char* bilateral : {"V", "R", "G"})
    require(H5Lexists(group, bilateral, H5P_DEFAULT) <= 0, self, "group", bilateral,
            "must not exist: bilateral constraints are not solved");
  RawFrictionProblem raw;
  raw.rows_per_contact = read_hdf5_integer(group, "spacedim");
  const auto vectors = open_hdf5_group(group, "vectors");
  raw.friction = read_hdf5<double>(vectors, "mu");
  if (is_local) {
    raw.free_velocity = read_hdf5<double>(vectors, "q");
    const std::size_t size = raw.free_velocity.size();
    raw.delassus = read_fclib_matrix(group, "W", size, size);
  } else {
    const auto f = read_hdf5<double>(vectors, "f");
    const auto w = read_hdf5<double>(vectors, "w");
    condense(read_fclib_matrix(group, "M", f.size(), f.size()),
             read_fclib_matrix(group, "H", f.size(), w.size()), f, w, raw);
  }
  return checked_problem(raw, self);
}

/// Builds the bytes of a file in memory. If HDF5 wrote the file itself, a full disk would leave an
/// incomplete file.
template <class S>
std::string fclib_image(const FrictionProblem<S>& problem, const Eigen::VectorXd& impulses) {
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), &H5Pclose, "build the file in memory");
  if (H5Pset_fapl_core(access, std::size_t{1} << 20, false) < 0)
    throw std::runtime_error("HDF5: cannot build the file in memory");
  const Hdf5Handle file(H5Fcreate("problem.hdf5", H5F_ACC_TRUNC, H5P_DEFAULT, access), &H5Fclose,
                        "build the file in memory");
  const auto local = create_hdf5_group(file, "fclib_local");
  write_hdf5(local, "spacedim", int(S::dim));
  write_fclib_matrix(create_hdf5_group(local, "W"), problem);
  const auto vectors = create_hdf5_group(local, "vectors");
  write_hdf5(vectors, "q", problem.free_velocity);
  write_hdf5(vectors, "mu", problem.friction);
  if (impulses.size() > 0) {
    const auto solution = create_hdf5_group(file, "solution");
    const Eigen::VectorXd u = problem.delassus * impulses + problem.free_velocity;
    write_hdf5(solution, "u", u);
    write_hdf5(solution, "r", impulses);
  }
  const ssize_t size =
      H5Fflush(file, H5F_SCOPE_GLOBAL) < 0 ? -1 : H5Fget_file_image(file, nullptr, 0);
  std::string bytes(static_cast<std::size_t>(std::max<ssize_t>(size, 0)), '\0');
  if (size <= 0 || H5Fget_file_image(file, bytes.data(), bytes.size()) != size)
    throw std::runtime_error("HDF5: cannot build the file in memory");
  return bytes;
}

/// Calls f(). If it throws an exception, adds the path to the exception's message.
template <class F>
auto naming(const std::filesystem::path& path, F&& f) {
  const QuietHdf5 quiet;
  try {
    return f();
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(path.string() + ": " + error.what());
  }
}

}  // namespace detail

/// Whether a file is an HDF5 file; also false if the file cannot be read.
inline bool is_hdf5(const std::filesystem::path& path) {
  const detail::QuietHdf5 quiet;
  return H5Fis_hdf5(path.c_str()) > 0;
}

/// Reads the contact problem of an FCLIB file, in the units of the file. A global problem is
/// reduced to a local problem: W = J M^-1 J^T, b = J M^-1 f + w.
/// @throws std::runtime_error naming the path if the file cannot be opened or a data set is missing
/// @throws std::invalid_argument naming the path and the reason if the problem is not valid, or if
///                               it has bilateral constraints or rolling friction, which this
///                               library does not solve
inline AnyFrictionProblem read_fclib(const std::filesystem::path& path) {
  return detail::naming(path, [&] { return detail::read_fclib_problem(path); });
}

/// Writes a contact problem to an FCLIB file, with W in compressed rows. An existing file is
/// replaced as a whole (write_atomically()).
/// @param impulses r, D components per contact, in the units of the problem [N s]. The file then
///                 has a group `solution` with r and u = W r + b. If empty, the file has no such
///                 group
/// @throws std::system_error naming the path if the file cannot be written
/// @throws std::invalid_argument if the problem is not valid or the number of impulses is wrong
template <class S>
void write_fclib(const std::filesystem::path& path, const FrictionProblem<S>& problem,
                 const Eigen::VectorXd& impulses = {}) {
  require_valid(problem, "write_fclib");
  require(impulses.size() == 0 || impulses.size() == problem.free_velocity.size(), "write_fclib",
          "impulses.size()", impulses.size(), "must be 0 or D times the contacts");
  write_atomically(path,
                   detail::naming(path, [&] { return detail::fclib_image(problem, impulses); }));
}

}  // namespace moreau
