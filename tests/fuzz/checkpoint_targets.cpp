#include "fuzz/checkpoint_targets.hpp"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "mesh/topology.hpp"
#include "output/checkpoint/checkpoint.hpp"
#include "output/checkpoint/checkpoint_index.hpp"
#include "output/checkpoint/checkpoint_writer.hpp"
#include "unit/state/sample_records.hpp"

namespace breccia::fuzz {
namespace {

namespace fs = std::filesystem;

Bytes content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const auto raw = std::as_bytes(std::span(text));
  return {raw.begin(), raw.end()};
}

void write(const fs::path& file, const Bytes& bytes) {
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

/// A sound checkpoint of a few elements.
struct Sample {
  Bytes file;
  CheckpointIndex index;
};

const Sample& sample() {
  static const Sample made = [] {
    Checkpoint checkpoint;
    const Mesh mesh = test::cubes();
    checkpoint.mine = test::records_of(mesh, build_topology(mesh));
    checkpoint.model.clock.dt = 1e-6;
    checkpoint.whole_model = {std::byte{1}, std::byte{0}, std::byte{255}};
    checkpoint.case_text = "title = \"a case\"\n";
    checkpoint.provenance = "{}";
    CheckpointWriter(scratch_file(), std::move(checkpoint), {}, {}).finish();
    return Sample{content_of(scratch_file()), read_index(scratch_file())};
  }();
  return made;
}

/// Puts a text behind a file as its index, with the checksums that make it be read.
void write_with_index(Bytes file, const Bytes& text) {
  IndexedBytes place{file.size(), text.size(), checksum_of(text)};
  file.insert(file.end(), text.begin(), text.end());
  const Bytes header = header_bytes(place, file.size());
  std::copy(header.begin(), header.end(), file.begin());
  write(scratch_file(), file);
}

/// The index's text with a given size of the file, as long as that size says.
Bytes text_of(CheckpointIndex index, std::size_t room) {
  index.size = sample().file.size() + room;
  std::string text = index_text(index);
  if (text.size() > room) throw std::logic_error("no room for the index");
  text.resize(room, ' ');
  const auto raw = std::as_bytes(std::span(text));
  return {raw.begin(), raw.end()};
}

std::size_t room_of_index() {
  static const std::size_t room = 2 * index_text(sample().index).size();
  return room;
}

std::size_t size_of_column(const IndexedColumn& column) {
  std::size_t rows = 0;
  for (const std::uint64_t of_rank : column.rows) rows += of_rank;
  return column.zero ? 0 : rows * static_cast<std::size_t>(column.components) * size_of(column.type);
}

}  // namespace

void read_checkpoint_file(std::span<const std::byte> bytes) {
  write(scratch_file(), Bytes(bytes.begin(), bytes.end()));
  (void)read_checkpoint(scratch_file(), {});
}

std::vector<Bytes> checkpoint_seeds() { return {sample().file}; }

void read_checkpoint_index(std::span<const std::byte> bytes) {
  Bytes text(bytes.begin(), bytes.end());
  text.resize(room_of_index(), std::byte{' '});  // the size of the file, which stands in it, stays right
  write_with_index(sample().file, text);
  (void)read_checkpoint(scratch_file(), {});
}

std::vector<Bytes> index_seeds() { return {text_of(sample().index, room_of_index())}; }

void read_checkpoint_state(std::span<const std::byte> bytes) {
  Sample changed = sample();
  for (IndexedColumn& column : changed.index.columns) {
    const std::size_t size = size_of_column(column), here = std::min(size, bytes.size());
    std::byte* const place = changed.file.data() + column.offset;
    if (here > 0) std::memcpy(place, bytes.data(), here);
    bytes = bytes.subspan(here);
    if (!column.zero) column.checksums.at(0) = checksum_of({place, size});
  }
  write_with_index(changed.file, text_of(changed.index, room_of_index()));
  (void)read_checkpoint(scratch_file(), {});
}

std::vector<Bytes> state_seeds() {
  Bytes all;
  for (const IndexedColumn& column : sample().index.columns) {
    const auto begin = sample().file.begin() + static_cast<std::ptrdiff_t>(column.offset);
    all.insert(all.end(), begin, begin + static_cast<std::ptrdiff_t>(size_of_column(column)));
  }
  return {all};
}

}  // namespace breccia::fuzz
