#pragma once

#include <QDir>
#include <QImage>
#include <QObject>
#include <QProcess>
#include <QTemporaryDir>
#include <vector>

#include "core/own_files.hpp"
#include "core/run_folder.hpp"

namespace breccia::gui {

/// Makes a film of pictures that are shown one after the other: asks for each frame, takes its picture, and lets ffmpeg
/// put them together in a process of its own; or keeps the pictures, numbered, which needs no ffmpeg.
class AnimationExport final : public QObject {
  Q_OBJECT
 public:
  /// @param file  NAME.mp4: the film; NAME.png: NAME_000000.png and so on
  AnimationExport(std::vector<RunFrame> frames, QString file, QObject* parent = nullptr);
  ~AnimationExport() override;
  /// The program that makes films; empty: it is not here.
  [[nodiscard]] static QString program();

  void begin();
  /// A frame has been drawn; it is taken if it is the one that was asked for, else that is asked for again.
  /// @param time  of the frame, s
  void take(double time, const QImage& picture);
  /// No picture of the frame that was asked for will come.
  void give_up(const QString& why) { emit done(why); }
  [[nodiscard]] int next() const { return next_; }

 signals:
  void frame_wanted(const QString& file, double time);
  void progress(const QString& words);
  /// @param error  empty: the film is there
  void done(const QString& error);

 private:
  void put_together();
  [[nodiscard]] bool keeps_pictures() const;
  /// @param number  from 0; < 0: the pattern by which ffmpeg counts
  [[nodiscard]] QString picture_file(int number) const;
  std::vector<RunFrame> frames_;
  QString file_;
  QTemporaryDir pictures_{QDir::temp().filePath(own_name("film") + "-XXXXXX")};
  QProcess process_;
  int next_ = 0;
};

}  // namespace breccia::gui
