#include "widgets/animation_export.hpp"

#include <QFileInfo>
#include <QStandardPaths>

namespace breccia::gui {
namespace {

constexpr int kRate = 12;  // pictures a second

}  // namespace

AnimationExport::AnimationExport(std::vector<RunFrame> frames, QString file, QObject* parent)
    : QObject(parent), frames_(std::move(frames)), file_(std::move(file)) {
  connect(&process_, qOverload<int, QProcess::ExitStatus>(&QProcess::finished), this, [this](int code, auto status) {
    const bool good = code == 0 && status == QProcess::NormalExit;
    emit done(good ? QString() : QString::fromUtf8(process_.readAllStandardError()).trimmed().right(600));
  });
  connect(&process_, &QProcess::errorOccurred, this, [this](QProcess::ProcessError error) {
    if (error == QProcess::FailedToStart) emit done(process_.errorString());
  });
}

AnimationExport::~AnimationExport() {
  process_.disconnect(this);  // a film that is no longer waited for
  process_.kill();
  process_.waitForFinished(1000);
}

QString AnimationExport::program() { return QStandardPaths::findExecutable("ffmpeg"); }

bool AnimationExport::keeps_pictures() const { return file_.endsWith(".png", Qt::CaseInsensitive); }

QString AnimationExport::picture_file(int number) const {
  const QString digits = number < 0 ? QString("%06d") : QString("%1").arg(number, 6, 10, QChar('0'));
  const QFileInfo kept(file_);
  return keeps_pictures() ? kept.dir().filePath(kept.completeBaseName() + "_" + digits + ".png")
                          : pictures_.filePath(digits + ".png");
}

void AnimationExport::begin() {
  next_ = 0;
  emit frame_wanted(frames_.front().file, frames_.front().time);
}

void AnimationExport::take(double time, const QImage& picture) {
  if (next_ >= static_cast<int>(frames_.size())) return;
  const RunFrame& wanted = frames_[static_cast<std::size_t>(next_)];
  if (wanted.time != time) {  // another one was requested meanwhile, which replaced this one
    emit frame_wanted(wanted.file, wanted.time);
    return;
  }
  if (const QString name = picture_file(next_); !picture.save(name)) {
    emit done(tr("%1 cannot be written").arg(name));
    return;
  }
  ++next_;
  emit progress(tr("animation: picture %1 of %2").arg(next_).arg(frames_.size()));
  if (next_ == static_cast<int>(frames_.size())) {
    keeps_pictures() ? emit done({}) : put_together();
    return;
  }
  const RunFrame& frame = frames_[static_cast<std::size_t>(next_)];
  emit frame_wanted(frame.file, frame.time);
}

void AnimationExport::put_together() {
  emit progress(tr("animation: ffmpeg makes the film"));
  // Films want even numbers of pixels; yuv420p is what every player knows.
  process_.start(program(), {"-nostdin", "-y", "-loglevel", "error", "-framerate", QString::number(kRate), "-i",
                             picture_file(-1), "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", file_});
}

}  // namespace breccia::gui
