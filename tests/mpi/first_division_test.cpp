#include "domains/first_division.hpp"

#include <gtest/gtest.h>

#include <map>

#include "contact/search_params.hpp"
#include "domains/state_records.hpp"
#include "mpi/world.hpp"
#include "unit/model/two_boxes.hpp"

namespace breccia::first_division_test {
namespace {

using test::world;

/// All numbers of the records of an element, by list and field.
using Numbers = std::map<std::string, std::vector<double>>;

std::map<GlobalId, Numbers> numbers_of(const Records& records) {
  std::map<GlobalId, Numbers> of_element;
  for_each_list(records, [&](const char* list, const auto& entries) {
    for (const auto& entry : entries) {
      GlobalId id = -1;
      if constexpr (std::is_same_v<std::decay_t<decltype(entry)>, ElementRecord>) {
        id = entry.id;
      } else {
        id = entry.element;
      }
      for_each_field(entry, [&](const auto& row, const auto& field) {
        for_each_scalar(field, [&](const auto& x) {
          of_element[id][std::string(list) + "." + row.name].push_back(static_cast<double>(x));
        });
      });
    }
  });
  return of_element;
}

TEST(FirstDivision, GivesEveryRankTheRecordsThatTheWholeModelWouldHave) {
  const case_::Case input = test::two_boxes_case();
  std::unique_ptr<Model> bare;
  Contactors contactors;
  if (world().is_root()) {
    bare = std::make_unique<Model>(build_bare_model(input));
    contactors = choose_contactors(bare->breakable, bare->mesh, bare->topology);
  }
  const Records mine = spread(world(), bare.get(), contactors);

  const Model model = build_model(input);
  const auto expected = numbers_of(records_of(Domain(model, search_params(input, model))));
  const auto elements = static_cast<std::int64_t>(expected.size());
  EXPECT_EQ(world().sum(static_cast<std::int64_t>(mine.elements.size())), elements);
  EXPECT_LE(static_cast<std::int64_t>(mine.elements.size()), elements / world().size() + 1);
  for (const auto& [id, numbers] : numbers_of(mine)) {
    for (const auto& [field, values] : expected.at(id)) {
      if (field.starts_with("joint.")) continue;  // start_joints()
      EXPECT_EQ(numbers.at(field), values) << "element " << id << ", " << field;
    }
  }
}

}  // namespace
}  // namespace breccia::first_division_test
