#include "core/report_maker.hpp"

namespace breccia::gui {

ReportMaker::ReportMaker(QObject* parent) : QObject(parent) {
  connect(&process_, &QProcess::errorOccurred, this, [this](QProcess::ProcessError error) {
    if (error == QProcess::FailedToStart) emit done(file_, process_.errorString(), {});
  });
  connect(&process_, qOverload<int, QProcess::ExitStatus>(&QProcess::finished), this,
          [this](int code, QProcess::ExitStatus status) {
            if (cancelled_) return;
            const QString words = QString::fromUtf8(process_.readAllStandardError()).trimmed();
            const bool good = code == 0 && status == QProcess::NormalExit;
            const QString error = good ? QString() : words.isEmpty() ? tr("%1 ended").arg(process_.program()) : words;
            emit done(file_, error, good ? words : QString());
          });
}

ReportMaker::~ReportMaker() {
  process_.disconnect(this);
  cancel();
}

void ReportMaker::make(const QString& program, const QString& run_folder, const QString& file) {
  file_ = file;
  cancelled_ = false;
  process_.start(program, {"report", run_folder, "-o", file});
}

/// The solver ends ParaView, which draws the pictures for it, when it is requested to end.
void ReportMaker::cancel() {
  if (!busy()) return;
  cancelled_ = true;
  constexpr int kPatience = 3000;  // ms
  process_.terminate();
  if (!process_.waitForFinished(kPatience)) process_.kill();
}

}  // namespace breccia::gui
