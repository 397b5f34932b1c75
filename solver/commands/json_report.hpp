#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "case/case.hpp"
#include "commands/check_report.hpp"
#include "mesh/finish.hpp"
#include "model/model.hpp"

/// Reports of `check`, `mesh` and `schema` for programs: one JSON object, numbers in SI, ending with a line feed.
namespace breccia {

/// title and report in words, elements, nodes, bodies, joints, groups; end, stable_step and step, s; of RunEstimate
/// steps, seconds, most_seconds, memory, frames and disk; all of advice, each with rule, level, key and text.
[[nodiscard]] std::string check_json(const Subject& subject, const CheckReport& report);

/// Division among `parts` ranks: how, imbalance, efficiency, `domains` with the loads of each, `owner` with the rank of
/// each element in the order of ids. Throws as divide_model.
[[nodiscard]] std::string domains_json(const case_::Case& input, const Model& model, int parts);

/// Laws of the joints that can break: name, size and stiffness; opening, traction, peak and energy of `normal` and
/// `shear`; `unloading`; `envelope` with normal and shear.
[[nodiscard]] std::string joints_json(const Model& model);

/// Source, elements, nodes, bodies, groups, repairs, the quality of every element in ten bins, and the report in words.
/// @param faces  null, or those of each surface group, written as 4 * element + side below `faces`, with the positions
/// of the nodes of each curve and point below `places`, m
[[nodiscard]] std::string mesh_json(const FinishedMesh& made,
                                    const std::vector<std::vector<Topology::Face>>* faces = nullptr);

/// What a geometry lets mesh.parameters set, in its order: `parameters`, each with `names`, any of which sets it, and
/// as the geometry has them `default` and `words`, the comment behind it. None of any file but a .geo.
[[nodiscard]] std::string parameters_json(const std::filesystem::path& geometry);

/// Every row of the table of keys: path, type, unit, default, required, lower, upper, choices, word, help, example,
/// allowed in words.
[[nodiscard]] std::string schema_json();

/// Runs `work`. Problems of the case or the mesh are printed as {"problems": [...]} with file, line, key, what,
/// allowed, given and text of each, and 2 is returned; other errors propagate.
int or_problems(const std::function<int()>& work);

}  // namespace breccia
