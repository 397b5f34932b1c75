#pragma once

namespace breccia::test {

/// Calls of operator new in this process so far.
[[nodiscard]] long allocations();

}  // namespace breccia::test
