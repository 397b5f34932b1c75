#include "catalyst/gathered_instant.hpp"

#include <climits>
#include <cstring>
#include <numeric>

#include "catalyst/channel_names.hpp"

namespace breccia::insitu {
namespace {

/// Corners of all cells; those of cells with own points in turn are 0, 1, 2, ...
std::vector<std::int32_t> corners_in(const BrecciaGrid& grid) {
  std::vector<std::int32_t> corners(static_cast<std::size_t>(grid.num_cells * corners_of(grid.cell)));
  if (grid.corners == nullptr) {
    std::iota(corners.begin(), corners.end(), 0);
  } else {
    std::copy_n(grid.corners, corners.size(), corners.begin());
  }
  return corners;
}

template <class T>
std::vector<T> values_of(const std::vector<std::byte>& bytes) {
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

}  // namespace

const BrecciaInstant& GatheredInstant::of(const BrecciaInstant& mine) {
  instant_ = mine;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    if (mine.channels[i] == nullptr) continue;
    gather(*mine.channels[i], channels_[i]);
    instant_.channels[i] = &channels_[i].grid;
  }
  return instant_;
}

void GatheredInstant::gather(const BrecciaGrid& mine, Channel& out) const {
  out.grid = mine;
  const std::vector<std::int64_t> cells = ranks_.gathered(mine.num_cells), points = ranks_.gathered(mine.num_points);
  out.values.clear();
  std::vector<std::byte> bytes;
  gather_bytes(mine.points, 3 * sizeof(double), points, bytes);
  out.points = values_of<double>(bytes);
  if (mine.cell != BRECCIA_TABLE) {
    const auto width = static_cast<std::size_t>(corners_of(mine.cell));
    bytes.clear();
    gather_bytes(corners_in(mine).data(), width * sizeof(std::int32_t), cells, bytes);
    out.corners = values_of<std::int32_t>(bytes);
    std::size_t corner = 0;
    std::int64_t before = 0;
    for (std::size_t rank = 0; rank < cells.size() && !out.corners.empty(); before += points[rank++]) {
      for (const std::size_t end = corner + static_cast<std::size_t>(cells[rank]) * width; corner < end; ++corner)
        out.corners[corner] += static_cast<std::int32_t>(before);
    }
  }
  gather_arrays(mine.arrays, mine.num_arrays, cells, out.arrays, out.values);
  gather_arrays(mine.point_arrays, mine.num_point_arrays, points, out.point_arrays, out.values);
  std::size_t next = 0;
  for (BrecciaArray& array : out.arrays) array.values = out.values[next++].data();
  for (BrecciaArray& array : out.point_arrays) array.values = out.values[next++].data();
  const bool here = ranks_.is_root();
  out.grid.num_cells = here ? std::accumulate(cells.begin(), cells.end(), std::int64_t{0}) : 0;
  out.grid.num_points = here ? std::accumulate(points.begin(), points.end(), std::int64_t{0}) : 0;
  out.grid.points = out.points.data();
  out.grid.corners = mine.cell == BRECCIA_TABLE ? nullptr : out.corners.data();
  std::uint64_t topology = 0;
  for (const std::int64_t of_rank : ranks_.gathered(static_cast<std::int64_t>(mine.topology)))
    topology = 31 * topology + static_cast<std::uint64_t>(of_rank);
  out.grid.topology = topology;
  out.grid.arrays = out.arrays.data();
  out.grid.point_arrays = out.point_arrays.data();
}

void GatheredInstant::gather_arrays(const BrecciaArray* arrays, std::int32_t count,
                                    const std::vector<std::int64_t>& entries, std::vector<BrecciaArray>& out,
                                    std::vector<std::vector<std::byte>>& values) const {
  out.assign(arrays, arrays + count);
  for (const BrecciaArray& array : out) gather_bytes(array.values, bytes_of(array), entries, values.emplace_back());
}

void GatheredInstant::gather_bytes(const void* mine, std::size_t size, const std::vector<std::int64_t>& counts,
                                   std::vector<std::byte>& all) const {
  std::vector<int> bytes, begins;
  std::int64_t sum = 0;
  for (const std::int64_t count : counts) {
    begins.push_back(static_cast<int>(sum));
    sum += count * static_cast<std::int64_t>(size);
    if (sum > INT_MAX) throw PipelineError("has more than 2 GiB of values in an array: too much to draw on one rank");
    bytes.push_back(static_cast<int>(sum) - begins.back());
  }
  all.resize(ranks_.is_root() ? static_cast<std::size_t>(sum) : 0);
  MPI_Gatherv(mine, bytes[static_cast<std::size_t>(ranks_.rank())], MPI_BYTE, all.data(), bytes.data(), begins.data(),
              MPI_BYTE, 0, ranks_.communicator());
}

}  // namespace breccia::insitu
