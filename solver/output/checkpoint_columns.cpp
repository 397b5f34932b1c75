#include "output/checkpoint_columns.hpp"

#include <array>
#include <cstring>
#include <type_traits>

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
                         std::is_same_v<std::remove_const_t<T>, JointHistory<double>>) {
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

std::vector<Part> parts_of_history() {
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

template <class Record, class Row>
std::vector<Part> parts_of(const Row& row) {
  const Record record{};
  using Field = std::decay_t<decltype(row.access(record))>;
  if constexpr (std::is_same_v<Field, ElementNumbers>) return parts_of_numbers();
  if constexpr (std::is_same_v<Field, JointHistory<double>>) return parts_of_history();
  Part all{row.name, row.unit, {}};
  for_each_scalar(row.access(record), [&](const auto&) { all.places.push_back(all.places.size()); });
  return {all};
}

/// Reads the numbers at some places of a field, or writes them.
template <class T, class Field>
void gather(const Field& field, const std::vector<std::size_t>& places, T* out) {
  std::array<T, kMostNumbers> all;
  std::size_t count = 0;
  for_each_scalar(field, [&](const auto& x) { all.at(count++) = static_cast<T>(x); });
  for (const std::size_t place : places) *out++ = all[place];
}
template <class T, class Field>
void scatter(const T* in, const std::vector<std::size_t>& places, Field& field) {
  std::size_t place = 0, next = 0;
  for_each_scalar(field, [&](auto& x) {
    if (next < places.size() && places[next] == place)
      x = static_cast<std::remove_reference_t<decltype(x)>>(in[next++]);
    ++place;
  });
}

template <class Record, class Row>
CheckpointColumn column_of_list(const char* group, std::vector<Record>& list, const Row& row, const Part& part) {
  using T = typename NumberOf<std::decay_t<decltype(row.access(list[0]))>>::Type;
  const auto access = row.access;
  const std::size_t n = part.places.size();
  CheckpointColumn column{group, part.name, part.unit, number_type<T>(), static_cast<int>(n), list.size(), true,
                          {},    {},        {}};
  column.is_zero = [&list, access, places = part.places, n] {
    std::array<T, kMostNumbers> numbers;
    constexpr std::array<T, kMostNumbers> kZeros{};
    for (const Record& record : list) {
      gather(access(record), places, numbers.data());
      if (std::memcmp(numbers.data(), kZeros.data(), n * sizeof(T)) != 0) return false;
    }
    return true;
  };
  column.pack = [&list, access, places = part.places, n](std::vector<std::byte>& bytes) {
    bytes.resize(list.size() * n * sizeof(T));
    std::array<T, kMostNumbers> numbers;
    std::byte* out = bytes.data();
    for (const Record& record : list) {
      gather(access(record), places, numbers.data());
      std::memcpy(out, numbers.data(), n * sizeof(T));
      out += n * sizeof(T);
    }
  };
  column.unpack = [&list, access, places = part.places, n](std::span<const std::byte> bytes, std::size_t first) {
    std::array<T, kMostNumbers> numbers;
    const std::byte* in = bytes.data();
    for (std::size_t i = first; in != bytes.data() + bytes.size(); ++i, in += n * sizeof(T)) {
      std::memcpy(numbers.data(), in, n * sizeof(T));
      scatter(numbers.data(), places, access(list[i]));
    }
  };
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
  } else if constexpr (std::is_same_v<Field, std::vector<GlobalId>>) {
    column.rows = field.size();
    column.pack = [&field](auto& bytes) { bytes = bytes_of<GlobalId>(field); };
    column.unpack = [&field](auto bytes, std::size_t) { field = numbers_of<GlobalId>(bytes); };
  } else {
    using T = typename NumberOf<Field>::Type;
    std::vector<std::size_t> places;
    for_each_scalar(field, [&](auto&) { places.push_back(places.size()); });
    column.type = number_type<T>();
    column.components = static_cast<int>(places.size());
    column.pack = [&field, places](auto& bytes) {
      std::vector<T> numbers(places.size());
      gather(field, places, numbers.data());
      bytes = bytes_of<T>(numbers);
    };
    column.unpack = [&field, places](auto bytes, std::size_t) { scatter(numbers_of<T>(bytes).data(), places, field); };
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
    std::apply(
        [&](const auto&... row) {
          const auto add_row = [&](const auto& field_row) {
            for (const Part& part : parts_of<Record>(field_row))
              columns.push_back(column_of_list(group, list, field_row, part));
          };
          (add_row(row), ...);
        },
        FieldTable<Record>::rows);
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
