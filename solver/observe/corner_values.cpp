#include "observe/corner_values.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "base/index.hpp"
#include "mesh/topology.hpp"
#include "observe/free_faces.hpp"
#include "observe/shown_memory.hpp"
#include "physics/cauchy_stress.hpp"

namespace breccia {
namespace {

constexpr std::size_t kStress = 6;

/// A corner of an element, as means at its vertex need it.
struct Corner {
  GlobalId vertex, element, node;
  std::array<GlobalId, 3> held{-1, -1, -1};  ///< elements connected across the faces at this corner; unknown of a
                                             ///< proxy's
  double mass = 0;                           ///< kg, of the element
  std::int64_t place = -1;                   ///< 4 original + corner; -1: a proxy's
};

/// Corners of originals, four an element, then those of proxies.
std::vector<Corner> corners_of(const Domain& domain) {
  const Model& model = domain.model;
  const LocalMesh& local = model.local;
  const FreeFaces free(domain);
  std::vector<Corner> corners;
  const auto add = [&](Index slot, std::int64_t original) {
    std::array<GlobalId, 4> across{-1, -1, -1, -1};
    for (int face = 0; face < 4 && original >= 0; ++face) {
      if (!free(slot, face))
        across[at(face)] = neighbour_id(model.mesh, model.topology, local.mesh_element[at(slot)], face);
    }
    for (int c = 0; c < 4; ++c) {
      Corner corner{model.mesh.node_id(local.vertex[at(slot)][at(c)]), local.element_of_slot[at(slot)],
                    local.node_id[at(local.corner_node(slot, c))]};
      for (int i = 0; i < 3; ++i) corner.held[at(i)] = across[at((c + 1 + i) % 4)];  // face c is opposite
      corner.mass = model.density[at(local.block_group[at(slot / kLanes)])] * local.volume[at(slot)];
      corner.place = original < 0 ? -1 : 4 * original + c;
      corners.push_back(corner);
    }
  };
  std::int64_t original = 0;
  for (const Index slot : local.slot_of_element) {
    if (local.is_original(slot)) add(slot, original++);
  }
  for (const Index slot : local.slot_of_element) {
    if (!local.is_original(slot)) add(slot, -1);
  }
  return corners;
}

/// What means are taken of: stress, then what the bulk laws remember; a row an original.
std::vector<double> numbers_of(const Domain& domain, const std::vector<ShownNumber>& shown) {
  const LocalMesh& local = domain.model.local;
  const double *x = domain.state.nodes.position.data(), *v = domain.state.nodes.velocity.data();
  std::vector<double> numbers;
  for (const Index slot : local.slot_of_element) {
    if (!local.is_original(slot)) continue;
    const ElasticParams& params = domain.model.elastic[at(local.block_group[at(slot / kLanes)])];
    const auto six = components(cauchy_stress(local, params, slot, x, v, material_memory(domain.state.elements)));
    numbers.insert(numbers.end(), six.begin(), six.end());
    for (const ShownNumber& number : shown) numbers.push_back(number.of(domain, slot));
  }
  return numbers;
}

/// The corners at one vertex, by ascending element, in connected parts.
class Star {
 public:
  explicit Star(std::span<const Corner* const> corners) : corners_(corners), parts_(corners.size()) {
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      for (const GlobalId other : corners_[i]->held) join_element(static_cast<Index>(i), other);
      if (corners_[i]->node >= kFirstSharedNode) join_node(static_cast<Index>(i));
    }
  }
  /// The lowest of the corner's part.
  [[nodiscard]] std::size_t root(std::size_t i) { return at(parts_.root(static_cast<Index>(i))); }

 private:
  void join_element(Index i, GlobalId element) {
    const auto found = std::lower_bound(corners_.begin(), corners_.end(), element,
                                        [](const Corner* corner, GlobalId id) { return corner->element < id; });
    if (found != corners_.end() && (*found)->element == element)
      parts_.join(i, static_cast<Index>(found - corners_.begin()));
  }
  void join_node(Index i) {
    for (Index j = 0; j < i; ++j) {
      if (corners_[at(j)]->node == corners_[at(i)]->node) return parts_.join(i, j);
    }
  }

  std::span<const Corner* const> corners_;
  DisjointSets parts_;
};

/// Calls visit(part) for every part of every star, corners by ascending element.
template <class Visit>
void for_each_part(const std::vector<Corner>& corners, Visit&& visit) {
  std::vector<const Corner*> sorted;
  sorted.reserve(corners.size());
  for (const Corner& corner : corners) sorted.push_back(&corner);
  std::sort(sorted.begin(), sorted.end(), [](const Corner* a, const Corner* b) {
    return std::pair(a->vertex, a->element) < std::pair(b->vertex, b->element);
  });
  std::vector<const Corner*> part;
  for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
    while (end < sorted.size() && sorted[end]->vertex == sorted[begin]->vertex) ++end;
    const std::span star = std::span(sorted).subspan(begin, end - begin);
    Star parts{star};
    for (std::size_t root = 0; root < star.size(); ++root) {
      if (parts.root(root) != root) continue;
      part.clear();
      for (std::size_t i = root; i < star.size(); ++i) {
        if (parts.root(i) == root) part.push_back(star[i]);
      }
      visit(part);
    }
  }
}

/// @param row  row(corner): its `width` numbers;  @param mean  out: (width)
template <class Row>
void take_mean(const std::vector<const Corner*>& part, Row&& row, std::span<double> mean) {
  const double* const first = row(*part.front());
  double mass = 0;
  std::fill(mean.begin(), mean.end(), 0.0);
  for (const Corner* corner : part) {
    const double* const values = row(*corner);
    mass += corner->mass;
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += corner->mass * (values[k] - first[k]);
  }
  for (std::size_t k = 0; k < mean.size(); ++k) mean[k] = first[k] + mean[k] / mass;
}

/// Corners whose connected part extends beyond this rank. Vertices are distributed over the ranks by their ids; each
/// rank sends its corners to those of their vertices, which return the means.
class SharedParts {
 public:
  SharedParts(const Communicator& communicator, std::size_t width)
      : communicator_(communicator), width_(width), corners_(at(communicator.size())), rows_(corners_.size()) {
    for (std::size_t rank = 0; rank < corners_.size(); ++rank)
      corners_[rank].rank = rows_[rank].rank = static_cast<int>(rank);
  }
  void add(const Corner& corner, const double* row) {
    const auto rank = static_cast<std::size_t>(corner.vertex % communicator_.size());
    corners_[rank].entries.push_back(corner);
    rows_[rank].entries.insert(rows_[rank].entries.end(), row, row + width_);
  }
  /// @param means  out: (places, width). Collective.
  void take_means(std::vector<double>& means) const {
    for (const auto& [rank, rows] : communicator_.exchange(means_here())) {
      const std::vector<Corner>& asked = corners_[static_cast<std::size_t>(rank)].entries;
      for (std::size_t i = 0; i < asked.size(); ++i)
        std::copy_n(&rows[i * width_], width_, &means[static_cast<std::size_t>(asked[i].place) * width_]);
    }
  }

 private:
  /// Of the vertices of this rank, for those who have sent corners.
  [[nodiscard]] std::vector<Communicator::ListOf<double>> means_here() const {
    const auto came = communicator_.exchange(corners_);
    auto rows = communicator_.exchange(rows_);
    std::vector<Corner> all;
    std::vector<double> numbers;
    for (std::size_t i = 0; i < came.size(); ++i) {
      all.insert(all.end(), came[i].entries.begin(), came[i].entries.end());
      numbers.insert(numbers.end(), rows[i].entries.begin(), rows[i].entries.end());
    }
    for (std::size_t i = 0; i < all.size(); ++i) all[i].place = static_cast<std::int64_t>(i);
    std::vector<double> means(numbers.size());
    const auto row = [&](const Corner& corner) { return &numbers[static_cast<std::size_t>(corner.place) * width_]; };
    for_each_part(all, [&](const std::vector<const Corner*>& part) {
      std::vector<double> mean(width_);
      take_mean(part, row, mean);
      for (const Corner* corner : part)
        std::copy(mean.begin(), mean.end(), &means[static_cast<std::size_t>(corner->place) * width_]);
    });
    std::size_t next = 0;
    for (auto& [rank, entries] : rows) {
      std::copy_n(means.begin() + static_cast<std::ptrdiff_t>(next), entries.size(), entries.begin());
      next += entries.size();
    }
    return rows;
  }

  const Communicator& communicator_;
  std::size_t width_;
  std::vector<Communicator::ListOf<Corner>> corners_;
  std::vector<Communicator::ListOf<double>> rows_;
};

/// (4 originals, width)
std::vector<double> means_of(const Domain& domain, const std::vector<double>& numbers, std::size_t width) {
  const std::vector<Corner> corners = corners_of(domain);
  const auto row = [&](const Corner& corner) { return &numbers[static_cast<std::size_t>(corner.place) / 4 * width]; };
  std::vector<double> means(4 * numbers.size()), mean(width);
  SharedParts shared(domain.exchange.communicator(), width);
  for_each_part(corners, [&](const std::vector<const Corner*>& part) {
    const bool open = std::any_of(part.begin(), part.end(), [](const Corner* corner) { return corner->place < 0; });
    if (!open) take_mean(part, row, mean);
    for (const Corner* corner : part) {
      if (corner->place < 0) continue;
      if (open) {
        shared.add(*corner, row(*corner));
      } else {
        std::copy(mean.begin(), mean.end(), &means[static_cast<std::size_t>(corner->place) * width]);
      }
    }
  });
  if (domain.exchange.communicator().size() > 1) shared.take_means(means);
  return means;
}

/// Of the elements' own nodes.
void add_motion(const Domain& domain, Frame::AtPoints& out) {
  const LocalMesh& local = domain.model.local;
  for (const Index slot : local.slot_of_element) {
    if (!local.is_original(slot)) continue;
    for (int c = 0; c < 4; ++c) {
      const Index node = local.corner_node(slot, c);
      append(out.displacement,
             Vec3(load_node(domain.state.nodes.position.data(), node) - load_node(local.reference.data(), node)));
      append(out.velocity, load_node(domain.state.nodes.velocity.data(), node));
    }
  }
}

std::vector<double> picked(const std::vector<double>& values, const std::vector<std::size_t>& places, std::size_t n) {
  std::vector<double> out;
  out.reserve(n * places.size());
  for (const std::size_t place : places)
    out.insert(out.end(), values.begin() + static_cast<std::ptrdiff_t>(n * place),
               values.begin() + static_cast<std::ptrdiff_t>(n * (place + 1)));
  return out;
}

}  // namespace

Frame::AtPoints corner_values(const Domain& domain) {
  const std::vector<ShownNumber> shown = shown_numbers(domain.model);
  const std::size_t width = kStress + shown.size();
  const std::vector<double> means = means_of(domain, numbers_of(domain, shown), width);
  Frame::AtPoints out;
  add_motion(domain, out);
  for (const ShownNumber& number : shown) out.state.push_back(Frame::StateField{number.name, 1, {}});
  for (std::size_t first = 0; first < means.size(); first += width) {
    const double* const t = &means[first];
    out.stress.insert(out.stress.end(), t, t + kStress);
    const Mat3 stress{{t[0], t[3], t[5]}, {t[3], t[1], t[4]}, {t[5], t[4], t[2]}};
    out.von_mises.push_back(von_mises(stress));
    append(out.principal, principal_stresses(stress));
    for (std::size_t i = 0; i < shown.size(); ++i) out.state[i].values.push_back(t[kStress + i]);
  }
  return out;
}

Frame::AtPoints picked(const Frame::AtPoints& values, const std::vector<std::size_t>& places) {
  Frame::AtPoints out{picked(values.displacement, places, 3), picked(values.velocity, places, 3),
                      picked(values.stress, places, 6),       picked(values.von_mises, places, 1),
                      picked(values.principal, places, 3),    {}};
  for (const Frame::StateField& field : values.state)
    out.state.push_back(
        {field.name, field.components, picked(field.values, places, static_cast<std::size_t>(field.components))});
  return out;
}

}  // namespace breccia
