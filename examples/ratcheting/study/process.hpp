// SPDX-License-Identifier: MIT
// Child processes and locks, by POSIX.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace study {

/// A lock on a file, held until the object or its process ends.
class FileLock {
 public:
  /// @returns nothing if another process holds the lock
  /// @throws std::system_error if the file cannot be created
  static std::optional<FileLock> attempt(const std::filesystem::path& path);
  /// Waits until no other process holds the lock.
  /// @throws std::system_error if the file cannot be created
  static FileLock wait(const std::filesystem::path& path);
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;
  ~FileLock();

 private:
  explicit FileLock(const std::filesystem::path& path);
  int descriptor_;
};

/// Starts a program with standard and error output in a file. The program is killed when this
/// process ends.
/// @throws std::system_error if it cannot be started
pid_t start(const std::filesystem::path& program, const std::vector<std::string>& arguments,
            const std::filesystem::path& log);

/// How a child process has ended.
struct Ending {
  pid_t process;
  bool well;         ///< status 0
  std::string what;  ///< otherwise "status 1" or "killed by signal 9"
};

/// Returns a child process that has ended since the last call, if there is one; does not wait.
std::optional<Ending> ended_child();

}  // namespace study
