#include "commands/commands.hpp"

#include <fmt/core.h>
#include <filesystem>
#include <system_error>

#include "advice/rule_functions.hpp"
#include "base/geometry_file.hpp"
#include "base/printable.hpp"
#include "commands/check_report.hpp"
#include "commands/json_report.hpp"
#include "commands/preview.hpp"
#include "commands/start_state.hpp"
#include "commands/terminal.hpp"
#include "contact/search_params.hpp"
#include "domains/balance.hpp"
#include "observe/fragment_labels.hpp"
#include "observe/frames.hpp"
#include "output/folder/run_folder.hpp"
#include "output/frames/vtkhdf_sink.hpp"
#include "system/atomic_file.hpp"

namespace breccia {
namespace {

/// A geometry that has no case yet: meshed with all defaults.
case_::Case case_of_geometry(const MeshCommand& asked) {
  if (!asked.overrides.empty() || !asked.folder.empty())
    throw InputError(Problem{asked.case_file.string(), 0, "", "is no case file: a geometry is meshed without a case",
                             "neither --set nor -o, which need a case.toml with mesh.file", ""});
  case_::Case input;
  input.mesh.file = asked.case_file;
  return input;
}

/// Not a case: of a supported kind, or of one with a specific message.
bool is_geometry(const std::filesystem::path& file) {
  return geometry_file(file) != GeometryFile::unknown || !remedy_for(file).empty();
}

/// What a case of this mesh begins with; the numbers are to be replaced.
std::string case_to_begin_with(const std::filesystem::path& file, const FinishedMesh& made) {
  std::string text = fmt::format("A case of it begins with, the numbers being your own:\n\n  [mesh]\n  file = \"{}\"\n",
                                 printable(file.filename().string()));
  if (states_no_unit(geometry_file(file))) text += "  scale = 0.001  # where its lengths are millimetres\n";
  for (const std::string& group : made.mesh.volume_groups)
    text += fmt::format(
        "\n  [[material]]\n  group = \"{}\"\n  young = \"30 GPa\"\n  poisson = 0.2\n  density = \"2400 kg/m3\"\n",
        printable(group));
  return text;
}

/// The index of a mesh would take the place of that of the frames.
void refuse_frames_of_run(const std::filesystem::path& folder) {
  std::error_code error;
  const std::filesystem::path place = std::filesystem::canonical(folder, error);
  if (error) return;  // a new one
  const RunFolder run{place.parent_path()};
  if (std::filesystem::exists(run.provenance(), error) && place == run.frames())
    throw OutputError(Problem{folder.string(), 0, "", "these are the frames of a run", "another folder (-o)", ""});
}

/// A given geometry is reported without a case, which may have other errors.
std::string parameters_of(const MeshCommand& asked) {
  if (geometry_file(asked.case_file) != GeometryFile::unknown) return parameters_json(asked.case_file);
  return parameters_json(
      read_case_of(asked.case_file, asked.overrides, read_start_state(asked.case_file, asked.overrides, {})).mesh.file);
}

int mesh(const MeshCommand& asked) {
  if (asked.parameters) {
    fmt::print("{}", parameters_of(asked));
    return 0;
  }
  const auto told = [&](const FinishedMesh& made) {
    if (asked.json)
      fmt::print("{}", mesh_json(made));
    else
      print_lines(mesh_report(made, assess_quality(made.mesh)));
  };
  if (is_geometry(asked.case_file)) {
    case_::Case input = case_of_geometry(asked);
    input.mesh.trust = asked.trust_geometry;
    limit_preview(input);
    const FinishedMesh made = read_mesh(input);
    told(made);
    if (!asked.json) print_lines(case_to_begin_with(asked.case_file, made));
    if (!asked.json) print_warnings(unjoined_volumes(input, made.mesh, build_topology(made.mesh)));
    return 0;
  }
  case_::Case input =
      read_case_of(asked.case_file, asked.overrides, read_start_state(asked.case_file, asked.overrides, {}));
  input.mesh.trust = asked.trust_geometry;
  limit_preview(input);
  if (asked.folder.empty()) {
    const FinishedMesh made = build_mesh(input);
    told(made);
    if (!asked.json) print_warnings(unjoined_volumes(input, made.mesh, build_topology(made.mesh)));
    return 0;
  }
  refuse_frames_of_run(asked.folder);
  const Model model = build_model(input);
  create_folder(asked.folder);
  const Domain rest(model, search_params(input, model));
  const FrameParts elements{true, false, false};
  VtkhdfSink(asked.folder, elements)
      .frame(make_frame(rest, 0, elements, {find_fragments(rest), {}, Balance().weights(rest)}));
  if (asked.json) {
    fmt::print("{}", mesh_json({model.mesh, model.mesh_report}, &model.topology.surface_groups));
    return 0;
  }
  told({model.mesh, model.mesh_report});
  print_warnings(unjoined_volumes(input, model.mesh, model.topology));
  print_lines("elements for ParaView in " + asked.folder.string() + "\n");
  return 0;
}

}  // namespace

int mesh_command(const MeshCommand& asked) {
  return asked.json || asked.parameters ? or_problems([&] { return mesh(asked); }) : mesh(asked);
}

}  // namespace breccia
