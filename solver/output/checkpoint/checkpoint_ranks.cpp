#include "output/checkpoint/checkpoint_ranks.hpp"

#include <fcntl.h>

#include <chrono>
#include <cstring>
#include <exception>
#include <string>
#include <thread>
#include <utility>

#include "output/checkpoint/checkpoint_index.hpp"
#include "output/folder/folder_tree.hpp"
#include "system/atomic_file.hpp"
#include "system/shared_file.hpp"

namespace breccia {
namespace {

constexpr auto kBetweenReads = std::chrono::milliseconds(10);
/// Copies begin together: one that has left nothing by then was never made.
constexpr auto kUntilFirst = std::chrono::seconds(20);
/// Between two exchanges lies the writing of a part at most.
constexpr auto kUntilNext = std::chrono::minutes(10);

/// Bytes of an exchanged file at most: rows of all columns, or the text of an error.
constexpr std::uint64_t kMostExchanged = 1 << 20;

std::vector<std::uint64_t> numbers_of_text(const std::string& text) {
  std::vector<std::uint64_t> numbers(1 + (text.size() + 7) / 8);
  numbers[0] = text.size();
  if (!text.empty()) std::memcpy(numbers.data() + 1, text.data(), text.size());
  return numbers;
}

std::string text_of(const std::vector<std::uint64_t>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data() + 1), numbers[0]};
}

}  // namespace

FileRanks::FileRanks(int rank, int size, std::filesystem::path file, std::uint64_t token)
    : CheckpointRanks(rank, size), file_(std::move(file)), token_(token) {}

FileRanks::~FileRanks() {
  if (size() == 1) return;
  try {
    leave({});
    if (!is_root()) return;
    for (int r = 1; r < size() && !lost_; ++r) (void)wait_for(r);
  } catch (const OutputError&) {  // nothing but the files depends on it
  }
  for (int r = 0; is_root() && r < size(); ++r) {
    for (std::uint64_t n = 0; n <= number_; ++n) (void)remove_file(file_of(r, n), Depth::subfolder);
  }
}

std::filesystem::path FileRanks::file_of(int rank, std::uint64_t number) const {
  return file_.parent_path() /
         ("." + file_.filename().string() + "." + std::to_string(rank) + "." + std::to_string(number) + ".tmp");
}

/// A file: token, numbers, checksum of both. It may be read before it is whole.
void FileRanks::leave(std::span<const std::uint64_t> mine) {
  Numbers numbers{token_};
  numbers.insert(numbers.end(), mine.begin(), mine.end());
  numbers.push_back(checksum_of(std::as_bytes(std::span(numbers))));
  const SharedFile shared(file_of(rank(), number_), file_, O_CREAT);
  shared.write_at(0, std::as_bytes(std::span(numbers)));
}

std::optional<FileRanks::Numbers> FileRanks::left_by(int rank) const {
  const Opened opened = open_regular(file_of(rank, number_), O_RDONLY, Depth::subfolder);
  if (!opened) return std::nullopt;
  const std::string bytes = bytes_from(opened.descriptor, 0, kMostExchanged);
  Numbers numbers(bytes.size() / sizeof(std::uint64_t));
  if (numbers.size() < 2) return std::nullopt;
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(std::uint64_t));
  const std::uint64_t sum = numbers.back();
  numbers.pop_back();
  if (numbers.front() != token_ || checksum_of(std::as_bytes(std::span(numbers))) != sum) return std::nullopt;
  numbers.erase(numbers.begin());
  return numbers;
}

FileRanks::Numbers FileRanks::wait_for(int rank) {
  using Wall = std::chrono::steady_clock;
  const auto end = Wall::now() + (number_ == 0 ? Wall::duration(kUntilFirst) : Wall::duration(kUntilNext));
  while (Wall::now() < end) {
    if (auto numbers = left_by(rank)) return *std::move(numbers);
    std::this_thread::sleep_for(kBetweenReads);
  }
  lost_ = true;
  throw output_error(file_, "cannot write this file: rank " + std::to_string(rank) + " has not written its part");
}

std::vector<FileRanks::Numbers> FileRanks::all_gather(std::span<const std::uint64_t> mine) {
  std::vector<Numbers> all(static_cast<std::size_t>(size()));
  if (size() > 1) leave(mine);
  for (int r = 0; r < size(); ++r)
    all[static_cast<std::size_t>(r)] = r == rank() ? Numbers(mine.begin(), mine.end()) : wait_for(r);
  ++number_;
  return all;
}

void FileRanks::agree(const std::function<void()>& work) {
  std::string mine;
  try {
    work();
  } catch (const std::exception& error) {
    mine = error.what();
  }
  for (const Numbers& numbers : all_gather(numbers_of_text(mine))) {
    if (numbers.front() > 0) throw OutputError(Problem{"", 0, "", text_of(numbers), "", ""});
  }
}

}  // namespace breccia
