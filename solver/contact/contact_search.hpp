#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/extent.hpp"
#include "contact/displacement.hpp"
#include "detection/point_body/contactor_grid.hpp"
#include "detection/point_body/search.hpp"
#include "mesh/corner_clusters.hpp"
#include "mesh/topology.hpp"
#include "parallel/communicator.hpp"
#include "physics/contact/contact_forces.hpp"
#include "state/records.hpp"

namespace breccia {

/// How contact is looked for.
struct ContactSearchParams {
  detection::Algorithm algorithm = detection::Algorithm::packed_tree;
  double cell = 0;                    ///< m; 0: chosen by the algorithm
  double buffer = 0;                  ///< m; 0: chosen at every search (ContactSearch)
  bool verify = false;                ///< compare the couples that touch with brute force at every step
  std::vector<bool> breakable;        ///< (volume groups) inner faces may be freed
  bool everywhere = true;             ///< every free face carries points; false: only `faces`
  std::vector<Topology::Face> faces;  ///< faces that may carry points; one side of an inner face is enough
};

/// A face that has nothing across it any more. One side of a joint is enough.
struct FreedFace {
  Index slot;
  int face;
};

/// Largest buffer, m, that searches choose. @param asked  m, of the case; 0: chosen at every search
/// @param contactor_size  m, mean
[[nodiscard]] double largest_buffer(double asked, double contactor_size);

/// Contact of one rank: joins detection, histories and forces.
///
/// Targets are the points of free faces, contactors all elements of breakable groups and those elements of the others
/// that have a node on the free surface or on the border to another group. A couple is a pair that passes the couple
/// test of detection/point_body/search.hpp at the positions of the last full search, has a law, and is not bonded
/// around a corner (an element is bonded to itself). This definition is kept at all times: points and couples that a
/// freed face brings are found by the same test at the same positions, so a full search would find no other set.
///
/// With buffer b the set holds every pair that touches while no node has moved by more than b/2 since the search,
/// beside what all have moved together. The sum of max_speed dt bounds the largest displacement from above; only when
/// it passes b/2 the displacement itself is looked at, less what all nodes have moved together
/// (contact/displacement.hpp), and either the sum is brought down to it or a search is done. Without a buffer given
/// b is 10 % of the contactors' mean size (the edge of the regular tetrahedron of their mean volume): the number of
/// couples grows as (1 + 5 b/size)^3, and so small a buffer still lasts for hundreds of steps of a stiff material. In a
/// run so fast that it would last for less than 20 steps it is larger, up to 40 %.
class ContactSearch {
 public:
  /// @pre all arguments outlive this object; only `contact`, empty at first, changes, through this object and
  /// contact_forces. Faces broken from the start are free in `topology`.
  /// O(elements). Throws InternalError if an argument does not fit the others.
  ContactSearch(const ContactSearchParams& search, const ContactParams& params, const Mesh& mesh,
                const Topology& topology, const LocalMesh& local, ContactState& contact);

  /// Contact of a piece of the model as its records remember it. @param records  of the elements of model.mesh
  ContactSearch(const ContactSearchParams& search, const Model& model, const Records& records, ContactState& contact);

  /// Writes what contact remembers of an element into its record and the lists; elements ascending.
  void remember(Index element, ElementRecord& record, Records& records) const;

  /// Brings the couples up to date; every step, before `forces`. For a rank that is alone.
  /// @param max_speed  m/s, at least the largest speed of a node from t_(n-1) to t_n;  @param dt  s, that step
  /// Throws as `verify`.
  void update(const NodalState& state, double max_speed, double dt);

  // The same in parts, for several ranks: all search at the same time.

  /// Whether a search is due. Collective. @param step_length  m, the furthest that a node of any rank has gone in a
  /// step: the last, or the one before that after restrict_to()
  [[nodiscard]] bool due(const NodalState& state, double step_length, const Communicator& communicator);
  /// A full search. @param step_length  as for due()
  /// @param current  (num_slots) 1: at its position of now; others are further than search_reach() from what matters.
  /// Empty: all
  void search(const NodalState& state, double step_length, std::span<const std::uint8_t> current = {});
  /// How far around extent() a search will look, m.
  [[nodiscard]] double search_reach(double step_length) const { return kContactorReach * buffer_for(step_length); }
  /// Box around the elements that matter.
  [[nodiscard]] Extent extent(const Field<double>& position) const;
  /// Where the case asks for it: throws InternalError naming the pair if a pair touches and is no couple.
  void verify(const NodalState& state) const;
  [[nodiscard]] bool verifies() const { return search_.verify; }

  /// For one of several ranks, which receive each other's speeds a step late. From now on only those couples are kept
  /// whose forces, or whose point's other forces, act on elements that matter.
  /// @param relevant  (num_slots)  @pre before the first search
  void restrict_to(std::vector<std::uint8_t> relevant);
  /// Marks the slots of all points and contactors in couples. @param marks  (num_slots)
  void mark_coupled(std::vector<std::uint8_t>& marks) const;
  /// What the points of these elements touch. @param slots  ascending by element id
  [[nodiscard]] std::vector<CoupleRecord> touching_of(std::span<const Index> slots) const;
  /// Takes what other ranks know of the touch of their points. @param touching  by (element, point, contactor)
  void adopt(std::span<const CoupleRecord> touching);

  /// Faces freed by fracture: their points, the couples they make, the couples of elements no longer bonded, and the
  /// change of the overlap field. Faces that are free already are passed over. Returns whether couples with elements
  /// that do not matter by themselves came about: of these, positions and what they touch have to be received from now
  /// on.
  bool release_faces(std::span<const FreedFace> faces);

  /// contact_forces on the couples at hand. @pre `update` has been called for this state
  void forces(const NodalState& state, double dt, NodalForces& forces, ContactWork& work) {
    contact_forces(*params_, *local_, state, dt, contact_, forces, work);
  }

  [[nodiscard]] const ContactState& contact() const { return contact_; }
  [[nodiscard]] const CornerClusters& clusters() const { return clusters_; }
  [[nodiscard]] double buffer() const { return buffer_; }  ///< m, of the last search
  /// Share, 0..1, of what nodes may move after the last search that they have moved. @pre there was one
  /// Collective.
  [[nodiscard]] double used_up(const NodalState& state, const Communicator& communicator) const;
  [[nodiscard]] double contactor_size() const { return size_; }              ///< m, mean
  [[nodiscard]] std::int64_t num_searches() const { return num_searches_; }  ///< full ones

 private:
  ContactSearch(const ContactSearchParams& search, const ContactParams& params, const Mesh& mesh,
                const Topology& topology, const LocalMesh& local, ContactState& contact, std::nullptr_t);
  void choose_contactors();
  void add_free_points();
  void restore_contactors(const Records& records);
  void restore_histories(const Records& records);
  void add_points_of(Index element, int face);
  [[nodiscard]] double buffer_for(double step_length) const;
  [[nodiscard]] bool may_touch(Index point, Index contactor) const;
  [[nodiscard]] bool has_law(Index slot, Index other) const;
  [[nodiscard]] detection::Corners corners_of(Index slot) const;
  void choose_searched(std::span<const std::uint8_t> current);
  void choose_foreign(std::span<const std::uint8_t> current);
  void keep_relevant();
  [[nodiscard]] TouchingCouple restored(const CoupleRecord& record) const;
  [[nodiscard]] CoupleRecord record_of(const TouchingCouple& couple, GlobalId element) const;

  void collect_sides(std::span<const FreedFace> faces);
  void note_clusters();
  void free_corners_of(const Topology::Face& side);
  void couple_new_points(std::size_t first);
  void couple_separated(std::size_t first);
  void couple_points_of(Index element, Index other, std::size_t first);
  [[nodiscard]] bool add_made();

  // In buffers: how far points in couples with elements that matter are from these at most, and what is in couples with
  // such points. A little more for round-off.
  static constexpr double kPointReach = 1.01, kContactorReach = 2.02;

  ContactSearchParams search_;
  const ContactParams* params_;
  const Mesh* mesh_;
  const Topology* topology_;
  const LocalMesh* local_;
  CornerClusters clusters_;
  ContactState& contact_;
  std::unique_ptr<detection::PointBodySearch> detection_;
  detection::ContactorGrid grid_;                  ///< of the last full search, built when a face is freed
  std::vector<std::uint8_t> carries_;              ///< (elements) a bit a face: may carry points
  std::vector<std::array<Index, 4>> first_point_;  ///< (elements) of the points of a face, -1: none
  bool any_law_ = false;
  // When couples are restricted: with those that do not matter, in order; and what fracture has made since the former
  // were put together.
  std::vector<ContactCouple> all_couples_, made_since_;

  // The last full search.
  bool searched_ = false;
  bool grid_built_ = false;
  double buffer_ = 0;  ///< m
  double size_ = 0;    ///< m, mean size of a contactor
  DisplacementWatch moved_;
  std::int64_t num_searches_ = 0;
  Field<double> reference_;                  ///< nodal field, positions
  std::vector<detection::Corners> corners_;  ///< (contactors) NaN: out of reach

  // Work space.
  std::vector<Index> searched_points_, searched_contactors_;  ///< by ascending ids
  std::vector<detection::Corners> searched_corners_;
  std::vector<std::uint8_t> foreign_;  ///< (slots) choose_foreign()
  std::vector<Extent> extents_;        ///< (slots) for it
  std::vector<Vec3> positions_;
  std::vector<detection::Couple> found_;
  std::vector<ContactCouple> made_;
  std::vector<Topology::Face> sides_;
  std::vector<Index> changed_, nodes_, old_clusters_, contactors_of_point_;
};

}  // namespace breccia
