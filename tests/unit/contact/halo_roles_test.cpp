#include "contact/halo_roles.hpp"

#include <gtest/gtest.h>

#include <random>

namespace breccia::halo_roles_test {
namespace {

std::vector<Extent> random_boxes(std::mt19937_64& random, std::size_t number) {
  std::uniform_real_distribution<double> place(0, 10), size(0.1, 0.6);
  std::vector<Extent> boxes(number);
  for (Extent& box : boxes) {
    const Vec3 lower(place(random), place(random), place(random));
    box.add(lower);
    box.add(Vec3(lower + Vec3(size(random), size(random), size(random))));
  }
  return boxes;
}

TEST(HaloRoles, AreNeverLessThanTheDistanceToEvaluatedElementsAsksFor) {
  constexpr double kBuffer = 0.4;
  std::mt19937_64 random(5);
  std::bernoulli_distribution chosen(0.05);
  const std::vector<Extent> boxes = random_boxes(random, 800);
  ContactState contact;
  contact.relevant.assign(boxes.size(), 0);
  for (std::uint8_t& evaluated : contact.relevant) evaluated = chosen(random) ? 1 : 0;
  std::vector<HaloRole> roles;
  find_halo_roles(contact, boxes, kBuffer, 0.5, roles);
  std::array<int, 3> number{};
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    ++number[static_cast<std::size_t>(roles[i])];
    if (contact.relevant[i] != 0) {
      EXPECT_EQ(roles[i], HaloRole::none) << "an evaluated element is searched anyway";
      continue;
    }
    for (std::size_t j = 0; j < boxes.size(); ++j) {
      if (contact.relevant[j] == 0) continue;
      if (boxes[i].near(boxes[j], kBuffer)) {
        EXPECT_EQ(roles[i], HaloRole::contactor_and_points);
      } else if (boxes[i].near(boxes[j], 2 * kBuffer)) {
        EXPECT_NE(roles[i], HaloRole::none);
      }
    }
  }
  for (const int of_role : number) EXPECT_GT(of_role, 40) << "the test tells them apart";
}

TEST(HaloRoles, AreNoneForElementsWhosePositionIsNotKnown) {
  ContactState contact;
  contact.relevant = {1, 0};
  std::vector<Extent> boxes(2);
  boxes[0].add(Vec3(0, 0, 0));
  std::vector<HaloRole> roles;
  find_halo_roles(contact, boxes, 1.0, 1.0, roles);
  EXPECT_EQ(roles[1], HaloRole::none);
}

}  // namespace
}  // namespace breccia::halo_roles_test
