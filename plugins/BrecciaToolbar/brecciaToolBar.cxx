#include "brecciaToolBar.h"

#include <dlfcn.h>

#include <QAction>
#include <QDir>
#include <QFileInfo>
#include <QIcon>

#include "pqPVApplicationCore.h"
#include "pqPythonManager.h"

namespace {

struct Picture {
  const char *name, *text, *help;
};

constexpr Picture kPictures[] = {
    {"cracks", "Cracks", "Faces of failed joints, by mode and by time of failure"},
    {"fragments", "Fragments", "Fragments by their diameter, and their sieve curve"},
    {"stress", "Stress", "Von Mises stress of the elements, Pa"},
    {"contacts", "Contacts", "Force chains between fragments, N"},
    {"energy", "Energy", "Terms of the energy budget over time, stacked, J"},
};

/// The macro beside the plugin Breccia, whose folder is beside this plugin's.
QString macroOf(const char* name) {
  Dl_info self{};
  if (dladdr(reinterpret_cast<const void*>(&macroOf), &self) == 0) return {};
  const QDir plugins = QFileInfo(QString::fromLocal8Bit(self.dli_fname)).absoluteDir();
  return plugins.absoluteFilePath(QString("../Breccia/Breccia_%1.py").arg(name));
}

}  // namespace

brecciaToolBar::brecciaToolBar(QWidget* parent) : QToolBar("Breccia", parent) {
  for (const Picture& picture : kPictures) {
    QAction* action = this->addAction(QIcon(QString(":/breccia/icons/%1.svg").arg(picture.name)), picture.text);
    action->setObjectName(QString("breccia_%1").arg(picture.name));
    action->setToolTip(QString("<b>%1</b><br>%2").arg(picture.text, picture.help));
    action->setStatusTip(picture.help);
    QObject::connect(action, &QAction::triggered, this, [name = picture.name]() {
      if (auto* python = pqPVApplicationCore::instance()->pythonManager())
        python->executeScriptAndRender(macroOf(name));
    });
  }
}
