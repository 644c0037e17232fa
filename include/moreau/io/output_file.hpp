// SPDX-License-Identifier: MIT
// A file to write to, which says so when it cannot.
#pragma once

#include <cerrno>
#include <cstdint>
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

/// Bytes go out with write() and are with the operating system when it returns.
/// Every failure throws std::system_error naming the path and the reason.
class OutputFile {
 public:
  /// Empties the file or creates it; its folder must exist.
  /// @param keep goes on behind so many bytes of a file that is there, and cuts off what follows
  ///             them; a file that has less is an error
  /// @throws std::system_error if the file cannot be opened, created or gone on with
  explicit OutputFile(const std::filesystem::path& path, std::uintmax_t keep = 0)
      : path_(path), written_(keep) {
    errno = 0;
    if (keep > 0) {
      std::error_code error;
      const std::uintmax_t size = std::filesystem::file_size(path, error);
      if (!error && size < keep)
        throw std::system_error(std::make_error_code(std::errc::invalid_argument),
                                "cannot go on with '" + path.string() + "', it has " +
                                    std::to_string(size) + " of the " + std::to_string(keep) +
                                    " bytes to be kept");
      if (!error) std::filesystem::resize_file(path, keep, error);
      if (error) throw std::system_error(error, "cannot go on with '" + path.string() + "'");
    }
    file_.reset(std::fopen(path.c_str(), keep > 0 ? "ab" : "wb"));
    if (!file_) fail("open");
    std::setvbuf(file_.get(), nullptr, _IONBF, 0);
  }

  const std::filesystem::path& path() const { return path_; }  ///< of the file

  /// Appends the bytes. If not all of them find room, a file on a disk has none of them.
  /// @throws std::system_error if they cannot be written, or after close()
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
  /// Waits until what was written is on the disk, where the system can say so.
  /// @throws std::system_error if the system says that it cannot
  void sync() {
#if __has_include(<unistd.h>)
    errno = 0;
    // Pipes and the like have no disk.
    if (file_ && ::fsync(::fileno(file_.get())) != 0 && errno != EINVAL && errno != ENOTSUP)
      fail("write");
#endif
  }
  /// Closes the file and checks that all of it could be written. No write() after it.
  /// @throws std::system_error if it could not
  void close() {
    if (!file_) return;
    errno = 0;
    if (std::fclose(file_.release()) != 0) fail("write");
  }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  /// What was written of the bytes for which there was no room.
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
  std::uintmax_t written_;  // bytes, those that were kept included
  std::unique_ptr<std::FILE, Close> file_;
};

namespace detail {

/// Waits until the names in a folder are on the disk, where the system can say so.
inline void sync_folder([[maybe_unused]] const std::filesystem::path& folder) {
#if __has_include(<unistd.h>)
  const int file = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY);
  if (file < 0) return;
  ::fsync(file);  // not every file system can
  ::close(file);
#endif
}

/// What a path leads to behind symbolic links, there or not.
inline std::filesystem::path behind_links(std::filesystem::path path) {
  std::error_code none;
  for (int k = 0; k < 40 && std::filesystem::is_symlink(path, none); ++k)
    path = path.parent_path() / std::filesystem::read_symlink(path, none);
  return path;
}

}  // namespace detail

/// Replaces a file as a whole: a reader, a run that is killed or a machine that loses its power
/// finds the old one or the new one, never a part. On the way the new one is beside it, under its
/// name with ".part". A symbolic link stays, what it leads to is replaced; what is no file, a
/// device or a pipe, is written to.
/// @throws std::system_error naming the path and the reason; the old file is then as it was
inline void write_atomically(const std::filesystem::path& path, std::string_view bytes) {
  std::error_code ignored;
  // Asked of the path itself: the link of a pipe's descriptor names no file.
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
    throw std::system_error(error.code(), "cannot write '" + path.string() + "' by way of '" +
                                              partial.filename().string() + "' beside it");
  } catch (...) {
    std::filesystem::remove(partial, ignored);
    throw;
  }
}

}  // namespace moreau
