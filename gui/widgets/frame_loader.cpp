#include "widgets/frame_loader.hpp"

#include <QFileInfo>
#include <QtConcurrent>

namespace breccia::gui {

FrameLoader::FrameLoader(QObject* parent) : QObject(parent) {
  connect(&watcher_, &QFutureWatcher<FrameData>::finished, this, [this] {
    const FrameData frame = watcher_.result();
    if (loading_model_ == model_) {
      faces_ = frame.faces;
      keep(frame.deformation);
      telling_ = true;  // requests made meanwhile come last, and are read
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
  scale_ = 1;
  deformation_ = {};
  ++model_;
}

/// An automatic scale stays that of the frame for which it was found, so that frames can be compared.
void FrameLoader::set_deformation(double scale, const QString& rest_file) {
  if (scale == scale_) return;
  scale_ = deformation_.scale = scale;
  deformation_.rest_file = rest_file.toStdString();
}

/// Of a frame that has been read; another scale may have been requested meanwhile.
void FrameLoader::keep(const Deformation& found) {
  if (found.rest != nullptr) deformation_.rest = found.rest;
  deformation_.lacks_rest = deformation_.lacks_rest || found.lacks_rest;
  if (finds_scale_ && deformation_.scale == Deformation::kAutomatic) deformation_.scale = found.scale;
}

void FrameLoader::load(const QString& elements_file, double time) {
  if (watcher_.isRunning() || telling_) {
    next_ = Wanted{elements_file, time};
  } else {
    next_.reset();  // the current read may have ended without its result being delivered
    begin({elements_file, time});
  }
}

void FrameLoader::begin(const Wanted& wanted) {
  loading_model_ = model_;
  finds_scale_ = deformation_.scale == Deformation::kAutomatic;
  QString joints = wanted.file;
  joints.replace("/elements_", "/joints_");
  if (!QFileInfo::exists(joints)) joints.clear();
  watcher_.setFuture(QtConcurrent::run(
      [elements = wanted.file.toStdString(), joints = joints.toStdString(), time = wanted.time, faces = faces_,
       deformation = deformation_] { return load_frame(elements, joints, time, faces, deformation); }));
}

}  // namespace breccia::gui
