#include "domains/model_fields.hpp"

#include <array>
#include <span>
#include <type_traits>
#include <vector>

namespace breccia {
namespace {

/// Adds up numbers of all fields in one reduction: `add` them in any order, `sum`, then `take` them in the same order.
class Sums {
 public:
  void add(std::int64_t count) { words_.push_back(count); }
  void add(const ExactSum& part) {
    for (const std::int64_t word : part.words()) words_.push_back(word);
  }
  void sum(const Communicator& communicator) { communicator.sum(words_); }
  void take(std::int64_t& count) { count = words_[next_++]; }
  void take(ExactSum& whole) {
    whole =
        ExactSum::from_words(std::span<const std::int64_t, ExactSum::kWords>(words_.data() + next_, ExactSum::kWords));
    next_ += ExactSum::kWords;
  }

 private:
  std::vector<std::int64_t> words_;
  std::size_t next_ = 0;
};

template <class T>
constexpr bool can_be_summed = std::is_same_v<T, std::int64_t> || std::is_same_v<T, ExactSum>;

}  // namespace

State whole_fields(const Communicator& communicator, const State& part) {
  State whole;
  copy_model_fields(part, whole);
  if (communicator.size() == 1) return whole;
  Sums sums;
  const auto for_each_sum = [&](const auto& visit) {
    for_each_field(whole, [&](const auto& row, auto& field) {
      if constexpr (can_be_summed<std::decay_t<decltype(field)>>) {
        if (row.use.across == AcrossRanks::sum) visit(field);
      }
    });
  };
  for_each_sum([&](const auto& field) { sums.add(field); });
  sums.sum(communicator);
  for_each_sum([&](auto& field) { sums.take(field); });
  for_each_field(whole, [&](const auto& row, auto& field) {
    using Value = std::decay_t<decltype(field)>;
    if constexpr (std::is_same_v<Value, double>) {
      if (row.use.across == AcrossRanks::largest) field = communicator.max(field);
    } else if constexpr (std::is_same_v<Value, std::vector<GlobalId>>) {
      const auto parts = communicator.all_gather(std::span<const GlobalId>(field));
      field.clear();
      for (const auto& of_rank : parts) field.insert(field.end(), of_rank.begin(), of_rank.end());
    }
  });
  return whole;
}

State part_of_whole(const State& whole, bool root) {
  State part;
  copy_model_fields(whole, part);
  if (root) return part;
  for_each_field(part, [](const auto& row, auto& field) {
    if (row.use.across == AcrossRanks::sum || row.use.across == AcrossRanks::list) field = {};
  });
  return part;
}

}  // namespace breccia
