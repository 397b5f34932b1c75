#pragma once

#include <string>
#include <vector>

namespace breccia::insitu {

/// Runs a program to its end and returns what it writes to its standard output; its standard error is dropped.
/// @param arguments the program, sought on PATH, and its arguments
/// Throws PipelineError when it cannot be started or ends with a code other than 0.
[[nodiscard]] std::string output_of(const std::vector<std::string>& arguments);

/// True when a program of that name is on PATH.
[[nodiscard]] bool is_on_path(const std::string& program);

}  // namespace breccia::insitu
