#include <QVTKOpenGLNativeWidget.h>

#include <QApplication>
#include <QCommandLineParser>
#include <QFile>
#include <QIcon>
#include <QSurfaceFormat>
#include <clocale>

#include "core/run_queue.hpp"
#include "widgets/main_window.hpp"
#include "widgets/theme.hpp"

int main(int argc, char** argv) {
  // Frames are written once; a file system may have no locks.
  if (!qEnvironmentVariableIsSet("HDF5_USE_FILE_LOCKING")) qputenv("HDF5_USE_FILE_LOCKING", "FALSE");
  // The worker of the queue has no window and needs no display.
  if (argc == 3 && QByteArray(argv[1]) == "--work-queue") {
    const QCoreApplication worker(argc, argv);
    return breccia::gui::work_queue(QFile::decodeName(argv[2]));
  }
  QSurfaceFormat::setDefaultFormat(QVTKOpenGLNativeWidget::defaultFormat());
#if QT_VERSION < QT_VERSION_CHECK(6, 0, 0)
  QApplication::setAttribute(Qt::AA_EnableHighDpiScaling);
  QApplication::setAttribute(Qt::AA_UseHighDpiPixmaps);
#endif
  QApplication application(argc, argv);
  std::setlocale(LC_NUMERIC, "C");
  QApplication::setApplicationName("breccia-gui");
  QApplication::setApplicationDisplayName("Breccia");
  QApplication::setDesktopFileName("breccia");
  QApplication::setWindowIcon(QIcon(":/breccia.svg"));
  QCommandLineParser arguments;
  arguments.setApplicationDescription("Set up, run and watch cases of Breccia.");
  arguments.addHelpOption();
  arguments.addPositionalArgument("path", "a case file, or the folder of a run");
  const QCommandLineOption dark("dark", "dark colours");
  arguments.addOption(dark);
  arguments.process(application);

  const bool system_is_dark = breccia::gui::system_is_dark();
  breccia::gui::apply_theme(system_is_dark);
  breccia::gui::MainWindow window(breccia::gui::Places::of_this_machine());
  if (arguments.isSet(dark) || (system_is_dark && !window.remembers_colours())) window.set_dark(true);
  window.show();
  if (arguments.positionalArguments().isEmpty()) {
    window.offer_recovery();
  } else {
    window.open_path(arguments.positionalArguments().first());
  }
  return QApplication::exec();
}
