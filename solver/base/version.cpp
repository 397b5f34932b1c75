#include "base/version.hpp"

namespace breccia {

const char* program_version() { return BRECCIA_VERSION; }

}  // namespace breccia
