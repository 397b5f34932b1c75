#ifndef brecciaRunFolder_h
#define brecciaRunFolder_h

#include <string>
#include <vector>

#include "run_folder/history.hpp"

namespace breccia {

/// A recorded picture of a channel.
struct FrameFile {
  double time;  ///< s
  std::string path;
};

/// A part of a run that is recorded: "elements", "joints", "contacts".
struct RecordedChannel {
  std::string name;
  std::vector<FrameFile> frames;  ///< by time; those that are not whole are left out
  /// The frame that holds at a time: the last one not after it, or the first. @pre there are frames
  const FrameFile& At(double time) const;
};

/// What a run has left, or has so far, in its folder.
struct RunFolder {
  std::string path;
  std::vector<RecordedChannel> channels;  ///< elements first, then by name
  std::vector<std::string> incomplete;    ///< frames that an index names and that are missing or cut off
  std::vector<double> Times() const;      ///< of all channels, each once
};

/// The folder of a run, by its own path or by that of any file in it or in its frames. Throws BadInput (brecciaData.h)
/// when it is none, or has no frame yet.
RunFolder OpenRun(const std::string& path);
/// True for what OpenRun takes for a run's folder, with or without frames.
bool IsRun(const std::string& path);

/// Columns of a run's history.csv. A last line that is still being written is left out. Throws BadInput when there is
/// no such file, or when it is no table of numbers.
run_folder::History ReadHistory(const std::string& folder);

/// Names of the bodies by their numbers, from bodies.csv. Empty where there is no such file, as in runs of before, or
/// where it is no such table.
std::vector<std::string> ReadBodyNames(const std::string& folder);

}  // namespace breccia

#endif
