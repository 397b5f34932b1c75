#pragma once

#include <QCoreApplication>
#include <QElapsedTimer>
#include <QFile>
#include <QTemporaryDir>
#include <QThread>
#include <functional>

/// What tests of the desktop have in common.
namespace breccia::gui::test {

/// A block of concrete at rest. @param cells  along each edge, of 24 elements each
inline QByteArray block_case(int cells, const QByteArray& end) {
  return QString(R"(title = "block"
[mesh.raster]
cells = [%1, %1, %1]
cell_size = "10 mm"
group = "block"
[[material]]
group = "block"  # mine
young = "40 GPa"
poisson = 0.2
density = 2400
[[joint]]
group = "block"
tensile_strength = "5 MPa"
energy_mode_1 = "100 J/m2"
[[stage]]
end = "%2"
)")
      .arg(cells)
      .arg(QString::fromUtf8(end))
      .toUtf8();
}

/// The same, torn by its rotation; 1 ms takes a second or two.
inline QByteArray turning_case(const QByteArray& end) {
  return block_case(4, end) + R"([[initial_velocity]]
group = "block"
angular = [0, 0, 20000]
[output]
frame_interval = "100 us"
history_interval = "100 us"
)";
}

/// Returns the name of the file.
inline QString written_case(const QTemporaryDir& scratch, const QByteArray& text) {
  const QString name = scratch.filePath("case.toml");
  QFile out(name);
  return out.open(QIODevice::WriteOnly) && out.write(text) == text.size() ? name : QString();
}

/// A program that never says anything, as the solver while it reads a mesh.
inline QString silent_program(const QTemporaryDir& scratch) {
  const QString name = scratch.filePath("silent");
  QFile out(name);
  if (!out.open(QIODevice::WriteOnly)) return {};
  out.write("#!/bin/sh\nexec sleep 600\n");
  out.setPermissions(out.permissions() | QFile::ExeOwner);
  return name;
}

/// Events are handled meanwhile.
inline bool wait_until(const std::function<bool()>& ready, int ms) {
  QElapsedTimer timer;
  timer.start();
  while (!ready() && timer.elapsed() < ms) {
    QCoreApplication::processEvents(QEventLoop::AllEvents, 20);
    QThread::msleep(1);  // a core is left to what is waited for
  }
  return ready();
}

}  // namespace breccia::gui::test
