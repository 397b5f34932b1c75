#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "output/sink.hpp"
#include "parallel/communicator.hpp"

namespace breccia {

/// Frames for ParaView: `<folder>/elements_000012.vtkhdf` (tetrahedra), `joints_...` (triangles), `contacts_...`
/// (vertices with force vectors), and one index of times for each, `elements.hdf.series`: the file to open
/// (ParaView 5.11 knows the reader by the ending .hdf alone, and the times only from here). An index lists complete
/// files only, whenever the run is killed. Cell arrays carry the names of Frame's members; stress has the components XX
/// YY ZZ XY YZ XZ. Of several ranks each hands in its own originals: its piece of the one file, by rank.
class VtkhdfSink final : public Sink {
 public:
  /// @pre folder exists
  explicit VtkhdfSink(std::filesystem::path folder, FrameParts parts = {}, Communicator communicator = {});

  /// For a resumed run: keeps the frames up to its mark in the indices and removes later ones.
  /// Throws OutputError.
  void start(const RunStart& run) override;
  void mark(OutputMarks& marks) const override;
  /// Writes the parts and their indices, all at once. Throws OutputError naming the file, on all ranks; what was there
  /// before stays. Collective. @pre step, time and number alike on all ranks
  void frame(const Frame& frame) override;

 private:
  struct Entry {
    std::string file;
    double time;
  };
  struct Series {
    std::string part;
    std::vector<Entry> entries;
  };
  [[nodiscard]] std::vector<Entry> listed(const std::string& part) const;
  void keep_frames(std::size_t count);
  [[nodiscard]] static std::string index_text(const Series& series);
  [[nodiscard]] std::filesystem::path newest(const Series& series) const {
    return folder_ / series.entries.back().file;
  }
  void write_alone(const Frame& frame, const std::vector<Series>& series) const;
  void write_together(const Frame& frame, const std::vector<Series>& series) const;
  /// Makes the newest frames and the indices appear. @param images  of the frames; empty: the temporaries stand already
  void publish(const std::vector<Series>& series, const std::vector<std::vector<std::byte>>& images) const;

  std::filesystem::path folder_;
  Communicator communicator_;
  std::vector<Series> series_;  ///< of the requested parts
};

}  // namespace breccia
