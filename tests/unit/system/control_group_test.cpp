#include "system/control_group.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "unit/output/temporary_folder.hpp"

namespace breccia::control_group_test {
namespace {

class ControlGroup : public testing::Test {
 protected:
  void write(const std::string& path, const std::string& text) const {
    std::filesystem::create_directories((folder_.path() / path).parent_path());
    std::ofstream(folder_.path() / path) << text << '\n';
  }
  [[nodiscard]] std::uint64_t memory() const { return memory_of_control_group(folder_.path()); }

 private:
  test::TemporaryFolder folder_;
};

TEST_F(ControlGroup, OfABatchSystemLimitsByTheLeastAboveIt) {
  write("proc/self/cgroup", "0::/system.slice/job_7/step_0");
  write("sys/fs/cgroup/system.slice/memory.max", "max");
  write("sys/fs/cgroup/system.slice/job_7/memory.max", "2000000000");
  write("sys/fs/cgroup/system.slice/job_7/step_0/memory.max", "3000000000");
  EXPECT_EQ(memory(), 2000000000U);
}

TEST_F(ControlGroup, OfTheFirstVersionIsReadInItsOwnHierarchy) {
  write("proc/self/cgroup", "9:name=systemd:/\n4:cpu,memory:/work/job\n0::/");
  write("sys/fs/cgroup/memory/work/job/memory.limit_in_bytes", "500000000");
  write("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712");
  EXPECT_EQ(memory(), 500000000U);
}

TEST_F(ControlGroup, SeenFromInsideAContainerIsItsTop) {
  write("proc/self/cgroup", "0::/docker/0123456789");
  write("sys/fs/cgroup/memory.max", "700000000");
  EXPECT_EQ(memory(), 700000000U);
}

TEST_F(ControlGroup, WithoutALimitGivesNone) {
  EXPECT_EQ(memory(), 0U);
  write("proc/self/cgroup", "0::/user.slice\nno line of it");
  write("sys/fs/cgroup/user.slice/memory.max", "max");
  EXPECT_EQ(memory(), 0U);
}

}  // namespace
}  // namespace breccia::control_group_test
