#include "output/checkpoint/checkpoint_columns.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <tuple>
#include <type_traits>
#include <utility>

#include "base/error.hpp"

namespace breccia {
namespace {

/// Numbers of a field at most.
constexpr std::size_t kMostNumbers = 64;

template <class Scalar, bool is_enum = std::is_enum_v<Scalar>>
struct StoredAs {
  using Type = std::conditional_t<std::is_same_v<Scalar, bool>, std::uint8_t,
                                  std::conditional_t<std::is_same_v<Scalar, std::uint64_t>, std::int64_t, Scalar>>;
};
template <class Scalar>
struct StoredAs<Scalar, true> {
  using Type = std::underlying_type_t<Scalar>;
};
template <class Scalar>
using Stored = typename StoredAs<std::remove_const_t<Scalar>>::Type;

template <class T>
constexpr NumberType number_type() {
  if constexpr (std::is_same_v<T, double>) return NumberType::float64;
  if constexpr (std::is_same_v<T, std::int64_t>) return NumberType::int64;
  if constexpr (std::is_same_v<T, std::int32_t>) return NumberType::int32;
  if constexpr (std::is_same_v<T, std::int8_t>) return NumberType::int8;
  static_assert(std::is_floating_point_v<T> || std::is_signed_v<T> || std::is_same_v<T, std::uint8_t>);
  return NumberType::uint8;
}

/// Type of the numbers of a field: all have the same.
template <class Field>
struct NumberOf {
  template <class T>
  static auto first(T& field) {
    if constexpr (std::is_arithmetic_v<std::remove_const_t<T>> || std::is_enum_v<std::remove_const_t<T>>) {
      return Stored<T>{};
    } else if constexpr (std::is_same_v<std::remove_const_t<T>, Vec3> ||
                         std::is_same_v<std::remove_const_t<T>, JointHistory<double>> ||
                         std::is_same_v<std::remove_const_t<T>, PairHistory<double>>) {
      return double{};
    } else {
      return first(field[0]);
    }
  }
  using Type = decltype(first(std::declval<Field&>()));
};

/// Some of the numbers of a field, as a dataset.
struct Part {
  std::string name, unit;
  std::vector<std::size_t> places;  ///< in the order of for_each_scalar
};

std::vector<Part> parts_of_numbers() {
  std::vector<Part> parts;
  std::size_t next = 0;
  for (const ElementField& field : kElementFields) {
    Part& part = parts.emplace_back(Part{field.name, field.unit, {}});
    for (std::size_t c = 0; c < field.components; ++c) part.places.push_back(next++);
  }
  return parts;
}

std::vector<Part> parts_of_joint_history() {
  std::vector<Part> parts;
  JointHistory<double> history;
  std::size_t next = 0;
  for (auto& point : history.points) {
    std::size_t k = 0;
    for_each_number(
        [&](const JointNumber& number, auto&) {
          if (k == parts.size()) parts.push_back({"point_" + std::string(number.name), std::string(number.unit), {}});
          parts[k++].places.push_back(next++);
        },
        point);
  }
  for_each_common_number(
      [&](const JointNumber& number, auto&) {
        parts.push_back({std::string(number.name), std::string(number.unit), {next++}});
      },
      history);
  return parts;
}

std::vector<Part> parts_of_pair_history() {
  std::vector<Part> parts;
  PairHistory<double> history;
  std::size_t next = 0;
  for_each_pair_number(
      [&](const PairNumber& number, auto&) {
        if (parts.empty() || parts.back().name != number.name)
          parts.push_back({std::string(number.name), std::string(number.unit), {}});
        parts.back().places.push_back(next++);
      },
      history);
  return parts;
}

template <class Record, class Row>
std::vector<Part> parts_of(const Row& row) {
  const Record record{};
  using Field = std::decay_t<decltype(row.access(record))>;
  if constexpr (std::is_same_v<Field, ElementNumbers>) return parts_of_numbers();
  if constexpr (std::is_same_v<Field, JointHistory<double>>) return parts_of_joint_history();
  if constexpr (std::is_same_v<Field, PairHistory<double>>) return parts_of_pair_history();
  Part all{row.name, row.unit, {}};
  for_each_scalar(row.access(record), [&](const auto&) { all.places.push_back(all.places.size()); });
  return {all};
}

/// A list of records whose type is forgotten, so that what is done with a column is compiled once for all of them.
struct RecordList {
  void* list;
  std::size_t record_bytes;
  std::size_t (*size)(const void* list);
  std::byte* (*records)(void* list);
};

template <class Record>
RecordList forget_type(std::vector<Record>& list) {
  return {&list, sizeof(Record), [](const void* any) { return static_cast<const std::vector<Record>*>(any)->size(); },
          [](void* any) { return reinterpret_cast<std::byte*>(static_cast<std::vector<Record>*>(any)->data()); }};
}

/// All numbers of a field, one behind the other as they are stored.
using Numbers = std::array<std::byte, kMostNumbers * sizeof(double)>;

/// A field of a record whose type is forgotten.
struct FieldAccess {
  NumberType type;
  std::size_t count;  ///< numbers
  void (*read)(const std::byte* record, Numbers& numbers);
  void (*write)(std::byte* record, const Numbers& numbers);
};

/// @tparam k  row of the table
template <std::size_t k, class Record>
auto& field_of(Record& record) {
  return std::get<k>(FieldTable<std::remove_const_t<Record>>::rows).access(record);
}

template <class Record, std::size_t k>
FieldAccess forget_type() {
  using T = typename NumberOf<std::decay_t<decltype(field_of<k>(std::declval<Record&>()))>>::Type;
  FieldAccess field{number_type<T>(), 0, nullptr, nullptr};
  const Record example{};
  for_each_scalar(field_of<k>(example), [&](const auto&) { ++field.count; });
  DEMAND(field.count <= kMostNumbers, std::get<k>(FieldTable<Record>::rows).name);
  field.read = [](const std::byte* record, Numbers& numbers) {
    std::byte* out = numbers.data();
    for_each_scalar(field_of<k>(*reinterpret_cast<const Record*>(record)), [&](const auto& x) {
      const T number = static_cast<T>(x);
      std::memcpy(out, &number, sizeof(T));
      out += sizeof(T);
    });
  };
  field.write = [](std::byte* record, const Numbers& numbers) {
    const std::byte* in = numbers.data();
    for_each_scalar(field_of<k>(*reinterpret_cast<Record*>(record)), [&](auto& x) {
      T number;
      std::memcpy(&number, in, sizeof(T));
      in += sizeof(T);
      x = static_cast<std::remove_reference_t<decltype(x)>>(number);
    });
  };
  return field;
}

/// Some of the numbers of a field in all records of a list, to read them or to write them.
class PartOfList {
 public:
  PartOfList(const RecordList& list, const FieldAccess& field, std::vector<std::size_t> places)
      : list_(list), field_(field), places_(std::move(places)), bytes_(size_of(field.type)) {}

  [[nodiscard]] bool is_zero() const {
    Numbers numbers;
    for (std::size_t i = 0; i < size(); ++i) {
      field_.read(record(i), numbers);
      for (const std::size_t place : places_) {
        const auto first = numbers.begin() + static_cast<std::ptrdiff_t>(place * bytes_);
        const auto last = first + static_cast<std::ptrdiff_t>(bytes_);
        if (std::any_of(first, last, [](std::byte b) { return b != std::byte{}; })) return false;
      }
    }
    return true;
  }
  void pack(std::vector<std::byte>& bytes) const {
    bytes.resize(size() * places_.size() * bytes_);
    Numbers numbers;
    std::byte* out = bytes.data();
    for (std::size_t i = 0; i < size(); ++i) {
      field_.read(record(i), numbers);
      for (const std::size_t place : places_) {
        std::memcpy(out, numbers.data() + place * bytes_, bytes_);
        out += bytes_;
      }
    }
  }
  void unpack(std::span<const std::byte> bytes, std::size_t first) const {
    Numbers numbers;
    const std::byte* in = bytes.data();
    for (std::size_t i = first; in != bytes.data() + bytes.size(); ++i) {
      field_.read(record(i), numbers);  // the others stay
      for (const std::size_t place : places_) {
        std::memcpy(numbers.data() + place * bytes_, in, bytes_);
        in += bytes_;
      }
      field_.write(record(i), numbers);
    }
  }

 private:
  [[nodiscard]] std::size_t size() const { return list_.size(list_.list); }
  [[nodiscard]] std::byte* record(std::size_t i) const { return list_.records(list_.list) + i * list_.record_bytes; }

  RecordList list_;
  FieldAccess field_;
  std::vector<std::size_t> places_;
  std::size_t bytes_;  ///< of a number
};

CheckpointColumn column_of_list(const char* group, const RecordList& list, const FieldAccess& field, const Part& part) {
  CheckpointColumn column{
      group, part.name, part.unit, field.type, static_cast<int>(part.places.size()), list.size(list.list),
      true,  {},        {},        {}};
  const PartOfList numbers(list, field, part.places);
  column.is_zero = [numbers] { return numbers.is_zero(); };
  column.pack = [numbers](std::vector<std::byte>& bytes) { numbers.pack(bytes); };
  column.unpack = [numbers](std::span<const std::byte> bytes, std::size_t first) { numbers.unpack(bytes, first); };
  return column;
}

template <class T>
std::vector<std::byte> bytes_of(std::span<const T> numbers) {
  const auto bytes = std::as_bytes(numbers);
  return {bytes.begin(), bytes.end()};
}
template <class T>
std::vector<T> numbers_of(std::span<const std::byte> bytes) {
  std::vector<T> numbers(bytes.size() / sizeof(T));
  if (!numbers.empty()) std::memcpy(static_cast<void*>(numbers.data()), bytes.data(), numbers.size() * sizeof(T));
  return numbers;
}

/// A field of a single record: one row with all its numbers, or, of a list, a row for each of its entries.
template <class Field>
CheckpointColumn column_of_field(const char* group, const char* name, const char* unit, Field& field) {
  CheckpointColumn column{group, name, unit, NumberType::int64, 1, 1, false, [] { return false; }, {}, {}};
  if constexpr (std::is_same_v<Field, ExactSum>) {
    column.components = static_cast<int>(ExactSum::kWords);
    column.pack = [&field](auto& bytes) { bytes = bytes_of<std::int64_t>(field.words()); };
    column.unpack = [&field](auto bytes, std::size_t) {
      const auto words = numbers_of<std::int64_t>(bytes);
      field = ExactSum::from_words(std::span<const std::int64_t, ExactSum::kWords>(words.data(), ExactSum::kWords));
    };
  } else if constexpr (std::is_same_v<Field, std::vector<GlobalId>> || std::is_same_v<Field, std::vector<double>>) {
    using T = typename Field::value_type;
    column.type = number_type<T>();
    column.rows = field.size();
    column.pack = [&field](auto& bytes) { bytes = bytes_of<T>(field); };
    column.unpack = [&field](auto bytes, std::size_t) { field = numbers_of<T>(bytes); };
  } else {
    using T = typename NumberOf<Field>::Type;
    column.type = number_type<T>();
    column.components = 0;
    for_each_scalar(field, [&](auto&) { ++column.components; });
    column.pack = [&field](auto& bytes) {
      std::vector<T> numbers;
      for_each_scalar(field, [&](const auto& x) { numbers.push_back(static_cast<T>(x)); });
      bytes = bytes_of<T>(numbers);
    };
    column.unpack = [&field](auto bytes, std::size_t) {
      std::size_t next = 0;
      const std::vector<T> numbers = numbers_of<T>(bytes);
      for_each_scalar(field,
                      [&](auto& x) { x = static_cast<std::remove_reference_t<decltype(x)>>(numbers.at(next++)); });
    };
  }
  return column;
}

template <class Text>
CheckpointColumn column_of_text(const char* name, Text& text) {
  CheckpointColumn column{"", name, "", NumberType::uint8, 1, text.size(), false, [] { return false; }, {}, {}};
  column.pack = [&text](auto& bytes) {
    const auto all = std::as_bytes(std::span(text.data(), text.size()));
    bytes.assign(all.begin(), all.end());
  };
  column.unpack = [&text](auto bytes, std::size_t) {
    const auto numbers = numbers_of<typename Text::value_type>(bytes);
    text.assign(numbers.begin(), numbers.end());
  };
  return column;
}

template <class Record, std::size_t k>
void add_row(const char* group, const RecordList& list, std::vector<CheckpointColumn>& columns) {
  const FieldAccess field = forget_type<Record, k>();
  for (const Part& part : parts_of<Record>(std::get<k>(FieldTable<Record>::rows)))
    columns.push_back(column_of_list(group, list, field, part));
}

template <class Record>
void add_record(const char* group, Record& record, std::vector<CheckpointColumn>& columns) {
  for_each_field(record, [&](const auto& row, auto& field) {
    if (row.use.kept) columns.push_back(column_of_field(group, row.name, row.unit, field));
  });
}

}  // namespace

std::vector<CheckpointColumn> checkpoint_columns(Checkpoint& checkpoint) {
  std::vector<CheckpointColumn> columns;
  for_each_list(checkpoint.mine, [&](const char* group, auto& list) {
    using Record = typename std::decay_t<decltype(list)>::value_type;
    constexpr auto kRows = std::tuple_size_v<decltype(FieldTable<Record>::rows)>;
    [&]<std::size_t... k>(std::index_sequence<k...>) { (add_row<Record, k>(group, forget_type(list), columns), ...); }
    (std::make_index_sequence<kRows>());
  });
  add_record("model", checkpoint.model, columns);
  add_record("run", checkpoint.position, columns);
  columns.push_back(column_of_text("whole_model", checkpoint.whole_model));
  columns.push_back(column_of_text("case", checkpoint.case_text));
  columns.push_back(column_of_text("provenance", checkpoint.provenance));
  return columns;
}

std::vector<NamedLength> lengths_of_lists(const Records& records) {
  std::vector<NamedLength> lengths;
  for_each_list(records, [&](const char* name, const auto& list) { lengths.push_back({name, list.size()}); });
  return lengths;
}

void lengthen_lists(Records& records, const std::vector<std::size_t>& more) {
  std::size_t next = 0;
  for_each_list(records, [&](const char*, auto& list) { list.resize(list.size() + more[next++]); });
}

}  // namespace breccia
