#pragma once

#include <filesystem>
#include <string>

namespace breccia {

/// Holds a run's folder for one process: flock on the file `run.lock` in it, which names process and machine. The
/// system lets go of it when the process ends, however it ends, so a lock that is left over holds nothing.
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

/// What the lock file says of its owner. @param process  its number
[[nodiscard]] std::string owner_words(const std::string& process);

/// Words for who holds a folder ("process 17 on host, since ..."); empty: it is free. A folder without a lock file is
/// free. Throws nothing.
[[nodiscard]] std::string holder_of(const std::filesystem::path& folder);

/// A small process of its own session that outlives this one: when this one ends, it looks at the end of the run's
/// status.jsonl. Where that still says "running" or "paused", or nothing yet, it appends a line
/// {"state": "interrupted", "message": ...} (or "failed" after an error that this process has told), so that a run that
/// was killed does not look alive.
class RunWatch {
 public:
  /// Starts it, early: it keeps the memory that this process has now. Without processes to be had there is no watch.
  RunWatch();
  RunWatch(const RunWatch&) = delete;
  RunWatch& operator=(const RunWatch&) = delete;
  ~RunWatch();  ///< lets it look
  void guard(const std::filesystem::path& folder) const;

 private:
  int pipe_ = -1;
  int exceptions_ = 0;
};

}  // namespace breccia
