#include "widgets/frame_loader.hpp"

#include <gtest/gtest.h>

#include <QDir>
#include <QFile>
#include <QImage>
#include <QTemporaryDir>
#include <QThread>
#include <vector>

#include "gui/block_case.hpp"
#include "widgets/animation_export.hpp"

namespace breccia::gui::test::frame_loader_test {
namespace {

constexpr int kPatience = 30000;  // ms

/// A loader and the times of the frames that it has told. Files that are not there give frames without a skin.
struct Told {
  FrameLoader loader;
  std::vector<double> times;
  Told() {
    QObject::connect(&loader, &FrameLoader::loaded, [this](const FrameData& frame) { times.push_back(frame.time); });
  }
};

TEST(FrameLoader, OfThoseThatAreAskedForWhileOneIsReadTheLastIsReadNext) {
  Told told;
  for (const double time : {1.0, 2.0, 3.0}) told.loader.load("/no/elements_1.vtkhdf", time);
  EXPECT_TRUE(wait_until([&] { return told.times == std::vector<double>{1, 3}; }, kPatience));
}

/// The one that waited used to be read last of all when the one being read had just ended.
TEST(FrameLoader, OneThatWaitedIsNotReadAfterOneThatWasAskedForLater) {
  Told told;
  told.loader.load("/no/elements_1.vtkhdf", 1);
  told.loader.load("/no/elements_1.vtkhdf", 2);
  while (told.loader.busy()) QThread::msleep(1);  // it has ended, which nobody has been told yet
  told.loader.load("/no/elements_1.vtkhdf", 3);
  EXPECT_TRUE(wait_until([&] { return !told.times.empty() && !told.loader.busy(); }, kPatience));
  EXPECT_FALSE(wait_until([&] { return told.times.back() != 3; }, 200));
}

TEST(FrameLoader, AFrameOfAModelThatWasLeftIsNotTold) {
  Told told;
  told.loader.load("/no/elements_1.vtkhdf", 1);
  told.loader.start_model();
  told.loader.load("/no/elements_2.vtkhdf", 2);
  EXPECT_TRUE(wait_until([&] { return !told.times.empty() && !told.loader.busy(); }, kPatience));
  EXPECT_EQ(told.times, std::vector<double>{2});
}

TEST(FrameLoader, WhatIsAskedForWhileAFrameIsToldIsReadAfterIt) {
  Told told;
  QObject::connect(&told.loader, &FrameLoader::loaded, [&](const FrameData& frame) {
    if (frame.time < 3) told.loader.load("/no/elements_1.vtkhdf", frame.time + 1);
  });
  told.loader.load("/no/elements_1.vtkhdf", 1);
  EXPECT_TRUE(wait_until([&] { return told.times == std::vector<double>{1, 2, 3}; }, kPatience));
}

/// A film of three frames, what it asks for and how it ends.
struct Film {
  QTemporaryDir scratch;
  AnimationExport film{{{"a", 1}, {"b", 2}, {"c", 3}}, scratch.filePath("film.mp4")};
  std::vector<double> wanted;
  int ends = 0;
  QString error;
  QImage picture{33, 21, QImage::Format_RGB32};  // odd: a film needs even numbers
  Film() {
    picture.fill(Qt::darkCyan);
    QObject::connect(&film, &AnimationExport::frame_wanted, [this](const QString&, double t) { wanted.push_back(t); });
    QObject::connect(&film, &AnimationExport::done, [this](const QString& why) {
      ++ends;
      error = why;
    });
  }
};

TEST(Film, FramesThatItHasNotAskedForAreLeftOutAndItsOwnAskedForAgain) {
  Film film;
  film.film.begin();
  film.film.take(2, film.picture);
  EXPECT_EQ(film.film.next(), 0);
  EXPECT_EQ(film.wanted, (std::vector<double>{1, 1})) << "the loader has forgotten it for the other one";
  film.film.take(1, film.picture);
  film.film.take(1, film.picture);
  EXPECT_EQ(film.film.next(), 1);
  EXPECT_EQ(film.wanted, (std::vector<double>{1, 1, 2, 2}));
  EXPECT_EQ(film.ends, 0);
}

TEST(Film, ItEndsWithTheReasonWhereAFrameDoesNotCome) {
  Film film;
  film.film.begin();
  film.film.give_up("the view shows something else");
  EXPECT_EQ(film.ends, 1);
  EXPECT_EQ(film.error, "the view shows something else");
}

TEST(Film, ThePicturesOfAllFramesBecomeOneFile) {
  Film film;
  film.film.begin();
  for (const double time : {1.0, 2.0, 3.0}) film.film.take(time, film.picture);
  ASSERT_TRUE(wait_until([&] { return film.ends == 1; }, kPatience));
  if (AnimationExport::program().isEmpty()) {
    EXPECT_FALSE(film.error.isEmpty()) << "there is no ffmpeg";
    return;
  }
  EXPECT_EQ(film.error, QString());
  EXPECT_GT(QFile(film.scratch.filePath("film.mp4")).size(), 0);
}

/// Without ffmpeg there was no film at all.
TEST(Film, PicturesAreKeptNumberedWhereAPictureIsAskedFor) {
  Film film;
  AnimationExport pictures({{"a", 1}, {"b", 2}}, film.scratch.filePath("fall.png"));
  QString error = "it has not ended";
  QObject::connect(&pictures, &AnimationExport::done, [&](const QString& why) { error = why; });
  pictures.begin();
  for (const double time : {1.0, 2.0}) pictures.take(time, film.picture);
  EXPECT_EQ(error, QString());
  EXPECT_EQ(QDir(film.scratch.path()).entryList({"*.png"}), (QStringList{"fall_000000.png", "fall_000001.png"}));
  EXPECT_EQ(QImage(film.scratch.filePath("fall_000001.png")).size(), film.picture.size());
}

TEST(Film, OfPicturesThatCannotBeWrittenTellsTheirName) {
  Film film;
  AnimationExport pictures({{"a", 1}}, film.scratch.filePath("nowhere/fall.png"));
  QString error;
  QObject::connect(&pictures, &AnimationExport::done, [&](const QString& why) { error = why; });
  pictures.begin();
  pictures.take(1, film.picture);
  EXPECT_TRUE(error.contains("nowhere/fall_000000.png")) << error.toStdString();
}

}  // namespace
}  // namespace breccia::gui::test::frame_loader_test
