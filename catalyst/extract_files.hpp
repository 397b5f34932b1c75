#pragma once

#include <vtkDataObject.h>
#include <vtkSmartPointer.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace breccia::insitu {

/// Files of a recorded channel, all in one folder:
///   channel.pvd                        the times and their .pvtu or .pvtp; replaced as a whole, after what it lists is
///   complete channel_000000120.pvtu             the pieces of one instant channel_000000120/0000.vtu, ...    the piece
///   of each rank, LZ4
struct RecordedInstant {
  std::int64_t step = 0;
  double time = 0.0;           ///< s
  std::filesystem::path file;  ///< relative to the folder
};

/// "pvtu" for an unstructured grid, "pvtp" for polygons.
[[nodiscard]] std::string summary_suffix(vtkDataObject* object);

/// "channel_000000120".
[[nodiscard]] std::string instant_name(const std::string& channel, std::int64_t step);

/// Name of a rank's piece relative to the folder: "channel_000000120/0000.vtu".
[[nodiscard]] std::filesystem::path piece_name(vtkDataObject* object, const std::string& channel, std::int64_t step,
                                               int rank);

/// Writes one rank's piece, an existing one is replaced. Returns its bytes. Throws PipelineError.
std::int64_t write_piece(vtkDataObject* object, const std::filesystem::path& file);

/// Text of the .pvtu or .pvtp with the pieces of `ranks` ranks that all have the arrays of `object`.
[[nodiscard]] std::string summary_text(vtkDataObject* object, const std::string& channel, std::int64_t step, int ranks);

[[nodiscard]] std::string pvd_text(const std::vector<RecordedInstant>& instants);

/// Instants listed by a .pvd, in its order; none when the file is not there. Throws PipelineError when it cannot be
/// understood.
[[nodiscard]] std::vector<RecordedInstant> read_pvd(const std::filesystem::path& file);

/// Files of the pieces listed by a .pvtu or .pvtp, in its order, absolute if `file` is. Throws PipelineError.
[[nodiscard]] std::vector<std::filesystem::path> read_summary(const std::filesystem::path& file);

/// Throws PipelineError when the file cannot be read.
[[nodiscard]] vtkSmartPointer<vtkDataObject> read_piece(const std::filesystem::path& file);

}  // namespace breccia::insitu
