#include <QDesktopServices>
#include <QMessageBox>
#include <QProcess>
#include <QUrl>

#include "core/value_text.hpp"
#include "widgets/main_window.hpp"

namespace breccia::gui {

/// Opens the page of the guide for the section of the form, which the solver finds.
void MainWindow::open_guide() {
  const std::string section = case_::plain_path(form_->section().toStdString());
  const QString topic = document_.is_open() ? text_of(section.substr(0, section.find('.'))) : QString();
  auto* asking = new QProcess(this);
  const auto refuse = [this](const QString& why) { QMessageBox::information(this, tr("Guide"), why); };
  connect(asking, &QProcess::errorOccurred, this, [asking, refuse](QProcess::ProcessError error) {
    if (error != QProcess::FailedToStart) return;
    refuse(asking->errorString());
    asking->deleteLater();
  });
  connect(asking, qOverload<int, QProcess::ExitStatus>(&QProcess::finished), this, [asking, refuse](int code) {
    const QString address = QString::fromUtf8(asking->readAllStandardOutput()).trimmed();
    if (code != 0)
      refuse(QString::fromUtf8(asking->readAllStandardError()).trimmed());
    else if (!QDesktopServices::openUrl(QUrl(address)))
      refuse(tr("No browser opens %1").arg(address));
    asking->deleteLater();
  });
  asking->start(places_.launch.program, {"guide", "--address", topic});
}

}  // namespace breccia::gui
