#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace breccia {

/// Content of a file as words and as binary numbers, a block of it in memory at a time.
class FileInput {
 public:
  explicit FileInput(const std::filesystem::path& file) : in_(file, std::ios::binary), block_(kBlock) {}

  [[nodiscard]] int line() const { return line_; }  ///< of what was read last, from 1
  /// The next byte without reading it, -1 at the end.
  int peek() {
    if (at_ == end_ && !refill()) return -1;
    return static_cast<unsigned char>(block_[at_]);
  }
  int get() {
    const int c = peek();
    if (c < 0) return c;
    ++at_;
    line_ += c == '\n' ? 1 : 0;
    return c;
  }
  /// The rest of the line without its end. False at the end of the file.
  bool rest_of_line(std::string& text) {
    text.clear();
    if (peek() < 0) return false;
    for (int c = get(); c >= 0 && c != '\n'; c = get())
      if (text.size() < kLongest) text.push_back(static_cast<char>(c));
    if (text.ends_with('\r')) text.pop_back();
    return true;
  }
  /// The next word, up to white space. False at the end of the file.
  bool word(std::string& text) {
    text.clear();
    while (peek() >= 0 && peek() <= ' ') get();
    while (peek() > ' ') {
      const auto c = static_cast<char>(get());
      if (text.size() < kLongest) text.push_back(c);
    }
    return !text.empty();
  }
  void swap_bytes(bool other_order) { swapped_ = other_order; }
  /// A binary number. False where the file ends.
  template <class T>
  bool binary(T& value) {
    auto* bytes = reinterpret_cast<char*>(&value);
    for (std::size_t i = 0; i < sizeof value; ++i) {
      const int c = get();
      if (c < 0) return false;
      bytes[swapped_ ? sizeof value - 1 - i : i] = static_cast<char>(c);
    }
    return true;
  }
  bool skip(std::uint64_t bytes) {
    for (std::uint64_t i = 0; i < bytes; ++i)
      if (get() < 0) return false;
    return true;
  }

 private:
  static constexpr std::size_t kBlock = 1 << 16, kLongest = 1000;

  bool refill() {
    in_.read(block_.data(), static_cast<std::streamsize>(block_.size()));
    at_ = 0;
    end_ = static_cast<std::size_t>(in_.gcount());
    return end_ > 0;
  }

  std::ifstream in_;
  std::vector<char> block_;
  std::size_t at_ = 0, end_ = 0;
  int line_ = 1;
  bool swapped_ = false;
};

}  // namespace breccia
