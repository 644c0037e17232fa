// SPDX-License-Identifier: MIT
// Simulates faults while a file is written: a full disk, a folder without write permission, a
// killed process.
#pragma once

#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <utility>

/// While an object of this class exists, files cannot become larger than `bytes`, as on a full
/// disk.
class FullDisk {
 public:
  explicit FullDisk(std::uintmax_t bytes) : signal_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit little{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &little);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, signal_);
  }

 private:
  rlimit before_{};
  void (*signal_)(int);
};

/// While an object of this class exists, the folder can be read but not written. If the test runs
/// as root, the object changes the user to nobody, because root may write to any folder.
class UnwritableFolder {
 public:
  explicit UnwritableFolder(std::filesystem::path path) : path_(std::move(path)), user_(geteuid()) {
    std::filesystem::permissions(path_, std::filesystem::perms(0555));
    if (user_ == 0) changed_ = seteuid(65534) == 0;
  }
  UnwritableFolder(const UnwritableFolder&) = delete;
  UnwritableFolder& operator=(const UnwritableFolder&) = delete;
  ~UnwritableFolder() {
    if (changed_) changed_ = seteuid(user_) != 0;
    std::error_code ignored;
    std::filesystem::permissions(path_, std::filesystem::perms(0755), ignored);
  }

 private:
  std::filesystem::path path_;
  uid_t user_;
  bool changed_ = false;
};

/// Calls does() repeatedly in another process, and kills this process after `time`.
template <class F>
void kill_while(std::chrono::microseconds time, F&& does) {
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork failed");
  while (child == 0) does();
  std::this_thread::sleep_for(time);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
}
