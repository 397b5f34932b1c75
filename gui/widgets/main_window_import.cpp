#include <QFileDialog>
#include <QFileInfo>
#include <QInputDialog>
#include <QLabel>
#include <QMessageBox>

#include "core/geometry_import.hpp"
#include "widgets/main_window.hpp"

// A case made of a solid or a mesh from elsewhere.

namespace breccia::gui {

void MainWindow::import_geometry() {
  const QString file =
      QFileDialog::getOpenFileName(this, tr("Import a geometry"), places_.projects,
                                   tr("Solids and meshes (%1)").arg(geometry_patterns(false).join(' ')));
  if (file.isEmpty() || !may_leave_case()) return;
  imported_ = file;
  busy_->setText(tr("%1 is read and meshed...").arg(QFileInfo(file).fileName()));
  import_.ask(places_.launch.program, {"mesh", file, "--json"});
}

void MainWindow::join_import() {
  connect(&import_, &SolverQuery::answered, this, &MainWindow::take_geometry);
  connect(&import_, &SolverQuery::failed, this, [this](const QString& text, const std::vector<Problem>& problems) {
    QStringList words{text};
    for (const Problem& p : problems) words << QString::fromStdString(p.text());
    words.removeAll({});
    busy_->clear();
    QMessageBox::warning(this, tr("Import a geometry"), words.join('\n'));
  });
}

/// The solver has read it: a dialog requests the unit if the file does not state it.
void MainWindow::take_geometry(const QJsonObject& mesh) {
  busy_->clear();
  double metres = 1;
  if (needs_unit(imported_)) {
    const auto [x, y, z] = box_of_answer(mesh);
    QStringList choices;
    for (const LengthUnit& unit : length_units())
      choices << tr("%1: %2 x %3 x %4 m").arg(unit.name).arg(x * unit.metres).arg(y * unit.metres).arg(z * unit.metres);
    bool good = false;
    const QString chosen = QInputDialog::getItem(this, tr("Unit of the geometry"),
                                                 tr("%1 does not state the unit of its lengths.\nIts box is %2 x %3 x "
                                                    "%4. The model would be, with a unit of")
                                                     .arg(QFileInfo(imported_).fileName())
                                                     .arg(x)
                                                     .arg(y)
                                                     .arg(z),
                                                 choices, 0, false, &good);
    if (!good) return;
    metres = length_units()[static_cast<std::size_t>(std::max(0, static_cast<int>(choices.indexOf(chosen))))].metres;
  }
  QString error;
  const QString file = gui::import_geometry(imported_, mesh, metres, places_, &error);
  if (file.isEmpty()) {
    QMessageBox::warning(this, tr("Import a geometry"), error);
    return;
  }
  open_case(file);
}

}  // namespace breccia::gui
