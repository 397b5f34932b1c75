#include "output/checkpoint/checkpoint_index.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string_view>
#include <system_error>

#include "base/error.hpp"
#include "output/folder/json_text.hpp"
#include "state/state_hash.hpp"
#include "system/regular_file.hpp"

namespace breccia {
namespace {

using Json = nlohmann::json;

static_assert(std::endian::native == std::endian::little, "numbers are stored as they are in memory");

constexpr std::array<const char*, 6> kTypes{"float64", "float32", "int64", "int32", "int8", "uint8"};
/// More than the text of a column, a part and the rest of the index takes, and of the rows and checksum of a rank.
constexpr std::size_t kTextOfColumn = 256, kTextOfRank = 64;
/// Largest index, bytes: limit of what is read of a file before it is verified.
constexpr std::uint64_t kLargestIndex = std::uint64_t{1} << 30;

constexpr std::string_view kHeaderFormat =
    "Breccia checkpoint, format {}. An HDF5 file, whose own index is {} bytes at {}, checksum {:016x}; {} bytes in "
    "all\n";

std::string hex(std::uint64_t number) { return fmt::format("{:016x}", number); }

std::uint64_t number_of_hex(const Json& json) {
  const auto& text = json.get_ref<const std::string&>();
  std::uint64_t number = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), number, 16);
  if (end.ec != std::errc{} || end.ptr != text.data() + text.size()) throw std::runtime_error("checksum");
  return number;
}

Json json_of(const IndexedColumn& column) {
  Json json{{"path", column.path},
            {"type", kTypes[static_cast<std::size_t>(column.type)]},
            {"components", column.components},
            {"rows", column.rows}};
  if (column.zero) {
    json["zero"] = true;
  } else {
    json["offset"] = column.offset;
    json["checksums"] = Json::array();
    for (const std::uint64_t sum : column.checksums) json["checksums"].push_back(hex(sum));
  }
  return json;
}

IndexedColumn column_of(const Json& json) {
  IndexedColumn column;
  column.path = json.at("path").get<std::string>();
  const auto type = std::find(kTypes.begin(), kTypes.end(), json.at("type").get<std::string>());
  if (type == kTypes.end()) throw std::runtime_error("type");
  column.type = static_cast<NumberType>(type - kTypes.begin());
  column.components = json.at("components").get<int>();
  column.rows = json.at("rows").get<std::vector<std::uint64_t>>();
  column.zero = json.value("zero", false);
  if (column.zero) return column;
  column.offset = json.at("offset").get<std::uint64_t>();
  for (const Json& sum : json.at("checksums")) column.checksums.push_back(number_of_hex(sum));
  if (column.checksums.size() != column.rows.size()) throw std::runtime_error("checksums");
  return column;
}

/// Throws std::exception if the text is no index.
CheckpointIndex parsed_index(std::span<const std::byte> bytes) {
  const Json json = json_of_text<Json>({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  CheckpointIndex index;
  index.step = json.at("step").get<std::int64_t>();
  index.time = std::bit_cast<double>(number_of_hex(json.at("time_bits")));
  index.size = json.at("size").get<std::uint64_t>();
  for (const Json& column : json.at("columns")) index.columns.push_back(column_of(column));
  for (const Json& part : json.at("structure")) {
    index.structure.push_back({part.at("offset").get<std::uint64_t>(), part.at("size").get<std::uint64_t>(),
                               number_of_hex(part.at("checksum"))});
  }
  return index;
}

/// Whether the columns lie within the file and have as many rows as may be, so that none is read beyond, and a list
/// whose numbers are all 0 takes no more memory than others: a record has a byte in the file at least. The
/// structure is no larger than the file and no column has more ranks than another, so that reading takes O(bytes).
bool fits(const CheckpointIndex& index) {
  std::uint64_t structure = 0;
  for (const IndexedBytes& part : index.structure) {
    if (part.size > index.size - structure || part.offset > index.size - part.size) return false;
    structure += part.size;
  }
  return std::all_of(index.columns.begin(), index.columns.end(), [&](const IndexedColumn& column) {
    if (column.components < 1 || column.components > 4096) return false;
    if (column.rows.size() != index.columns.front().rows.size()) return false;  // every rank has a part of each
    const std::uint64_t row = static_cast<std::uint64_t>(column.components) * size_of(column.type);
    std::uint64_t rows = 0;
    for (const std::uint64_t of_rank : column.rows) {
      if (of_rank > index.size / row) return false;
      rows += of_rank;
    }
    if (column.zero) return rows <= index.size;
    return column.offset <= index.size && rows <= (index.size - column.offset) / row;
  });
}

struct Header {
  IndexedBytes index;
  std::uint64_t size = 0;
};

Header parsed_header(const std::filesystem::path& file, const std::vector<std::byte>& bytes) {
  const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (!text.starts_with("Breccia checkpoint, format "))
    refuse_checkpoint(file, std::all_of(bytes.begin(), bytes.end(), [](std::byte b) { return b == std::byte{0}; })
                                ? "this checkpoint was never finished"
                                : "this is no checkpoint of breccia");
  int format = 0;
  unsigned long long size = 0, offset = 0, checksum = 0, all = 0;
  const int read = std::sscanf(text.c_str(),
                               "Breccia checkpoint, format %d. An HDF5 file, whose own index is %llu bytes at %llu, "
                               "checksum %llx; %llu bytes in all",
                               &format, &size, &offset, &checksum, &all);
  if (read >= 1 && format != kCheckpointFormat)
    refuse_checkpoint(file, fmt::format("this checkpoint has format {}, of another version of breccia (this one reads "
                                        "{}): continue with the version that wrote it, or run its case again",
                                        format, kCheckpointFormat));
  Header header{{offset, size, checksum}, all};
  if (read != 5 || header_bytes(header.index, header.size) != bytes)
    refuse_checkpoint(file, "this checkpoint is damaged: its first bytes");
  return header;
}

}  // namespace

void refuse_checkpoint(const std::filesystem::path& file, const std::string& what) {
  throw InputError(Problem{file.string(), 0, "checkpoint", what, "a checkpoint that `breccia run` has written", ""});
}

std::uint64_t checksum_of(std::span<const std::byte> bytes) {
  SequenceHash hash;
  hash.add(static_cast<std::uint64_t>(bytes.size()));
  for (std::size_t at = 0; at < bytes.size(); at += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, std::min<std::size_t>(8, bytes.size() - at));
    hash.add(word);
  }
  return hash.value();
}

std::string index_text(const CheckpointIndex& index) {
  Json json{{"format", kCheckpointFormat}, {"step", index.step},
            {"time", index.time},          {"time_bits", hex(std::bit_cast<std::uint64_t>(index.time))},
            {"size", index.size},          {"columns", Json::array()},
            {"structure", Json::array()}};
  for (const IndexedColumn& column : index.columns) json["columns"].push_back(json_of(column));
  for (const IndexedBytes& part : index.structure)
    json["structure"].push_back({{"offset", part.offset}, {"size", part.size}, {"checksum", hex(part.checksum)}});
  return json.dump();
}

std::size_t index_bound(const std::vector<IndexedColumn>& columns, std::size_t parts, std::size_t ranks) {
  return (columns.size() + parts + 4) * kTextOfColumn + columns.size() * ranks * kTextOfRank;
}

std::vector<std::byte> header_bytes(const IndexedBytes& place, std::uint64_t file_size) {
  const std::string text =
      fmt::format(kHeaderFormat, kCheckpointFormat, place.size, place.offset, place.checksum, file_size);
  std::vector<std::byte> bytes(kCheckpointHeader, std::byte{0});
  std::memcpy(bytes.data(), text.data(), text.size());
  return bytes;
}

std::vector<std::byte> read_verified(const std::filesystem::path& file, const IndexedBytes& place,
                                     const std::string& what) {
  std::vector<std::byte> bytes(place.size);
  RegularStream stream(file, Depth::named);
  if (!stream) refuse_checkpoint(file, "cannot read this file");
  stream.seekg(static_cast<std::streamoff>(place.offset));
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (static_cast<std::uint64_t>(stream.gcount()) != place.size)
    refuse_checkpoint(file, "this checkpoint is cut off: " + what + " is not whole");
  if (checksum_of(bytes) != place.checksum)
    refuse_checkpoint(file, "this checkpoint is damaged: " + what + " does not have its checksum");
  return bytes;
}

CheckpointIndex read_index(const std::filesystem::path& file) {
  RegularStream stream(file, Depth::named);
  if (!stream) refuse_checkpoint(file, "cannot read this file");
  std::vector<std::byte> first(kCheckpointHeader);
  stream.read(reinterpret_cast<char*>(first.data()), static_cast<std::streamsize>(first.size()));
  if (stream.gcount() != static_cast<std::streamsize>(first.size()))
    refuse_checkpoint(file, "this is no checkpoint of breccia: it is too short");
  const Header header = parsed_header(file, first);
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(file, error);
  if (error || size != header.size)
    refuse_checkpoint(file, fmt::format("this checkpoint is cut off or has grown: it should have {} bytes and has {}",
                                        header.size, size));
  if (header.index.size > std::min(size, kLargestIndex) || header.index.offset > size - header.index.size)
    refuse_checkpoint(file, "this checkpoint is damaged: its index lies outside the file");
  const std::vector<std::byte> text = read_verified(file, header.index, "its index");
  CheckpointIndex index;
  try {
    index = parsed_index(text);
  } catch (const std::exception& wrong) {
    refuse_checkpoint(file, "this checkpoint is damaged: its index cannot be read");
  }
  if (index.size != size || !fits(index))
    refuse_checkpoint(file, "this checkpoint is damaged: its index does not fit the file");
  for (const IndexedBytes& part : index.structure) (void)read_verified(file, part, "its structure");
  return index;
}

}  // namespace breccia
