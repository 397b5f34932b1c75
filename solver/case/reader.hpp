#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "case/case.hpp"
#include "case/reader_toml.hpp"

namespace breccia::case_ {

/// Reads and checks a case file: TOML, keys of the schema, quantities in SI or with units. Defaults are filled in,
/// including a joint law for unbreakable groups without one, and Case::resolved.
/// @param overrides `key=value` of the command line, put into the file's tree before it is read (reader_overrides.hpp)
/// Throws InputError with every problem of the file: TOML, unknown and missing keys, types, units, ranges, and what
/// validate() finds. Group names are compared with the mesh later, by check_groups().
[[nodiscard]] Case read_case(const std::filesystem::path& file, std::span<const std::string> overrides = {});

struct ParentCase;

/// The section [start] alone; nullopt: there is none. Throws InputError: TOML, and what is wrong with this section.
[[nodiscard]] std::optional<Start> read_start(const std::filesystem::path& file,
                                              std::span<const std::string> overrides = {});

/// A case that starts from the state of another run (parent_case.hpp): sections that it leaves out and the state fixes
/// are the parent's, and what it changes of them is refused. Throws InputError as read_case.
[[nodiscard]] Case read_started_case(const std::filesystem::path& file, std::span<const std::string> overrides,
                                     const ParentCase& parent);

/// Whether the mesh file must be there: not where its elements are in a checkpoint.
enum class MeshFile { must_be_there, may_be_gone };

/// The same of a text that stands, or will stand, in `file`, whose folder relative names start from.
[[nodiscard]] Case read_case_text(std::string_view text, const std::filesystem::path& file,
                                  std::span<const std::string> overrides = {}, MeshFile mesh = MeshFile::must_be_there);
/// The same of a tree.
/// @param volumes  groups of its mesh, which "*" of materials stands for; empty: not known yet
[[nodiscard]] Case read_case_tree(Node root, const std::filesystem::path& file, MeshFile mesh,
                                  const std::vector<std::string>& volumes = {});

/// A text as a parameter of a pipeline: a number as well where it reads as a quantity.
[[nodiscard]] Setting read_setting(const std::string& text);

}  // namespace breccia::case_
