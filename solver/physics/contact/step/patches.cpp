#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "base/index.hpp"
#include "mesh/tetrahedron.hpp"
#include "physics/contact/geometry/point.hpp"
#include "physics/contact/step/contact_step.hpp"
#include "physics/contact/step/elements.hpp"

namespace breccia {
namespace {

using Patch = ContactPatch;

/// Finds patches of a list by their keys: their places hashed, each in the first free cell of the table.
class PatchIndex {
 public:
  explicit PatchIndex(std::vector<Patch>& list) : list_(list) { resize(2 * list.size() + 64); }

  /// The one with the key of `patch`, which is added if there is none.
  Index place_of(const Patch& patch) {
    std::size_t cell = hash(patch) & mask_;
    for (; table_[cell] >= 0; cell = (cell + 1) & mask_) {
      if (list_[at(table_[cell])].key() == patch.key()) return table_[cell];
    }
    const auto place = static_cast<Index>(list_.size());
    table_[cell] = place;
    list_.push_back(patch);
    if (2 * list_.size() > table_.size()) resize(2 * table_.size());
    return place;
  }

 private:
  static std::size_t hash(const Patch& patch) {
    std::uint64_t sum = 0;
    const auto add = [&](std::int64_t part) {
      sum = (sum ^ static_cast<std::uint64_t>(part)) * 0x9e3779b97f4a7c15ULL;
      sum ^= sum >> 29;
    };
    std::apply([&](auto... parts) { (add(parts), ...); }, patch.key());
    return sum;
  }

  void resize(std::size_t cells) {
    std::size_t power = 64;
    while (power < cells) power *= 2;
    mask_ = power - 1;
    table_.assign(power, -1);
    for (std::size_t i = 0; i < list_.size(); ++i) {
      std::size_t cell = hash(list_[i]) & mask_;
      while (table_[cell] >= 0) cell = (cell + 1) & mask_;
      table_[cell] = static_cast<Index>(i);
    }
  }

  std::vector<Patch>& list_;
  std::vector<Index> table_;  ///< -1: free
  std::size_t mask_ = 0;
};

/// Boxes around the three nodes of a face.
void raise_box(const double* field, const std::array<Index, 3>& nodes, std::size_t first, Patch& patch) {
  std::array<const double*, 3> x;
  for (std::size_t i = 0; i < 3; ++i) x[i] = field + nodal(nodes[i], 0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double a = x[0][axis * kLanes], b = x[1][axis * kLanes], c = x[2][axis * kLanes];
    patch.raise(first + axis, -std::min(std::min(a, b), c));
    patch.raise(first + 3 + axis, std::max(std::max(a, b), c));
  }
}

/// Makes patches of faces, one after the other.
class PatchMaker {
 public:
  PatchMaker(const ContactStepModel& model, const Field<double>& position, const Field<double>& velocity,
             double coarsening, ContactPatches& patches)
      : model_(model),
        position_(position),
        velocity_(velocity),
        coarsening_(coarsening),
        patches_(patches),
        index_(patches.list) {
    const FaceRule& rule = face_rule(model.params.points_per_face);
    largest_share_ = *std::max_element(rule.share.begin(), rule.share.begin() + rule.num_points);
    key_.largest.fill(-std::numeric_limits<double>::infinity());
  }

  void add(const ContactElements::Entry& entry) {
    const LocalMesh& mesh = model_.mesh;
    key_.group = mesh.block_group[at(entry.slot / kLanes)];
    key_.body = mesh.slot_body[at(entry.slot)];
    const double per_length = 1.0 / model_.body_length[at(mesh.slot_body[at(entry.slot)])];
    for_each_face(entry.cause.open, [&](int face) { add_face(entry, face, per_length); });
  }

 private:
  void add_face(const ContactElements::Entry& entry, int face, double per_length) {
    const ContactElement& element = entry.element;
    const auto& corners = kFaceCorners[at(face)];
    std::array<Index, 3> nodes;
    for (std::size_t i = 0; i < 3; ++i) nodes[i] = model_.mesh.corner_node(entry.slot, corners[i]);
    set_cell(element.longest[at(face)], nodes);
    const Index place = index_.place_of(key_);
    patches_.place[at(4 * entry.slot + face)] = place;
    Patch& patch = patches_.list[at(place)];
    raise_box(position_.data(), nodes, Patch::box, patch);
    raise_box(model_.mesh.reference.data(), nodes, Patch::reference_box, patch);
    raise_box(velocity_.data(), nodes, Patch::velocity, patch);
    for (const int c : corners) {
      patch.raise(Patch::area_over_mass, element.area_over_mass[at(c)]);
      patch.raise(Patch::per_mass, element.per_mass[at(c)]);
    }
    const auto marked = [&](const std::vector<std::uint8_t>& bits) { return (bits[at(entry.slot)] >> face & 1) != 0; };
    patch.raise(Patch::steepness, element.steepness[at(face)]);
    patch.raise(Patch::weight, marked(model_.faces.pointed) ? largest_share_ * element.area[at(face)] : 0.0);
    patch.raise(Patch::per_length, per_length);
    patch.raise(Patch::torn, marked(model_.faces.torn) ? 1.0 : 0.0);
  }

  void set_cell(double longest, const std::array<Index, 3>& nodes) {
    const std::int64_t level = std::ilogb(longest);
    if (level != key_.level || edges_ == 0) {
      key_.level = level;
      const double edge = kCellSizes * coarsening_ * key_.face_size();
      edges_ = 3.0 * edge;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double sum = 0;
      for (const Index n : nodes) sum += position_[nodal(n, static_cast<int>(axis))];
      key_.cell[axis] = static_cast<std::int64_t>(std::floor(sum / edges_));
    }
  }

  const ContactStepModel& model_;
  const Field<double>&position_, &velocity_;
  double coarsening_, largest_share_ = 0;
  ContactPatches& patches_;
  PatchIndex index_;
  Patch key_;         ///< of the face at hand, without numbers
  double edges_ = 0;  ///< m, three edges of a cell of its level
};

}  // namespace

void ContactPatches::sort() {
  std::vector<Index> order(list.size()), moved(order.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](Index i, Index k) { return list[at(i)].key() < list[at(k)].key(); });
  std::vector<Patch> sorted;
  sorted.reserve(order.size());
  for (const Index i : order) {
    moved[at(i)] = static_cast<Index>(sorted.size());
    sorted.push_back(list[at(i)]);
  }
  list = std::move(sorted);
  for (Index& i : place) i = i < 0 ? -1 : moved[at(i)];
}

void ContactPatches::merge(const std::vector<std::vector<ContactPatch>>& of_all) {
  PatchIndex index(list);
  for (const std::vector<ContactPatch>& of_rank : of_all) {
    for (const Patch& patch : of_rank) list[at(index.place_of(patch))].raise_all(patch);
  }
}

ContactPatches contact_patches(const ContactStepModel& model, const ContactElements& elements,
                               const Field<double>& position, const Field<double>& velocity, double coarsening) {
  ContactPatches patches;
  patches.place.assign(4 * at(model.mesh.num_slots), -1);
  PatchMaker maker(model, position, velocity, coarsening, patches);
  for (const ContactElements::Entry& entry : elements.list()) maker.add(entry);
  return patches;
}

ContactPatches contact_patches(const ContactStepModel& model, const ContactElements& elements,
                               const Field<double>& position, const Field<double>& velocity, double coarsening,
                               std::span<const Index> slots) {
  ContactPatches patches;
  patches.place.assign(4 * at(model.mesh.num_slots), -1);
  PatchMaker maker(model, position, velocity, coarsening, patches);
  for (const Index slot : slots) maker.add(elements.entry(slot));
  return patches;
}

}  // namespace breccia
