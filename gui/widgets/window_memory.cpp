#include "widgets/window_memory.hpp"

#include <QCoreApplication>
#include <QDir>

namespace breccia::gui {
namespace {

constexpr const char *kDark = "dark", *kGeometry = "geometry", *kLayout = "layout";

}  // namespace

WindowMemory::WindowMemory(const QString& state_folder)
    : kept_(QDir(state_folder).filePath("window.ini"), QSettings::IniFormat) {}

std::optional<bool> WindowMemory::dark() const {
  const QString word = kept_.value(kDark).toString();
  return word == "true" || word == "false" ? std::optional(word == "true") : std::nullopt;
}

void WindowMemory::set_dark(bool dark) { kept_.setValue(kDark, dark); }

QByteArray WindowMemory::geometry() const { return kept_.value(kGeometry).toByteArray(); }

QByteArray WindowMemory::layout() const { return kept_.value(kLayout).toByteArray(); }

void WindowMemory::set_arrangement(const QByteArray& geometry, const QByteArray& layout) {
  kept_.setValue(kGeometry, geometry);
  kept_.setValue(kLayout, layout);
  kept_.sync();
}

QString WindowMemory::error() {
  kept_.sync();
  return kept_.status() == QSettings::NoError
             ? QString()
             : QCoreApplication::translate("window", "%1 cannot be written").arg(kept_.fileName());
}

}  // namespace breccia::gui
