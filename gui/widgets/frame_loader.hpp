#pragma once

#include <QFutureWatcher>
#include <QObject>
#include <QString>
#include <optional>

#include "render/frame_data.hpp"

namespace breccia::gui {

/// Reads frames on another thread. While one is read only the last of further requests is kept.
class FrameLoader final : public QObject {
  Q_OBJECT
 public:
  explicit FrameLoader(QObject* parent = nullptr);
  ~FrameLoader() override;
  /// Forgets the faces of the model: another run or mesh follows.
  void start_model();
  /// How frames requested from now on are drawn, until another model is started.
  /// @param scale      as of Deformation;  @param rest_file  the frame that displacements are counted from
  void set_deformation(double scale, const QString& rest_file);
  /// An automatic scale is found anew.
  void forget_scale() { scale_ = deformation_.scale = 1; }
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
  void keep(const Deformation& found);
  QFutureWatcher<FrameData> watcher_;
  std::shared_ptr<const Skin> faces_;
  std::optional<Wanted> next_;
  double scale_ = 1;          ///< requested
  bool finds_scale_ = false;  ///< of the frame that is read
  Deformation deformation_;   ///< with what was found for it
  int model_ = 0, loading_model_ = 0;
  bool telling_ = false;  ///< of a frame that has been read
};

}  // namespace breccia::gui
