#pragma once

#include <filesystem>
#include <string>

namespace breccia::test {

/// The ranks that run the tests; every test is run by all of them.
struct World {
  int communicator;  ///< of Fortran
  int rank;
  int size;
};
const World& world();

/// A folder of a test's own below the tests' place, empty, the same on all ranks; made by the first of them.
/// Collective.
std::filesystem::path fresh_folder(const std::string& name);

/// The first rank's value on all. Collective.
int broadcast(int value);

/// Waits for all ranks. Collective.
void barrier();

}  // namespace breccia::test
