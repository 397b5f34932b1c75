#include "model/memory_demand.hpp"

#include "base/error.hpp"
#include "base/number_text.hpp"
#include "case/problem_at.hpp"
#include "system/bounded_file.hpp"
#include "system/child_process.hpp"

namespace breccia {
namespace {

// Bytes for each element, rounded down from rasters of 192,000 to 1,536,000 elements: a mesh that only is divided, and
// a model that runs on one rank with shared nodes and with breakable joints.
constexpr double kOfMesh = 350, kOfSharedNodes = 450, kOfOwnNodes = 6000;

}  // namespace

double mesh_bytes(double elements) { return kOfMesh * elements; }

double model_bytes(const Model& model) {
  double bytes = 0;
  for (const Index group : model.mesh.element_group) {
    const bool own = model.discretisation[static_cast<std::size_t>(group)] == Discretisation::own_nodes;
    bytes += own ? kOfOwnNodes : kOfSharedNodes;
  }
  return bytes;
}

void demand_memory(const case_::Case& input, double elements, double bytes) {
  const auto available = available_memory();
  if (bytes <= static_cast<double>(available)) return;
  throw InputError(case_::problem_at(
      input, input.mesh.origin, input.mesh.raster ? "raster" : "file", "the model needs more memory than is available",
      "up to " + bytes_text(available) + ": fewer, larger elements, or a larger machine",
      number_text(elements, 3) + " elements, at least " + bytes_text(static_cast<std::uint64_t>(bytes))));
}

}  // namespace breccia
