#include "system/child_process.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "system/interruption.hpp"

namespace breccia::child_process_test {
namespace {

namespace fs = std::filesystem;

fs::path scratch_folder() {
  std::string pattern = (fs::temp_directory_path() / "breccia_child_XXXXXX").string();
  return ::mkdtemp(pattern.data());
}

ChildEnd end_of(const std::function<std::vector<std::byte>()>& work, ChildLimits limits = {}) {
  return run_in_child(
      limits, [] {}, work);
}

TEST(ChildProcess, BringsAResultLargerThanAPipe) {
  const ChildEnd end = end_of([] { return std::vector<std::byte>(5'000'000, std::byte{7}); });
  EXPECT_EQ(end.kind, ChildEnd::Kind::finished);
  EXPECT_EQ(end.result, std::vector<std::byte>(5'000'000, std::byte{7}));
}

TEST(ChildProcess, KeepsNoDescriptorOfTheParentsButTheOneThatItIsGiven) {
  const auto open_in_child = [](int kept) {
    const ChildEnd end = end_of(
        [] {
          std::vector<std::byte> open;
          for (int d = 0; d < 64; ++d) {
            if (::fcntl(d, F_GETFD) >= 0) open.push_back(static_cast<std::byte>(d));
          }
          return open;
        },
        {.kept = kept});
    return end.result;
  };
  const std::vector<std::byte> own{std::byte{0}, std::byte{1}, std::byte{2}, std::byte{3}};
  EXPECT_EQ(open_in_child(-1), own);
  const int descriptor = ::open("/dev/null", O_RDONLY);
  std::vector<std::byte> with_kept = own;
  with_kept.push_back(static_cast<std::byte>(kKeptDescriptor));
  EXPECT_EQ(open_in_child(descriptor), with_kept);
  ::close(descriptor);
}

TEST(ChildProcess, TellsHowItCrashed) {
  const ChildEnd end = end_of([]() -> std::vector<std::byte> {
    std::fprintf(stderr, "first\nthe last words\n");
    std::abort();
  });
  EXPECT_EQ(end.kind, ChildEnd::Kind::crashed);
  EXPECT_EQ(end.signal, SIGABRT);
  EXPECT_EQ(end.text, "the last words");
}

TEST(ChildProcess, IsEndedByEverySignalThatARunOnlyTakesNoteOf) {
  for (const int signal : kEndingSignals) {
    const auto before = std::signal(signal, [](int) {});
    const ChildEnd end = end_of([signal]() -> std::vector<std::byte> {
      std::raise(signal);
      return {};
    });
    std::signal(signal, before);
    EXPECT_EQ(end.kind, ChildEnd::Kind::crashed) << signal;
    EXPECT_EQ(end.signal, signal);
  }
}

TEST(ChildProcess, LeavingWithoutAResultIsACrash) {
  const ChildEnd end = end_of([]() -> std::vector<std::byte> { std::_Exit(0); });
  EXPECT_EQ(end.kind, ChildEnd::Kind::crashed);
  EXPECT_EQ(end.signal, 0);
}

TEST(ChildProcess, MayReadButNotWriteRunOrConnect) {
  const auto folder = scratch_folder();
  const std::string file = (folder / "there").string();
  std::ofstream(file) << "text";
  const auto nothing = std::vector<std::byte>{};
  const auto kind = [&](const std::function<void()>& attempt) {
    return end_of([&] {
      attempt();
      return nothing;
    });
  };
  EXPECT_EQ(kind([&] { std::ifstream(file).get(); }).kind, ChildEnd::Kind::finished);
  const ChildEnd written = kind([&] { std::ofstream(file) << "x"; });
  EXPECT_EQ(written.kind, ChildEnd::Kind::forbidden);
  EXPECT_EQ(written.text, "open a file for writing: " + file);
  EXPECT_EQ(kind([&] { std::remove(file.c_str()); }).kind, ChildEnd::Kind::forbidden);
  EXPECT_EQ(kind([&] { std::rename(file.c_str(), (file + "2").c_str()); }).kind, ChildEnd::Kind::forbidden);
  EXPECT_EQ(kind([&] { ::mkdir((file + "3").c_str(), 0700); }).kind, ChildEnd::Kind::forbidden);
  EXPECT_EQ(kind([&] { (void)!std::system("true"); }).kind, ChildEnd::Kind::forbidden);
  EXPECT_EQ(kind([&] { ::execl("/bin/true", "true", nullptr); }).text, "run a program: /bin/true");
  EXPECT_EQ(kind([&] { (void)::socket(AF_INET, SOCK_STREAM, 0); }).text, "open a network connection");
  EXPECT_EQ(kind([&] { (void)::socket(AF_UNIX, SOCK_STREAM, 0); }).kind, ChildEnd::Kind::forbidden);
  EXPECT_EQ(kind([&] { (void)::fork(); }).kind, ChildEnd::Kind::forbidden);
  EXPECT_EQ(kind([&] { ::kill(::getppid(), SIGUSR2); }).kind, ChildEnd::Kind::forbidden);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator{}), 1) << "the file that was there";
  std::ifstream left(file);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(left), {}), "text");
  fs::remove_all(folder);
}

TEST(ChildProcess, ReadsNothingOutsideTheFoldersItIsGiven) {
  const auto folder = scratch_folder(), other = scratch_folder();
  std::ofstream(folder / "inside") << "text";
  std::ofstream(other / "outside") << "secret";
  fs::create_symlink(other / "outside", folder / "link");
  const auto first_letter = [&](const fs::path& file) {
    const ChildEnd end =
        end_of([&] { return std::vector{static_cast<std::byte>(std::ifstream(file).get())}; }, {.readable = {folder}});
    return end.result.empty() ? '?' : static_cast<char>(end.result.front());
  };
  constexpr char kUnread = static_cast<char>(std::char_traits<char>::eof());
  EXPECT_EQ(first_letter(folder / "inside"), 't');
  if (first_letter(other / "outside") == 's') GTEST_SKIP() << "this kernel has no Landlock";
  EXPECT_EQ(first_letter(other / "outside"), kUnread);
  EXPECT_EQ(first_letter(folder / "link"), kUnread);
  EXPECT_EQ(first_letter(folder / ".." / other.filename() / "outside"), kUnread);
  EXPECT_EQ(first_letter("/etc/hostname"), kUnread);
  EXPECT_EQ(first_letter("/proc/self/environ"), kUnread);
  fs::remove_all(folder);
  fs::remove_all(other);
}

}  // namespace
}  // namespace breccia::child_process_test
