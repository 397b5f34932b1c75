#include "core/places.hpp"

#include <QCoreApplication>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QJsonArray>
#include <QJsonDocument>
#include <QStandardPaths>
#include <filesystem>

#include "core/written_file.hpp"

namespace breccia::gui {
namespace {

constexpr int kMostRecent = 12;

/// The first that is there; the last where none is.
QString first_there(const QStringList& candidates) {
  for (const QString& path : candidates)
    if (!path.isEmpty() && QFileInfo::exists(path)) return QFileInfo(path).absoluteFilePath();
  return candidates.back();
}

QString recent_file(const Places& places) { return QDir(places.state).filePath("recent.json"); }

QString template_text(const char* words) { return QCoreApplication::translate("templates", words); }

}  // namespace

Places Places::of_this_machine() {
  const QDir program(QCoreApplication::applicationDirPath());
  Places places;
  places.launch.program = first_there({qEnvironmentVariable("BRECCIA_PROGRAM"), program.filePath("breccia"),
                                       program.filePath("../solver/breccia"), "breccia"});
  places.desktop = QCoreApplication::applicationFilePath();
  places.meshes = first_there({qEnvironmentVariable("BRECCIA_MESHES"), program.filePath("../share/breccia/meshes"),
                               program.filePath("../../../meshes"), "meshes"});
  places.projects = qEnvironmentVariable("BRECCIA_PROJECTS", QDir::home().filePath("Breccia"));
  places.state = qEnvironmentVariable(
      "BRECCIA_STATE", QStandardPaths::writableLocation(QStandardPaths::GenericDataLocation) + "/breccia");
  return places;
}

std::vector<Template> templates(const Places& places) {
  struct Row {
    const char *folder, *file, *title, *words;
  };
  const std::vector<Row> rows{
      {"glass_impact", "case_demo.toml", QT_TRANSLATE_NOOP("templates", "Glass plate, projectile and supports"),
       QT_TRANSLATE_NOOP("templates", "A plate of glass on four supports is shattered. About a minute on two cores.")},
      {"block_wall", "case.toml", QT_TRANSLATE_NOOP("templates", "Block hits a wall"),
       QT_TRANSLATE_NOOP("templates", "A concrete block breaks at a rigid wall.")},
      {"slit_plate", "case_smoke.toml", QT_TRANSLATE_NOOP("templates", "Plate with a slit"),
       QT_TRANSLATE_NOOP("templates", "Pressure in a slit drives a crack through a plate.")},
      {"disc", "case.toml", QT_TRANSLATE_NOOP("templates", "Disc split by two platens"),
       QT_TRANSLATE_NOOP("templates", "The Brazilian test: a disc of rock splits along the diameter that is loaded.")},
      {"cylinder", "case.toml", QT_TRANSLATE_NOOP("templates", "Cylinder crushed by two platens"),
       QT_TRANSLATE_NOOP("templates", "The uniaxial compression test: a cylinder of rock shears and falls apart.")},
      {"notched_beam", "case.toml", QT_TRANSLATE_NOOP("templates", "Notched beam in three-point bending"),
       QT_TRANSLATE_NOOP("templates", "A crack runs from a sawn notch through a beam on two rollers.")},
      {"bouncing_cubes", "case_smoke.toml", QT_TRANSLATE_NOOP("templates", "Raster of cubes"),
       QT_TRANSLATE_NOOP("templates", "Cubes fly about in a sphere and collide.")},
      {"block_drop", "case.toml", QT_TRANSLATE_NOOP("templates", "Armour block dropped"),
       QT_TRANSLATE_NOOP("templates", "A block falls onto a floor under its weight.")},
      {"cooling_tower", "case_smoke.toml", QT_TRANSLATE_NOOP("templates", "Cooling tower"),
       QT_TRANSLATE_NOOP("templates",
                         "A hyperboloid shell of concrete on its foundation comes to rest under its "
                         "weight.")},
      {"hertz_impact", "case.toml", QT_TRANSLATE_NOOP("templates", "Sphere bounces off a plate"),
       QT_TRANSLATE_NOOP("templates", "Elastic impact, to be compared with Hertz.")},
      {"cantilever", "case.toml", QT_TRANSLATE_NOOP("templates", "Cantilever"),
       QT_TRANSLATE_NOOP("templates", "A beam swings; nothing breaks.")},
      {"bar_wave", "case.toml", QT_TRANSLATE_NOOP("templates", "Wave in a bar"),
       QT_TRANSLATE_NOOP("templates", "An elastic wave runs along a bar.")}};
  std::vector<Template> found;
  for (const Row& row : rows) {
    const QDir folder(QDir(places.meshes).filePath(row.folder));
    if (!folder.exists(row.file)) continue;
    const QString picture = folder.absoluteFilePath("picture.png");
    found.push_back({template_text(row.title), template_text(row.words), folder.absoluteFilePath(row.file),
                     QFileInfo::exists(picture) ? picture : QString()});
  }
  return found;
}

QString copy_template(const Template& chosen, const Places& places, QString* error) {
  const QFileInfo from(chosen.case_file);
  const QString name = from.dir().dirName();
  QDir to(places.projects);
  QString folder = to.filePath(name);
  for (int i = 2; QFileInfo::exists(folder); ++i) folder = to.filePath(QString("%1-%2").arg(name).arg(i));
  const bool had_projects = to.exists();
  std::error_code why;
  std::filesystem::create_directories(folder.toStdString(), why);
  if (why) {
    *error = QCoreApplication::translate("templates", "the folder %1 cannot be made: %2")
                 .arg(folder, QString::fromLocal8Bit(why.message().c_str()));
    return {};
  }
  error->clear();
  const auto copy = [&](const QString& file, const QString& as) {
    QFile source(from.dir().filePath(file));
    if (!error->isEmpty()) return;
    *error = source.open(QIODevice::ReadOnly) ? written(QDir(folder).filePath(as), source.readAll())
                                              : QCoreApplication::translate("templates", "%1 cannot be read: %2")
                                                    .arg(source.fileName(), source.errorString());
  };
  copy(from.fileName(), "case.toml");
  for (const QString& file : from.dir().entryList({"*.geo", "*.msh", "*.step", "*.brep", "*.stl"}, QDir::Files))
    copy(file, file);
  if (error->isEmpty()) return QDir(folder).filePath("case.toml");
  QDir(folder).removeRecursively();
  if (!had_projects) QDir().rmdir(places.projects);
  return {};
}

QStringList recent_cases(const Places& places) {
  QStringList found;
  QFile file(recent_file(places));
  if (!file.open(QIODevice::ReadOnly)) return found;
  for (const QJsonValue& value : QJsonDocument::fromJson(file.readAll()).array())
    if (QFileInfo::exists(value.toString())) found << value.toString();
  return found;
}

QString remember_case(const Places& places, const QString& file) {
  QStringList list = recent_cases(places);
  list.removeAll(file);
  list.prepend(file);
  while (list.size() > kMostRecent) list.removeLast();
  return written(recent_file(places), QJsonDocument(QJsonArray::fromStringList(list)).toJson());
}

}  // namespace breccia::gui
