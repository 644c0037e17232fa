// SPDX-License-Identifier: MIT
// Writes a file. Every error names the file and the reason.
#pragma once

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#if __has_include(<unistd.h>)
#include <fcntl.h>
#include <unistd.h>
#endif

namespace moreau {

/// A file without a buffer: write() passes its bytes to the operating system before it returns.
/// Every failure throws std::system_error, naming the path and the reason.
class OutputFile {
 public:
  /// Creates the file, or empties an existing file. The folder must exist.
  /// @param keep if > 0, an existing file is continued: its first `keep` bytes stay, the rest is
  ///             removed, and new bytes are appended. It is an error if the file has fewer bytes
  /// @throws std::system_error if the file cannot be opened, created or continued
  explicit OutputFile(const std::filesystem::path& path, std::uintmax_t keep = 0)
      : path_(path), written_(keep) {
    errno = 0;
    if (keep > 0) {
      std::error_code error;
      const std::uintmax_t size = std::filesystem::file_size(path, error);
      if (!error && size < keep)
        throw std::system_error(std::make_error_code(std::errc::invalid_argument),
                                "cannot continue '" + path.string() + "': it has " +
                                    std::to_string(size) + " of the " + std::to_string(keep) +
                                    " bytes to keep");
      if (!error) std::filesystem::resize_file(path, keep, error);
      if (error) throw std::system_error(error, "cannot continue '" + path.string() + "'");
    }
    file_.reset(std::fopen(path.c_str(), keep > 0 ? "ab" : "wb"));
    if (!file_) fail("open");
    std::setvbuf(file_.get(), nullptr, _IONBF, 0);
  }

  const std::filesystem::path& path() const { return path_; }  ///< path of the file

  /// Appends the bytes. If the disk has not enough space for all of them, none is added to a
  /// regular file.
  /// @throws std::system_error if the bytes cannot be written, or after close()
  void write(std::string_view bytes) {
    errno = 0;
    if (!file_ || std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) {
      const int reason = errno;
      take_back();
      errno = reason;
      fail("write");
    }
    written_ += bytes.size();
  }
  /// Waits until the written bytes are on the disk, if the system supports it.
  /// @throws std::system_error if the system reports a failure
  void sync() {
#if __has_include(<unistd.h>)
    errno = 0;
    // Pipes and similar files have no disk and report EINVAL or ENOTSUP.
    if (file_ && ::fsync(::fileno(file_.get())) != 0 && errno != EINVAL && errno != ENOTSUP)
      fail("write");
#endif
  }
  /// Closes the file and checks that all bytes were written. Do not call write() afterwards.
  /// @throws std::system_error if not all bytes were written
  void close() {
    if (!file_) return;
    errno = 0;
    if (std::fclose(file_.release()) != 0) fail("write");
  }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  /// Removes the part of its bytes that a failed write() has added to the file.
  void take_back() {
#if __has_include(<unistd.h>)
    if (file_ && ::ftruncate(::fileno(file_.get()), static_cast<off_t>(written_)) == 0)
      std::fseek(file_.get(), 0, SEEK_END);
#endif
  }
  [[noreturn]] void fail(const char* what) const {
    const int reason = errno != 0 ? errno : EIO;
    throw std::system_error(reason, std::generic_category(),
                            std::string("cannot ") + what + " '" + path_.string() + "'");
  }

  std::filesystem::path path_;
  std::uintmax_t written_;  // size of the file [bytes], including `keep`
  std::unique_ptr<std::FILE, Close> file_;
};

namespace detail {

/// Waits until the entries of a folder are on the disk, if the system supports it.
inline void sync_folder([[maybe_unused]] const std::filesystem::path& folder) {
#if __has_include(<unistd.h>)
  const int file = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY);
  if (file < 0) return;
  ::fsync(file);  // not every file system supports it
  ::close(file);
#endif
}

/// The path that results from following all symbolic links. There need not be a file with this
/// path.
inline std::filesystem::path behind_links(std::filesystem::path path) {
  std::error_code none;
  for (int k = 0; k < 40 && std::filesystem::is_symlink(path, none); ++k)
    path = path.parent_path() / std::filesystem::read_symlink(path, none);
  return path;
}

}  // namespace detail

/// Replaces a file as a whole. A reader finds either the old or the new file, never a part of it,
/// even after the program was killed or the power failed. The function writes a temporary file with
/// the suffix ".part" in the same folder and renames it. If the path is a symbolic link, the target
/// of the link is replaced. If the path is a device or a pipe, the bytes are written to it
/// directly.
/// @throws std::system_error naming the path and the reason; the old file is then unchanged
inline void write_atomically(const std::filesystem::path& path, std::string_view bytes) {
  std::error_code ignored;
  // Test the path itself, because the link target of a pipe's descriptor is not a file name.
  if (std::filesystem::is_other(std::filesystem::status(path, ignored))) {
    OutputFile file(path);
    file.write(bytes);
    file.close();
    return;
  }
  const std::filesystem::path target = detail::behind_links(path);
  std::filesystem::path partial = target;
  partial += ".part";
  try {
    OutputFile file(partial);
    file.write(bytes);
    file.sync();
    file.close();
    std::filesystem::rename(partial, target);
    detail::sync_folder(target.parent_path());
  } catch (const std::system_error& error) {
    std::filesystem::remove(partial, ignored);
    throw std::system_error(error.code(), "cannot write '" + path.string() + "' through '" +
                                              partial.filename().string() + "' in the same folder");
  } catch (...) {
    std::filesystem::remove(partial, ignored);
    throw;
  }
}

}  // namespace moreau
