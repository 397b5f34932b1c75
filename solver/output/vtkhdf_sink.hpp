#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "output/sink.hpp"

namespace breccia {

/// Which parts of a frame become files.
struct FrameParts {
  bool elements = true, joints = true, contacts = true;
};

/// Frames for ParaView: `<folder>/elements_000012.vtkhdf` (tetrahedra), `joints_...` (triangles), `contacts_...` (vertices
/// with force vectors), and one index of times for each, `elements.hdf.series`: the file to open (ParaView 5.11 knows the
/// reader by the ending .hdf alone, and the times only from here). An index lists complete files only, whenever the run
/// is killed. Cell arrays carry the names of Frame's members; stress has the components XX YY ZZ XY YZ XZ.
class VtkhdfSink final : public Sink {
 public:
  /// @pre folder exists
  explicit VtkhdfSink(std::filesystem::path folder, FrameParts parts = {});

  /// Writes the parts and their indices, all at once. Throws OutputError naming the file; what was there before stays.
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
  [[nodiscard]] static std::string index_text(const Series& series);

  std::filesystem::path folder_;
  std::vector<Series> series_;  ///< of the parts asked for
};

}  // namespace breccia
