#include "catalyst/synthetic.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace breccia::test {
namespace {

constexpr std::size_t kBytesPerElement = 1500;  // all channels of an element, with room
constexpr std::size_t kBytesBesides = 1 << 20;

// Arrays by channel: name and, for doubles, components; 0 stands for i64, -1 for i32.
using Arrays = std::vector<std::pair<const char*, int>>;
const Arrays kElementArrays{{"id", 0},       {"body", -1},        {"material", -1}, {"rank", -1},
                            {"fragment", 0}, {"stress", 6},       {"von_mises", 1}, {"principal", 3},
                            {"velocity", 3}, {"displacement", 3}, {"cost", 1}};
const Arrays kJointArrays{{"id", 0},    {"damage", 1}, {"opening", 1}, {"slip", 1}, {"time_of_failure", 1},
                          {"mode", -1}, {"state", -1}, {"broken", -1}};
const Arrays kContactArrays{{"id", 0},    {"normal_force", 3}, {"tangential_force", 3},
                            {"force", 3}, {"body", -1},        {"other_body", -1}};
const Arrays kDomainArrays{{"rank", -1}, {"elements", 0}, {"joints", 0}, {"couples", 0}, {"load", 1}};
const Arrays kHistoryArrays{{"step", 0}, {"time [s]", 1}, {"kinetic [J]", 1}, {"broken joints", 0}};

int corners_of(std::int32_t cell) {
  switch (cell) {
    case BRECCIA_VERTEX:
      return 1;
    case BRECCIA_TRIANGLE:
      return 3;
    case BRECCIA_TETRAHEDRON:
      return 4;
    case BRECCIA_HEXAHEDRON:
      return 8;
    default:
      return 0;
  }
}

}  // namespace

GuardedMemory::GuardedMemory(std::size_t bytes)
    : begin_(static_cast<char*>(mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0))),
      size_(bytes) {
  if (begin_ == MAP_FAILED) throw std::runtime_error("no memory");
}

GuardedMemory::~GuardedMemory() { munmap(begin_, size_); }

void* GuardedMemory::take(std::size_t bytes) {
  if (bytes == 0) return nullptr;
  void* const pointer = begin_ + used_;
  used_ += (bytes + 63) / 64 * 64;
  if (used_ > size_) throw std::runtime_error("the synthetic run needs more memory than it was given");
  return pointer;
}

void GuardedMemory::take_away() const { mprotect(begin_, size_, PROT_NONE); }
void GuardedMemory::give_back() const { mprotect(begin_, size_, PROT_READ | PROT_WRITE); }

SyntheticRun::SyntheticRun(int side, int rank, int size, int without_cells)
    : side_(side),
      elements_(6LL * side * side * side),
      rank_(rank),
      size_(size),
      without_cells_(without_cells),
      memory_(kBytesPerElement * static_cast<std::size_t>(elements_) + kBytesBesides),
      channels_(BRECCIA_NUM_CHANNELS) {
  Arrays surface = kElementArrays;
  surface.emplace_back("face", -1);
  const std::int64_t share = elements_;
  prepare(BRECCIA_ELEMENTS, share, BRECCIA_TETRAHEDRON, kElementArrays);
  prepare(BRECCIA_JOINTS, share / 10, BRECCIA_TRIANGLE, kJointArrays);
  prepare(BRECCIA_FRACTURES, share / 20, BRECCIA_TRIANGLE, kJointArrays);
  prepare(BRECCIA_CONTACTS, share / 20, BRECCIA_VERTEX, kContactArrays);
  prepare(BRECCIA_SURFACE, share / 6, BRECCIA_TRIANGLE, surface);
  prepare(BRECCIA_DOMAINS, 1, BRECCIA_HEXAHEDRON, kDomainArrays);
  prepare(BRECCIA_HISTORY, 1, BRECCIA_TABLE, kHistoryArrays);
}

void SyntheticRun::prepare(int channel, std::int64_t capacity, std::int32_t cell, const Arrays& arrays) {
  Channel& to = channels_[static_cast<std::size_t>(channel)];
  to.capacity = capacity;
  to.grid.cell = cell;
  const auto cells = static_cast<std::size_t>(capacity);
  to.points =
      static_cast<double*>(memory_.take(cells * static_cast<std::size_t>(corners_of(cell)) * 3 * sizeof(double)));
  for (const auto& [name, kind] : arrays) {
    const auto components = static_cast<std::size_t>(std::max(kind, 1));
    to.reals.push_back(kind > 0 ? static_cast<double*>(memory_.take(cells * components * sizeof(double))) : nullptr);
    to.longs.push_back(kind == 0 ? static_cast<std::int64_t*>(memory_.take(cells * sizeof(std::int64_t))) : nullptr);
    to.shorts.push_back(kind < 0 ? static_cast<std::int32_t*>(memory_.take(cells * sizeof(std::int32_t))) : nullptr);
    to.arrays.push_back({name,
                         kind > 0    ? BRECCIA_F64
                         : kind == 0 ? BRECCIA_I64
                                     : BRECCIA_I32,
                         static_cast<std::int32_t>(components), nullptr});
  }
}

double SyntheticRun::expected_f64(const std::string& array, int component, std::int64_t cell, std::int64_t step) {
  if (array == "time [s]") return time_of(step);
  const double phase = static_cast<double>(array.size()) + 0.1 * component + 1e-3 * static_cast<double>(cell);
  return std::sin(phase + 0.01 * static_cast<double>(step)) / 3.0;
}

std::int64_t SyntheticRun::expected_integer(const std::string& array, std::int64_t cell, std::int64_t step) {
  if (array == "id") return cell;
  if (array == "step") return step;
  return (cell * 7 + step + static_cast<std::int64_t>(array.size())) % 1000;
}

std::int64_t SyntheticRun::total(int channel, std::int64_t step) const {
  switch (channel) {
    case BRECCIA_ELEMENTS:
      return elements_;
    case BRECCIA_JOINTS:
      return std::min(elements_ / 10, step * 7);
    case BRECCIA_FRACTURES:
      return step * 3 % (elements_ / 20 + 1);  // changes as long as a run goes
    case BRECCIA_CONTACTS:
      return std::min(elements_ / 20, step * 2);
    case BRECCIA_SURFACE:
      return elements_ / 6;
    case BRECCIA_DOMAINS:
      return size_;
    default:
      return 1;
  }
}

SyntheticRun::Share SyntheticRun::share(int channel, std::int64_t step) const {
  const std::int64_t cells = total(channel, step);
  if (channel == BRECCIA_DOMAINS) return {rank_, rank_ + 1};
  if (channel == BRECCIA_HISTORY) return {0, rank_ == 0 ? 1 : 0};
  if (rank_ == without_cells_) return {0, 0};
  const int owners = size_ - (without_cells_ >= 0 ? 1 : 0);
  const int turn = rank_ - (without_cells_ >= 0 && rank_ > without_cells_ ? 1 : 0);
  return {cells * turn / owners, cells * (turn + 1) / owners};
}

void SyntheticRun::fill(int channel, std::int64_t step) {
  Channel& to = channels_[static_cast<std::size_t>(channel)];
  const Share mine = share(channel, step);
  const std::int64_t cells = mine.end - mine.first;
  const int corners = corners_of(to.grid.cell);
  to.grid.num_cells = cells;
  to.grid.num_points = cells * corners;
  to.grid.points = to.points;
  to.grid.topology = static_cast<std::uint64_t>(cells) + 1;
  for (std::int64_t cell = 0; cell < cells; ++cell) {
    for (int corner = 0; corner < corners; ++corner)
      put_point(channel, mine.first + cell, corner, step, to.points + 3 * (cell * corners + corner));
  }
  for (std::size_t i = 0; i < to.arrays.size(); ++i) {
    BrecciaArray& array = to.arrays[i];
    for (std::int64_t cell = 0; cell < cells; ++cell) {
      const std::int64_t id = mine.first + cell;
      if (to.longs[i] != nullptr) to.longs[i][cell] = expected_integer(array.name, id, step);
      if (to.shorts[i] != nullptr)
        to.shorts[i][cell] = static_cast<std::int32_t>(expected_integer(array.name, id, step));
      for (int c = 0; to.reals[i] != nullptr && c < array.components; ++c)
        to.reals[i][cell * array.components + c] = expected_f64(array.name, c, id, step);
    }
    array.values = to.reals[i] != nullptr   ? static_cast<void*>(to.reals[i])
                   : to.longs[i] != nullptr ? static_cast<void*>(to.longs[i])
                                            : static_cast<void*>(to.shorts[i]);
    if (cells == 0) array.values = nullptr;
  }
  to.grid.num_arrays = static_cast<std::int32_t>(to.arrays.size());
  to.grid.arrays = to.arrays.data();
}

void SyntheticRun::put_point(int channel, std::int64_t cell, int corner, std::int64_t step, double* point) const {
  // The six tetrahedra of a cube are the paths from its corner 0 to its corner 7 along edges.
  static constexpr int kPaths[6][4] = {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7},
                                       {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}};
  const std::int64_t element = channel == BRECCIA_SURFACE ? cell * 6 : channel == BRECCIA_DOMAINS ? 0 : cell;
  const std::int64_t cube = element / 6;
  const int box = channel == BRECCIA_DOMAINS ? corner ^ ((corner >> 1) & 1) : kPaths[element % 6][corner];
  const double size = channel == BRECCIA_DOMAINS ? static_cast<double>(side_) : 1.0;
  point[0] = static_cast<double>(cube % side_) + size * (box & 1) + 1e-4 * static_cast<double>(step);
  point[1] = static_cast<double>(cube / side_ % side_) + size * ((box >> 1) & 1);
  point[2] = static_cast<double>(cube / side_ / side_) + size * ((box >> 2) & 1) +
             (channel == BRECCIA_DOMAINS ? size * static_cast<double>(cell) : 0.0);
}

const BrecciaInstant& SyntheticRun::at(std::int64_t step, std::uint32_t channels) {
  instant_ = {};
  instant_.step = step;
  instant_.time = time_of(step);
  for (int channel = 0; channel < BRECCIA_NUM_CHANNELS; ++channel) {
    if ((channels & (1U << channel)) == 0) continue;
    fill(channel, step);
    instant_.channels[channel] = &channels_[static_cast<std::size_t>(channel)].grid;
  }
  return instant_;
}

}  // namespace breccia::test
