#pragma once

#include <string>

#include "catalyst/insitu_abi.h"
#include "catalyst2/standin.hpp"

namespace breccia::test {

/// Names libcatalyst and its implementation by the environment.
void name_catalyst(const std::string& library, const std::string& implementation);

/// The libcatalyst of our own in this process, named by the environment, as if nothing had been done with it.
Standin& fresh_standin(const std::string& implementation = "standin");

/// Whether the tree has a view of exactly these values of an array, component by component, uncopied.
/// @param path  of the field in the channel
void expect_view_of(const StandinTree& tree, const std::string& path, const BrecciaArray& array, std::int64_t cells);

}  // namespace breccia::test
