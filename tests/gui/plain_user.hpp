#pragma once

#include <linux/capability.h>
#include <linux/securebits.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>

namespace breccia::gui::test {

/// As long as it lives, permissions of files and folders hold for this thread and for what it starts, as they do for
/// any user, also where the tests run as root.
class PlainUser {
 public:
  PlainUser() {
    if (geteuid() != 0) return;
    bits_ = prctl(PR_GET_SECUREBITS);
    bits_set_ = syscall(SYS_capget, &header_, kept_.data()) == 0 &&
                prctl(PR_SET_SECUREBITS, bits_ | SECBIT_NO_SETUID_FIXUP | SECBIT_NOROOT) == 0;
    std::array<__user_cap_data_struct, 2> less = kept_;
    less[0].effective &= ~(CAP_TO_MASK(CAP_DAC_OVERRIDE) | CAP_TO_MASK(CAP_DAC_READ_SEARCH));
    holds_ = bits_set_ && syscall(SYS_capset, &header_, less.data()) == 0;
  }
  ~PlainUser() {
    if (!bits_set_) return;
    if (holds_) syscall(SYS_capset, &header_, kept_.data());
    prctl(PR_SET_SECUREBITS, bits_);
  }
  PlainUser(const PlainUser&) = delete;
  PlainUser& operator=(const PlainUser&) = delete;

  /// False where root may not give up its rights.
  [[nodiscard]] bool holds() const { return holds_; }

 private:
  __user_cap_header_struct header_{_LINUX_CAPABILITY_VERSION_3, 0};
  std::array<__user_cap_data_struct, 2> kept_{};
  int bits_ = 0;
  bool bits_set_ = false;
  bool holds_ = true;
};

}  // namespace breccia::gui::test
