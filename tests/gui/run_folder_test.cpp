#include "core/run_folder.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QTemporaryDir>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/run_case.hpp"

namespace breccia::gui::run_folder_test {
namespace {

void append(const QString& file, const QByteArray& text) {
  QFile out(file);
  ASSERT_TRUE(out.open(QIODevice::Append));
  out.write(text);
}

TEST(RunFolder, TheProgressOfARunIsWhatItSaidLast) {
  const QTemporaryDir scratch;
  RunProgress progress(scratch.path());
  EXPECT_TRUE(progress.look().state.isEmpty());
  const QString file = scratch.filePath("status.jsonl");
  append(file, "{\"state\":\"running\",\"share\":0.25,\"eta_s\":60}\n{\"event\":\"frame\"}\n");
  EXPECT_EQ(progress.look().share, 0.25);
  EXPECT_EQ(progress.look().eta, 60) << "nothing new";
  append(file, "{\"state\":\"running\",\"share\":0.5,\"eta_s\":40}\n");
  EXPECT_EQ(progress.look().share, 0.5);
}

TEST(RunFolder, CheckpointsAreListedLatestFirst) {
  const QTemporaryDir scratch;
  ASSERT_TRUE(QDir(scratch.path()).mkpath("checkpoints"));
  for (const char* name : {"step_000000900.h5", "step_000010000.h5", "step_2.h5.partial", "other.h5"})
    append(scratch.filePath(QString("checkpoints/") + name), "x");
  const auto found = read_checkpoints(scratch.path());
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].step, 10000);
  EXPECT_EQ(found[1].step, 900);
}

TEST(RunFolder, EventsAndRubbishAreNoStatus) {
  RunStatus status;
  EXPECT_FALSE(read_status("{\"event\":\"pause\",\"accepted\":true}", status));
  EXPECT_FALSE(read_status("rubbish", status));
  EXPECT_FALSE(read_status("", status));
}

TEST(RunFolder, AnUnknownEndIsToldFromNone) {
  RunStatus status;
  ASSERT_TRUE(read_status("{\"state\":\"running\",\"eta_s\":null,\"broken_joints\":12}", status));
  EXPECT_LT(status.eta, 0);
  EXPECT_EQ(status.broken_joints, 12);
  ASSERT_TRUE(read_status("{\"state\":\"running\",\"eta_s\":3.5}", status));
  EXPECT_EQ(status.eta, 3.5);
}

TEST(RunFolder, HistoryGrowsByWholeRows) {
  History history;
  for (const char* line : {"step,time [s],kinetic [J]", "0,0,1.5", "1,1e-6", "2,2e-6,nan"}) history.add_line(line);
  EXPECT_EQ(history.rows(), 2);
  EXPECT_EQ(history.column("kinetic [J]"), 2);
  EXPECT_EQ(history.values(2)[0], 1.5);
  EXPECT_TRUE(std::isnan(history.values(2)[1]));
}

TEST(RunFolder, HistoriesOfSeveralRunsStandBesideEachOther) {
  History one, two;
  for (const char* line : {"time [s],kinetic [J]", "0,1.5", "1e-6,2"}) one.add_line(line);
  for (const char* line : {"time [s]", "0"}) two.add_line(line);
  EXPECT_EQ(histories_csv({{"a", &one}}), "time [s],kinetic [J]\n0,1.5\n9.9999999999999995e-07,2\n");
  EXPECT_EQ(histories_csv({{"a, b", &one}, {"c", &two}}),
            "\"a, b: time [s]\",\"a, b: kinetic [J]\",c: time [s]\n0,1.5,0\n9.9999999999999995e-07,2,\n");
}

TEST(RunFolder, FramesWhoseFileIsThereAreListed) {
  const QTemporaryDir scratch;
  ASSERT_TRUE(QDir(scratch.path()).mkpath("frames"));
  append(scratch.filePath("frames/elements_000000.vtkhdf"), "x");
  append(scratch.filePath("frames/elements.hdf.series"),
         R"({"files":[{"name":"elements_000000.vtkhdf","time":0.5},{"name":"elements_000001.vtkhdf","time":1}]})");
  const auto frames = read_series(scratch.path(), "elements");
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].time, 0.5);
}

TEST(RunFolder, RunsBesideACaseAreOfThatCaseAndHaveWrittenSomethingAndTheNewestIsFirst) {
  const QTemporaryDir scratch;
  const QString file = scratch.filePath("case.toml");
  EXPECT_TRUE(runs_beside(file).empty());
  const QStringList runs{"case-20261126-100000", "case-20261126-100000-2", "case-20261127-090000",
                         "case-2-20261128-090000", "case-20261129-090000-study"};
  for (const QString& name : runs) {
    ASSERT_TRUE(QDir(scratch.path()).mkpath("runs/" + name));
    QFile out(scratch.filePath("runs/" + name + "/provenance.json"));
    if (name.startsWith("case-20261127")) continue;  // it was stopped before it wrote anything
    ASSERT_TRUE(out.open(QIODevice::WriteOnly));
    out.write(R"({"program": "breccia"})");
  }
  const auto named = runs_beside(file);
  ASSERT_EQ(named.size(), 2U);
  EXPECT_EQ(named[0].folder, scratch.filePath("runs/case-20261126-100000-2"));
  // One that was started in a terminal has any name, and tells when and of what it is.
  for (const char* const name : {"try", "of_another"}) {
    const bool is_own = name == std::string("try");
    ASSERT_TRUE(QDir(scratch.path()).mkpath(QString("runs/%1").arg(name)));
    append(scratch.filePath(QString("runs/%1/provenance.json").arg(name)),
           R"({"program": "breccia", "started": "2026-11-30T10:00:00Z", "ranks": 4, "inputs": [{"file": "/a/a.geo"}, )"
           R"({"file": "/a/)" +
               QByteArray(is_own ? "case.toml" : "other.toml") + R"("}]})");
  }
  const auto all = runs_beside(file);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].folder, scratch.filePath("runs/try"));
  EXPECT_EQ(all[0].ranks, 4);
  EXPECT_EQ(all[0].started, QDateTime::fromString("2026-11-30T12:00:00+02:00", Qt::ISODate));
}

/// A folder that comes from somebody else.
TEST(RunFolder, NoLinkAndNoPipeOfAFolderIsOpened) {
  const QTemporaryDir scratch;
  const QString outside = scratch.filePath("outside"), run = scratch.filePath("run");
  append(outside, "{\"program\":\"breccia\",\"state\":\"running\",\"files\":[{\"name\":\"a.vtkhdf\",\"time\":1}]}\n");
  QDir().mkpath(run + "/frames");
  for (const char* name : {"/status.jsonl", "/provenance.json", "/case.toml", "/frames/elements.hdf.series"}) {
    const QByteArray file = QFile::encodeName(run + name);
    for (const bool linked : {true, false}) {
      QFile::remove(run + name);
      ASSERT_EQ(linked ? ::symlink(QFile::encodeName(outside).constData(), file.constData())
                       : ::mkfifo(file.constData(), 0600),
                0);
      EXPECT_TRUE(RunProgress(run).look().state.isEmpty()) << name;
      EXPECT_FALSE(is_run_folder(run)) << name;
      EXPECT_TRUE(case_text_of(run).isEmpty()) << name;
      EXPECT_TRUE(read_series(run, "elements").empty()) << name;
    }
  }
}

/// All that opening a run's folder reads.
void expect_nothing_from_outside(const QString& run, const std::string& where) {
  EXPECT_TRUE(RunProgress(run).look().state.isEmpty()) << where;
  EXPECT_FALSE(case_text_of(run).contains("secret")) << where;
  EXPECT_FALSE(was_run_with_another(run, "")) << where;
  EXPECT_FALSE(is_held(run)) << where;
  EXPECT_FALSE(origin_of(run).case_file.contains("secret")) << where;
  for (const char* part : {"elements", "joints", "contacts"}) EXPECT_TRUE(read_series(run, part).empty()) << where;
  for (const RunCheckpoint& checkpoint : read_checkpoints(run)) EXPECT_EQ(checkpoint.step, 900) << where;
  (void)writes_elements(run);
  (void)is_run_folder(run);
}

TEST(RunFolder, WhateverStandsUnderItsNamesDoesNotHangItsReaders) {
  const QTemporaryDir scratch;
  const QString outside = scratch.filePath("outside"), run = scratch.filePath("run");
  const QByteArray secret =
      "{\"state\":\"running\",\"program\":\"breccia\",\"inputs\":[{\"file\":\"secret\"}],\"files\":[{\"name\":"
      "\"step_000000000777.h5\",\"time\":1}]}\nsecret\n1,2\n";
  QDir().mkpath(outside);
  append(outside + "/step_000000000777.h5", secret);
  append(outside + "/elements.hdf.series", secret);
  append(scratch.filePath("secret"), secret);
  for (const char* name :
       {"status.jsonl", "provenance.json", "case.toml", "history.csv", "bodies.csv", "summary.json", "summary.txt",
        "run.lock", "control", "extracts.csv", "frames", "checkpoints", "extracts", "frames/elements.hdf.series",
        "frames/joints.hdf.series", "checkpoints/step_000000000900.h5"}) {
    const std::vector<std::pair<const char*, std::function<void(const char*)>>> kinds{
        {"link to a file",
         [&](const char* at) { (void)!::symlink(QFile::encodeName(scratch.filePath("secret")).constData(), at); }},
        {"link to a folder", [&](const char* at) { (void)!::symlink(QFile::encodeName(outside).constData(), at); }},
        {"dangling link", [](const char* at) { (void)!::symlink("/nonexistent/file", at); }},
        {"endless device", [](const char* at) { (void)!::symlink("/dev/zero", at); }},
        {"pipe", [](const char* at) { ::mkfifo(at, 0600); }},
        {"folder", [](const char* at) { ::mkdir(at, 0700); }}};
    for (const auto& [kind, make] : kinds) {
      QDir(run).removeRecursively();
      QDir().mkpath(QFileInfo(run + "/" + name).path());
      make(QFile::encodeName(run + "/" + name).constData());
      expect_nothing_from_outside(run, std::string(kind) + " under " + name);
    }
  }
}

TEST(RunFolder, NoFrameOutsideItIsListed) {
  const QTemporaryDir scratch;
  const QString frames = scratch.filePath("run/frames");
  QDir().mkpath(frames);
  append(scratch.filePath("outside.vtkhdf"), "x");
  append(frames + "/own.vtkhdf", "x");
  ASSERT_TRUE(QFile::link(scratch.filePath("outside.vtkhdf"), frames + "/linked.vtkhdf"));
  append(frames + "/elements.hdf.series",
         "{\"files\":[{\"name\":\"own.vtkhdf\",\"time\":1},{\"name\":\"linked.vtkhdf\",\"time\":2},"
         "{\"name\":\"../../outside.vtkhdf\",\"time\":3}]}");
  const std::vector<RunFrame> found = read_series(scratch.filePath("run"), "elements");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].time, 1);
}

}  // namespace
}  // namespace breccia::gui::run_folder_test
