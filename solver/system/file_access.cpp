#include "system/file_access.hpp"

#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cstdint>

namespace breccia {
namespace {

// Numbers that every architecture has in common; the headers of older systems lack them.
constexpr long kCreateRuleset = 444, kAddRule = 445, kRestrictSelf = 446;

constexpr std::uint64_t kReads = LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
/// All that the first version knows: reading, running, writing, making and removing.
constexpr std::uint64_t kHandled = (LANDLOCK_ACCESS_FS_MAKE_SYM << 1U) - 1;

/// Where programs find libraries and what these read when they are used; any user may read it.
constexpr std::array kOfSystem{"/usr", "/lib", "/lib64"};

void allow_reading(int rules, const std::filesystem::path& path) {
  const int place = ::open(path.c_str(), O_PATH | O_CLOEXEC);
  struct stat about {};
  if (place >= 0 && ::fstat(place, &about) == 0) {
    landlock_path_beneath_attr rule{};
    rule.parent_fd = place;
    rule.allowed_access = S_ISDIR(about.st_mode) ? kReads : std::uint64_t{LANDLOCK_ACCESS_FS_READ_FILE};
    (void)::syscall(kAddRule, rules, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
  }
  if (place >= 0) ::close(place);
}

}  // namespace

bool limit_file_access(std::span<const std::filesystem::path> readable) {
  landlock_ruleset_attr handled{};
  handled.handled_access_fs = kHandled;
  const int rules = static_cast<int>(::syscall(kCreateRuleset, &handled, sizeof handled.handled_access_fs, 0));
  if (rules < 0) return false;
  for (const char* folder : kOfSystem) allow_reading(rules, folder);
  for (const std::filesystem::path& path : readable) allow_reading(rules, path);
  const bool limited = ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && ::syscall(kRestrictSelf, rules, 0) == 0;
  ::close(rules);
  return limited;
}

}  // namespace breccia
