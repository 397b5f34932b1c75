#pragma once

#include <QFutureWatcher>
#include <QObject>
#include <QString>
#include <optional>

#include "render/frame_data.hpp"

namespace breccia::gui {

/// Reads frames on another thread. While one is read only the last of those asked for meanwhile is remembered.
class FrameLoader final : public QObject {
  Q_OBJECT
 public:
  explicit FrameLoader(QObject* parent = nullptr);
  ~FrameLoader() override;
  /// Forgets the faces of the model: another run or mesh follows.
  void start_model();
  void load(const QString& elements_file, double time);
  [[nodiscard]] bool busy() const { return watcher_.isRunning(); }

 signals:
  void loaded(const FrameData& frame);

 private:
  struct Wanted {
    QString file;
    double time = 0;
  };
  void begin(const Wanted& wanted);
  QFutureWatcher<FrameData> watcher_;
  std::shared_ptr<const Skin> faces_;
  std::optional<Wanted> next_;
  int model_ = 0, loading_model_ = 0;
  bool telling_ = false;  ///< of a frame that has been read
};

}  // namespace breccia::gui
