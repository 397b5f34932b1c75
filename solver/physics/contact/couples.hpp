#pragma once

#include <vector>

#include "physics/contact/params.hpp"
#include "physics/contact/state.hpp"

namespace breccia {

/// Sets the contactors and everything that is stored for each of them. @param slots  by ascending global element id
void set_contactors(const LocalMesh& local, std::vector<Index> slots, ContactState& contact);

/// Appends the points of a face, one after the other. Call `sort_points` after the last face.
void add_face_points(const ContactParams& params, const LocalMesh& local, Index slot, int face, ContactState& contact);

/// Brings the points that have been appended into `order`. O(n log(points)) for n of them, and a move of `order`.
void sort_points(ContactState& contact);

/// Makes `couples` ready for contact_forces after they have been replaced. @pre sorted (ContactState::before).
/// O(couples).
void couples_replaced(ContactState& contact);

/// Lists the couples that may come to matter while `travel` grows by `ahead`, m. O(points + couples of those awake).
void wake_couples(double ahead, ContactState& contact);
/// Ends that list; what is known of its couples is put back. O(couples awake).
void put_awake_back(ContactState& contact);

/// Merges couples made by fracture, which are not there yet, and lists them as fresh.
/// @param made  sorted (ContactState::before), unique. O(couples), and O(n log(couples)) for n of them.
void add_fresh_couples(const std::vector<ContactCouple>& made, ContactState& contact);

}  // namespace breccia
