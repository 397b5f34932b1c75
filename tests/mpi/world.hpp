#pragma once

#include "parallel/communicator.hpp"

namespace breccia::test {

/// All ranks of the test.
[[nodiscard]] const Communicator& world();

}  // namespace breccia::test
