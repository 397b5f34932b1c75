#include <gtest/gtest.h>

#include <string>

#include "physics/material/bulk_law.hpp"
#include "physics/material/drucker_prager.hpp"
#include "unit/physics/material/material_point.hpp"

namespace breccia::bulk_law_test {
namespace {

using test::same_plastic_state;

TEST(BulkLaw, RemembersTheFieldsOfItsTableAndNoMore) {
  EXPECT_EQ(memory_size(BulkLaw::neo_hookean), 0U);
  EXPECT_EQ(memory_size(BulkLaw::green_st_venant), 0U);
  EXPECT_EQ(memory_size(BulkLaw::drucker_prager), material::kDruckerPragerMemory);
  material::DruckerPragerMemory memory;
  const auto place = static_cast<std::size_t>(plastic_work_place(BulkLaw::drucker_prager));
  EXPECT_EQ(&memory.inverse_plastic[0] + place, &memory.plastic_work);
  ASSERT_LT(place, material::kDruckerPragerMemory);
  EXPECT_STREQ(memory_fields(BulkLaw::drucker_prager).back().name, "plastic_work");
  EXPECT_EQ(plastic_work_place(BulkLaw::neo_hookean), -1);
}

TEST(BulkLaw, EvaluatedByItselfLeavesTheMemoryAsItIs) {
  test::MaterialPoint point(make_drucker_prager(0.5, 0.2, 1e6));
  point.go_to(Vec3(0.999, 1, 1).asDiagonal());
  const test::MaterialPoint before = point;
  const Mat3 further = Vec3(0.998, 1, 1).asDiagonal();
  const Mat3 asked = test::matrix(bulk_piola(point.params, test::tensor(further), point.numbers()));
  EXPECT_TRUE(same_plastic_state(point.memory, before.memory));
  point.go_to(further);
  EXPECT_EQ(asked, point.piola);
  EXPECT_EQ(stored_energy(point.params, test::tensor(further), point.numbers()), point.stored());
  EXPECT_FALSE(same_plastic_state(point.memory, before.memory));
}

TEST(BulkLaw, HasAMemoryWhenItHasFields) {
  for (const BulkLaw law : {BulkLaw::neo_hookean, BulkLaw::green_st_venant, BulkLaw::drucker_prager}) {
    EXPECT_EQ(has_memory(law), memory_size(law) > 0);
    EXPECT_LE(memory_size(law), kLargestMemory);
  }
}

TEST(MaterialMemory, OfAModelWithoutAnyIsVirgin) {
  const MaterialMemory none;
  for (std::size_t i = 0; i < material::kDruckerPragerMemory; ++i) EXPECT_EQ(none.of(17)[i], 0.0);
  const std::array<double, 6> numbers{0, 1, 2, 3, 4, 5};
  EXPECT_EQ(*MaterialMemory({numbers.data(), 2}).of(2), 4.0);
}

}  // namespace
}  // namespace breccia::bulk_law_test
