#include "system/shared_file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <string>

#include "unit/output/temporary_folder.hpp"

namespace breccia {
namespace {

bool file_system_reserves = true;

}  // namespace
}  // namespace breccia

/// Goes before the C library's in this program: a file system that reserves nothing, such as NFS 3, where asked.
extern "C" int fallocate(int descriptor, int mode, off_t offset, off_t size) {
  if (breccia::file_system_reserves) return static_cast<int>(syscall(SYS_fallocate, descriptor, mode, offset, size));
  errno = EOPNOTSUPP;
  return -1;
}

namespace breccia {
namespace {

std::string written(bool reserves) {
  file_system_reserves = reserves;
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "file";
  std::ofstream(path) << "0123456789";  // as a checkpoint, whose structure is there before its data
  SharedFile file(path, path, 0);
  file.reserve(20);
  const std::string text = "abc";
  file.write_at(10, std::as_bytes(std::span(text)));
  file.finish();
  file_system_reserves = true;
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(SharedFile, HasTheRoomItReserved) { EXPECT_EQ(written(true), "0123456789abc" + std::string(7, '\0')); }

TEST(SharedFile, IsWrittenAlsoWhereNothingCanBeReserved) { EXPECT_EQ(written(false), "0123456789abc"); }

}  // namespace
}  // namespace breccia
