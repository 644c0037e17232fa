// SPDX-License-Identifier: MIT
// Reads a file. If this fails, the error names the file and the reason.
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>

namespace moreau {

namespace detail {

/// Reads all bytes of a file.
/// @param function name of the public function, for the error message
/// @throws std::system_error naming function, path and reason if the file cannot be read
inline std::string read_file(const std::filesystem::path& path, std::string_view function) {
  const auto fail = [&] {
    const int reason = errno != 0 ? errno : EIO;
    throw std::system_error(reason, std::generic_category(),
                            std::string(function) + ": cannot read '" + path.string() + "'");
  };
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  errno = 0;
  const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
  if (!file) fail();
  std::string bytes;
  char some[1 << 14];
  // fopen() succeeds on a folder; fread() then fails.
  while (const std::size_t count = std::fread(some, 1, sizeof some, file.get()))
    bytes.append(some, count);
  if (std::ferror(file.get()) != 0) fail();
  return bytes;
}

}  // namespace detail

}  // namespace moreau
