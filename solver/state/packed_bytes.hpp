#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/error.hpp"

namespace breccia {

namespace packed {

/// Unsigned integer of the width that a scalar has outside memory.
template <class Scalar>
using Word =
    std::conditional_t<sizeof(Scalar) == 1, std::uint8_t,
                       std::conditional_t<sizeof(Scalar) == 2, std::uint16_t,
                                          std::conditional_t<sizeof(Scalar) == 4, std::uint32_t, std::uint64_t>>>;

template <class Scalar>
[[nodiscard]] Word<Scalar> word_of(const Scalar& x) {
  if constexpr (std::is_floating_point_v<Scalar>) {
    return std::bit_cast<Word<Scalar>>(x);
  } else {
    return static_cast<Word<Scalar>>(x);
  }
}

template <class Scalar>
[[nodiscard]] Scalar scalar_of(Word<Scalar> word) {
  if constexpr (std::is_floating_point_v<Scalar>) {
    return std::bit_cast<Scalar>(word);
  } else {
    return static_cast<Scalar>(word);
  }
}

/// The word with its bytes in the order of little-endian machines, or back.
template <class W>
[[nodiscard]] W little_endian(W word) {
  if constexpr (std::endian::native == std::endian::little) {
    return word;
  } else {
    W swapped = 0;
    for (std::size_t i = 0; i < sizeof word; ++i) swapped = static_cast<W>(swapped << 8U | (word >> 8 * i & 0xFFU));
    return swapped;
  }
}

}  // namespace packed

/// Scalars one behind the other, little-endian on every machine: doubles by bit pattern, bools and enumerations as
/// integers.
class PackedBytes {
 public:
  void reserve(std::size_t more) { bytes_.reserve(bytes_.size() + more); }
  template <class Scalar>
  void put(const Scalar& x) {
    const auto word = packed::little_endian(packed::word_of(x));
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof word);
    std::memcpy(bytes_.data() + at, &word, sizeof word);
  }
  template <class T>
  void put_list(const std::vector<T>& list) {
    put(static_cast<std::uint64_t>(list.size()));
    for (const T& x : list) put(x);
  }
  void put_text(const std::string& text) { put_list(std::vector<char>(text.begin(), text.end())); }
  [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

/// Reads what PackedBytes wrote, in the same order. Throws InternalError at the end of the bytes.
class PackedReader {
 public:
  explicit PackedReader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  template <class Scalar>
  [[nodiscard]] Scalar take() {
    using Word = packed::Word<Scalar>;
    DEMAND(sizeof(Word) <= left(), std::to_string(left()) + " bytes left");
    Word word = 0;
    std::memcpy(&word, bytes_.data() + at_, sizeof word);
    at_ += sizeof word;
    return packed::scalar_of<Scalar>(packed::little_endian(word));
  }
  template <class T>
  [[nodiscard]] std::vector<T> take_list() {
    const auto count = take<std::uint64_t>();
    DEMAND(count <= left() / sizeof(T), std::to_string(count) + " entries in " + std::to_string(left()) + " bytes");
    std::vector<T> list(count);
    for (T& x : list) x = take<T>();
    return list;
  }
  [[nodiscard]] std::string take_text() {
    const std::vector<char> letters = take_list<char>();
    return {letters.begin(), letters.end()};
  }
  [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }

 private:
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
};

}  // namespace breccia
