#pragma once

#include <filesystem>
#include <string>

namespace breccia {

/// Locks a run's folder for one process: flock on the file `run.lock` in it, which names process and machine. The
/// system releases it when the process ends in any way, so a left-over file is no lock.
class RunLock {
 public:
  /// @param folder  exists. Throws OutputError that names who holds it; when the file cannot be written.
  explicit RunLock(const std::filesystem::path& folder);
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;
  ~RunLock();

  /// Of the lock file. A copy of this process (fork) that keeps it open holds the folder, too.
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  int descriptor_ = -1;
};

[[nodiscard]] std::filesystem::path lock_file(const std::filesystem::path& folder);

/// The words of the lock file about its owner. @param process  its number
[[nodiscard]] std::string owner_words(const std::string& process);

/// Words for who holds a folder ("process 17 on host, since ..."); empty: it is free. A folder without a lock file is
/// free. Throws nothing.
[[nodiscard]] std::string holder_of(const std::filesystem::path& folder);

/// A small process of its own session that outlives this one: when this one ends, it reads the end of the run's
/// status.jsonl. If the state is still "running" or "paused", or missing, it appends a line {"state": "interrupted",
/// "message": ...} (or "failed" after an error that this process has reported), so that a killed run does not appear to
/// be in progress.
class RunWatch {
 public:
  /// Starts it, early: it keeps the memory that this process has now. Without processes to be had there is no watch.
  RunWatch();
  RunWatch(const RunWatch&) = delete;
  RunWatch& operator=(const RunWatch&) = delete;
  ~RunWatch();  ///< starts its check
  void guard(const std::filesystem::path& folder) const;

 private:
  int pipe_ = -1;
  int exceptions_ = 0;
};

}  // namespace breccia
