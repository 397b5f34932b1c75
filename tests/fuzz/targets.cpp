#include "fuzz/targets.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

#include "base/error.hpp"
#include "case/reader.hpp"
#include "case/units.hpp"
#include "fuzz/checkpoint_targets.hpp"
#include "mesh/finish.hpp"
#include "mesh/geo_scan.hpp"
#include "mesh/gmsh_source_check.hpp"
#include "mesh/mesh_bytes.hpp"
#include "mesh/topology.hpp"
#include "output/folder/control.hpp"

namespace breccia::fuzz {

const std::filesystem::path& scratch_file() {
  static const std::filesystem::path file =
      (std::filesystem::exists("/dev/shm") ? std::filesystem::path("/dev/shm")
                                           : std::filesystem::temp_directory_path()) /
      ("breccia_fuzz_" + std::to_string(::getpid()));
  static const struct Remover {
    ~Remover() { std::filesystem::remove(file); }
  } remover;
  return file;
}

namespace {

Bytes bytes_of_text(const std::string& text) {
  const auto raw = std::as_bytes(std::span(text));
  return {raw.begin(), raw.end()};
}

std::string text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

const std::filesystem::path& written(std::span<const std::byte> bytes) {
  std::ofstream(scratch_file(), std::ios::binary) << text_of(bytes);
  return scratch_file();
}

std::vector<Bytes> files_of_meshes(const std::string& extension) {
  std::vector<Bytes> seeds;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(BRECCIA_MESHES)) {
    if (entry.path().extension() != extension) continue;
    std::ifstream file(entry.path(), std::ios::binary);
    seeds.push_back(bytes_of_text({std::istreambuf_iterator<char>(file), {}}));
  }
  return seeds;
}

void read_case_file(std::span<const std::byte> bytes) { (void)case_::read_case(written(bytes)); }

void read_override(std::span<const std::byte> bytes) {
  const std::vector<std::string> overrides{text_of(bytes)};
  (void)case_::read_case(std::filesystem::path(BRECCIA_MESHES) / "block_wall" / "case.toml", overrides);
}

void read_quantity(std::span<const std::byte> bytes) {
  try {
    (void)case_::parse_quantity(text_of(bytes));
  } catch (const case_::UnitError&) {
  }
}

void scan_script(std::span<const std::byte> bytes) { (void)scan_geo(written(bytes)); }

void read_mesh_bytes(std::span<const std::byte> bytes) {
  MeshOrProblems read = mesh_of(bytes);
  // What is accepted is written and read again without a change.
  if (bytes_of(read) != Bytes(bytes.begin(), bytes.end())) throw std::logic_error("a mesh changed on its way");
}

constexpr std::size_t kChecksum = sizeof(std::uint64_t);

/// Bytes with the checksum of mesh/mesh_bytes.cpp behind them.
Bytes with_checksum(std::span<const std::byte> content) {
  std::uint64_t sum = 0xcbf29ce484222325;
  for (std::size_t i = 0; i < content.size(); i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, content.data() + i, std::min<std::size_t>(8, content.size() - i));
    sum = (sum ^ word) * 0x100000001b3;
  }
  Bytes all(content.begin(), content.end());
  all.resize(content.size() + kChecksum);
  std::memcpy(all.data() + content.size(), &sum, kChecksum);
  return all;
}

/// What a wrong number makes of a mesh that came whole.
void read_mesh_content(std::span<const std::byte> bytes) {
  MeshOrProblems read = mesh_of(with_checksum(bytes));
  if (auto* raw = std::get_if<RawMesh>(&read)) (void)build_topology(finish_mesh(std::move(raw->mesh), {}).mesh);
}

/// What is looked at before gmsh opens a file, under each of the names that it may have: the first byte chooses.
void check_geometry(std::span<const std::byte> bytes) {
  constexpr std::array kExtensions{".step", ".brep", ".stl", ".msh", ".geo"};
  if (bytes.empty()) return;
  const auto kind = static_cast<std::size_t>(bytes.front()) % kExtensions.size();
  GmshSource source;
  source.file = scratch_file().string() + kExtensions[kind];
  const struct Remover {
    const std::filesystem::path& file;
    ~Remover() { std::filesystem::remove(file); }
  } remover{source.file};
  std::ofstream(source.file, std::ios::binary) << text_of(bytes.subspan(1));
  check_source(source);
}

void read_control(std::span<const std::byte> bytes) { (void)parse_command(text_of(bytes)); }

std::vector<Bytes> override_seeds() {
  std::vector<Bytes> seeds;
  for (const char* text : {"material.block.young=\"70 GPa\"", "material[1].density=2456", "time.safety=0.5",
                           "output.gauges=[\"block\"]", "stage.impact.constraint[0].velocity.y=\"-2 mm/s\""})
    seeds.push_back(bytes_of_text(text));
  return seeds;
}

std::vector<Bytes> quantity_seeds() {
  std::vector<Bytes> seeds;
  for (const char* text : {"26.6 GPa", "1 J/(m2 s)", "-1e-3 mm^-2", "9.81 m/s^2", "5 %", "1.8 TPa", "30 deg/s"})
    seeds.push_back(bytes_of_text(text));
  return seeds;
}

std::vector<Bytes> control_seeds() {
  std::vector<Bytes> seeds;
  for (const char* text : {"pause id=7.8", "frame_interval 2 us id=3", "stop", "extract id=", "resume\r"})
    seeds.push_back(bytes_of_text(text));
  return seeds;
}

std::vector<Bytes> mesh_seeds() {
  RawMesh raw;
  raw.mesh.source = "a.msh";
  raw.mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0.1}};
  raw.mesh.elements = {{0, 1, 2, 3}};
  raw.mesh.element_group = raw.mesh.element_body = {0};
  raw.mesh.element_source_id = {17};
  raw.mesh.surface_faces = {{{0, 1, 2}, 0}};
  raw.mesh.volume_groups = {"box"};
  raw.mesh.surface_groups = {"floor"};
  raw.mesh.num_bodies = 1;
  return {bytes_of(raw), bytes_of(std::vector<Problem>{{"a.geo", 3, "key", "what", "", "given"}})};
}

std::vector<Bytes> content_seeds() {
  std::vector<Bytes> seeds = mesh_seeds();
  for (Bytes& seed : seeds) {
    const Bytes whole = seed;
    seed.resize(seed.size() - kChecksum);
    if (with_checksum(seed) != whole) throw std::logic_error("mesh/mesh_bytes.cpp has another checksum");
  }
  return seeds;
}

std::vector<Bytes> geometry_seeds() {
  std::vector<Bytes> seeds;
  for (const std::string text : {"5ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n",
                                 "6DBRep_DrawableShape\n\nCASCADE Topology V1\nLocations 0\nTShapes 1\nVe\n1e-7\n0 0 "
                                 "0\n0 0\n\n0101101\n*\n+1 0\n",
                                 "7solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
                                 "0\nendloop\nendfacet\nendsolid\n",
                                 "8$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n$EndNodes\n",
                                 "9DefineConstant[ h = {0.1, Name \"Size/h\"} ];\nPoint(1) = {0, 0, 0, h};\n"})
    seeds.push_back(bytes_of_text(text));
  std::string binary = "7" + std::string(80, ' ') + std::string("\1\0\0\0", 4) + std::string(50, '\0');
  seeds.push_back(bytes_of_text(binary));
  return seeds;
}

}  // namespace

const std::vector<Target>& targets() {
  static const std::vector<Target> all{
      {"case", read_case_file, [] { return files_of_meshes(".toml"); }},
      {"override", read_override, override_seeds},
      {"quantity", read_quantity, quantity_seeds},
      {"geometry", scan_script, [] { return files_of_meshes(".geo"); }},
      {"mesh", read_mesh_bytes, mesh_seeds},
      {"content", read_mesh_content, content_seeds},
      {"source", check_geometry, geometry_seeds},
      {"control", read_control, control_seeds},
      {"checkpoint", read_checkpoint_file, checkpoint_seeds},
      {"index", read_checkpoint_index, index_seeds},
      {"state", read_checkpoint_state, state_seeds},
  };
  return all;
}

}  // namespace breccia::fuzz
