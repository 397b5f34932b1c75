#include <QVTKOpenGLNativeWidget.h>
#include <gtest/gtest.h>
#include <vtkLogger.h>

#include <QSurfaceFormat>
#include <clocale>

#include "gui/timed_application.hpp"
#include "widgets/theme.hpp"

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  QSurfaceFormat::setDefaultFormat(QVTKOpenGLNativeWidget::defaultFormat());
  const breccia::gui::test::TimedApplication application(argc, argv);
  std::setlocale(LC_NUMERIC, "C");
  breccia::gui::apply_theme(false);
  return RUN_ALL_TESTS();
}
