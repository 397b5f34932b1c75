#include "widgets/frame_loader.hpp"

#include <QFileInfo>
#include <QtConcurrent>

namespace breccia::gui {

FrameLoader::FrameLoader(QObject* parent) : QObject(parent) {
  connect(&watcher_, &QFutureWatcher<FrameData>::finished, this, [this] {
    const FrameData frame = watcher_.result();
    if (loading_model_ == model_) {
      faces_ = frame.faces;
      telling_ = true;  // what is asked for meanwhile comes last, and is read
      emit loaded(frame);
      telling_ = false;
    }
    if (next_) {
      const Wanted wanted = *next_;
      next_.reset();
      begin(wanted);
    }
  });
}

FrameLoader::~FrameLoader() { watcher_.waitForFinished(); }

void FrameLoader::start_model() {
  faces_.reset();
  next_.reset();
  ++model_;
}

void FrameLoader::load(const QString& elements_file, double time) {
  if (watcher_.isRunning() || telling_) {
    next_ = Wanted{elements_file, time};
  } else {
    next_.reset();  // what is read may have ended without having been told yet
    begin({elements_file, time});
  }
}

void FrameLoader::begin(const Wanted& wanted) {
  loading_model_ = model_;
  QString joints = wanted.file;
  joints.replace("/elements_", "/joints_");
  if (!QFileInfo::exists(joints)) joints.clear();
  watcher_.setFuture(
      QtConcurrent::run([elements = wanted.file.toStdString(), joints = joints.toStdString(), time = wanted.time,
                         faces = faces_] { return load_frame(elements, joints, time, faces); }));
}

}  // namespace breccia::gui
