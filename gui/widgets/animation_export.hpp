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

/// Makes an animation of the frames: requests each frame, stores its picture, and runs ffmpeg in a separate process; or
/// keeps the numbered pictures, which needs no ffmpeg.
class AnimationExport final : public QObject {
  Q_OBJECT
 public:
  /// @param file  NAME.mp4: the film; NAME.png: NAME_000000.png and so on
  AnimationExport(std::vector<RunFrame> frames, QString file, QObject* parent = nullptr);
  ~AnimationExport() override;
  /// The program that makes films; empty: it is not here.
  [[nodiscard]] static QString program();

  void begin();
  /// A frame has been drawn; it is stored if it is the requested one, else that is requested again.
  /// @param time  of the frame, s
  void take(double time, const QImage& picture);
  /// The requested frame cannot be drawn.
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
