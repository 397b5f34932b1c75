#pragma once

#include <span>
#include <string>
#include <string_view>

#include "case/reader_toml.hpp"

namespace breccia::case_ {

/// Makes one entry for each group of those that name a list of groups, in every list of tables that has a key of the
/// type text_or_list. Node::place of the entries is the place of each in the file. Values that are no list of names
/// remain, and are refused when they are read. "*" of joint.group stands for the groups with joints that no other
/// [[joint]] names, "*" of material.group for the volumes that no other [[material]] names; without volumes it stays
/// (groups.hpp), and that of joint.group with it.
/// @param volumes      groups of the mesh; empty: not known
/// @param drop_unused  a [[joint]] of "*" that stands for no group is left out, where the groups are known; otherwise
///                     it stays, which validate() refuses
void expand_groups(Node& root, std::span<const std::string> volumes, bool drop_unused);

/// The path of something in a tree so expanded, with the indices of the entries as they were written.
[[nodiscard]] std::string written_path(const Node& root, std::string_view path);

}  // namespace breccia::case_
