#include "catalyst/animation.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "catalyst/child_process.hpp"

namespace breccia::insitu::animation_test {
namespace {

namespace fs = std::filesystem;

/// Two series of pictures in a folder whose name means something to glob, to a shell and to formats of numbers.
class Animations : public testing::Test {
 protected:
  void SetUp() override {
    if (!is_on_path("ffmpeg") || !is_on_path("ffprobe")) GTEST_SKIP() << "no ffmpeg";
    std::string pattern = (fs::temp_directory_path() / "breccia_animation_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    root_ = pattern;
    folder_ = root_ / "out [s], it's {a,b} 5 %d";
    fs::create_directories(folder_);
    const fs::path picture = root_ / "picture.png";
    static_cast<void>(
        output_of({"ffmpeg", "-nostdin", "-f", "lavfi", "-i", "color=c=red:s=32x32", "-frames:v", "1", picture}));
    for (const char* name : {"view_000001", "view_1000002", "view_top_000001", "view_top_000002", "view_top_000003"})
      fs::copy(picture, folder_ / (std::string(name) + ".png"));
  }
  void TearDown() override {
    if (!root_.empty()) fs::remove_all(root_);
  }
  /// Pictures of an animation, with those of the second for which the last one stays.
  [[nodiscard]] int frames_of(const std::string& name) const {
    return std::stoi(output_of({"ffprobe", "-v", "error", "-count_frames", "-select_streams", "v", "-show_entries",
                                "stream=nb_read_frames", "-of", "csv=p=0", (folder_ / name).string()}));
  }

  static constexpr int kLast = 3;
  fs::path root_, folder_;
};

TEST_F(Animations, HaveThePicturesOfTheirSeriesAndNoOthers) {
  const std::string lines = make_animations({folder_});
  EXPECT_EQ(lines.find("could not"), std::string::npos) << lines;
  EXPECT_EQ(frames_of("view.mp4"), 2 + kLast);
  EXPECT_EQ(frames_of("view_top.mp4"), 3 + kLast);
}

TEST_F(Animations, AreMadeInAFolderOfAPlainNameWithNumbersOfOneLength) {
  const fs::path plain = root_ / "plain";
  fs::create_directories(plain);
  for (const char* name : {"view_000001.png", "view_000002.png"}) fs::copy(root_ / "picture.png", plain / name);
  EXPECT_EQ(make_animations({plain}), "animation: " + (plain / "view.mp4").string());
}

TEST_F(Animations, AreMadeByTheLineThatIsToldWhereFfmpegIsMissing) {
  const std::string path = std::getenv("PATH"), before = "animation: apt-get install ffmpeg, then: ";
  setenv("PATH", "/nowhere", 1);
  const std::string line = make_animations({folder_});
  setenv("PATH", path.c_str(), 1);
  ASSERT_EQ(line.substr(0, before.size()), before);
  EXPECT_EQ(std::system(line.substr(before.size()).c_str()), 0) << line;
  EXPECT_EQ(frames_of("view.mp4"), 2 + kLast);
}

}  // namespace
}  // namespace breccia::insitu::animation_test
