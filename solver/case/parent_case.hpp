#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "case/case.hpp"
#include "case/reader_toml.hpp"

namespace breccia::case_ {

/// The case of the run whose state another starts from, as its checkpoint has it.
struct ParentCase {
  Case input;                                ///< as far as a state depends on it: without output and pipelines
  Node tree;                                 ///< of its text, every default written out
  std::map<std::string, std::string> files;  ///< SHA-256 of the files that it was made from, by name
  std::vector<std::string> volumes{};        ///< groups of its mesh, for "*" of materials; empty: not known
};

/// @param text  of a resolved case;  @param source  its checkpoint, for messages
/// @param files, volumes  as in ParentCase
/// Throws InputError if the text is no case.
[[nodiscard]] ParentCase parent_case(const std::string& text, const std::filesystem::path& source,
                                     std::map<std::string, std::string> files, std::vector<std::string> volumes = {});

/// Gives the tree of a case the sections that it leaves out and that the state fixes (schema.hpp: fixed_by_state).
/// Returns their names.
std::vector<std::string> inherit_sections(const ParentCase& parent, Node& root);

/// Settings of a case that the state of its parent does not allow: one problem a key, with key and reason; the reader
/// adds file and line. Entries of materials, joints and contacts are compared by their groups.
/// @param inherited  sections that the case has from the parent
[[nodiscard]] std::vector<Problem> refused_changes(const ParentCase& parent, const Case& now,
                                                   const std::vector<std::string>& inherited);

/// Whether laws of materials, joints or contacts differ, so that the energy that the state holds does.
[[nodiscard]] bool laws_differ(const Case& a, const Case& b);

}  // namespace breccia::case_
