#pragma once

#include <QObject>
#include <QProcess>
#include <QString>

namespace breccia::gui {

/// Opens the frames of a run in ParaView with a view that is ready: bodies and joints coloured, the camera placed. It
/// starts ParaView as `breccia live` does, with settings of its own (a copy of the user's) that show no welcome.
class ParaViewResults final : public QObject {
  Q_OBJECT
 public:
  explicit ParaViewResults(QObject* parent = nullptr);
  /// Returns at once. @param run  folder;  @param up  "y", "-z"...;  @param state  folder of the desktop's own files
  void open(const QString& program, const QString& run, const QString& up, const QString& state);
  /// The script that prepares the view.
  [[nodiscard]] static QByteArray script();

 signals:
  void started();
  void failed(const QString& error);

 private:
  void start();

  QProcess version_;  ///< queries the version of ParaView, by which its settings are named
  QString program_, run_, up_, script_;
};

/// A folder of settings for ParaView that starts as a copy of the user's and shows no welcome; the user's own stay as
/// they are. What cannot be written is left out.
/// @param users    folder of the user's settings (XDG_CONFIG_HOME);  @param version  of ParaView: "5.11.0"
[[nodiscard]] QString paraview_settings(const QString& users, const QString& version);

}  // namespace breccia::gui
