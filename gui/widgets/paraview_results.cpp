#include "widgets/paraview_results.hpp"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QRegularExpression>
#include <QStandardPaths>
#include <filesystem>

#include "core/written_file.hpp"

/// Resources of a library are omitted unless they are initialised, outside of any namespace.
static void take_script() { Q_INIT_RESOURCE(paraview); }

namespace breccia::gui {

QString paraview_settings(const QString& users, const QString& version) {
  const QDir own(QDir(users).filePath("breccia"));
  const QString folder = own.filePath("ParaView");
  if (!QFileInfo::exists(folder)) {
    std::error_code error;  // the user may have no settings yet
    std::filesystem::create_directories(folder.toStdString(), error);
    std::filesystem::copy(QDir(users).filePath("ParaView").toStdString(), folder.toStdString(),
                          std::filesystem::copy_options::recursive, error);
  }
  QFile file(QDir(folder).filePath("ParaView" + version + ".ini"));
  if (!file.open(QIODevice::ReadWrite)) return own.path();
  if (!file.readAll().contains("ShowWelcomeDialog"))
    file.write("[General]\nGeneralSettings.ShowWelcomeDialog=false\n");  // at the end: a section may occur twice
  return own.path();
}

QByteArray ParaViewResults::script() {
  take_script();
  QFile file(":/paraview_results.py");
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

ParaViewResults::ParaViewResults(QObject* parent) : QObject(parent) {
  connect(&version_, qOverload<int, QProcess::ExitStatus>(&QProcess::finished), this, &ParaViewResults::start);
  connect(&version_, &QProcess::errorOccurred, this, [this](QProcess::ProcessError error) {
    if (error == QProcess::FailedToStart) emit failed(version_.errorString());
  });
}

void ParaViewResults::open(const QString& program, const QString& run, const QString& up, const QString& state) {
  if (version_.state() != QProcess::NotRunning) return;
  program_ = program;
  run_ = run;
  up_ = up;
  script_ = QDir(state).filePath("paraview_results.py");
  if (const QString error = written(script_, script()); !error.isEmpty()) return emit failed(error);
  version_.start(program_, {"--version"});
}

void ParaViewResults::start() {
  static const QRegularExpression number(R"(\d+\.\d+\.\d+)");
  const QString told = QString::fromUtf8(version_.readAllStandardOutput() + version_.readAllStandardError());
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert("XDG_CONFIG_HOME",
                     paraview_settings(QStandardPaths::writableLocation(QStandardPaths::GenericConfigLocation),
                                       number.match(told).captured(0)));
  environment.insert("BRECCIA_RESULTS", run_);
  environment.insert("BRECCIA_RESULTS_UP", up_);
  QProcess paraview;
  paraview.setProgram(program_);
  paraview.setArguments({"--script=" + script_});
  paraview.setWorkingDirectory(run_);
  paraview.setProcessEnvironment(environment);
  paraview.startDetached() ? emit started() : emit failed(paraview.errorString());
}

}  // namespace breccia::gui
