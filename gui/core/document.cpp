#include "core/document.hpp"

#include <unistd.h>

#include <QCryptographicHash>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QJsonDocument>
#include <QJsonObject>
#include <QUndoCommand>

#include "case/reader.hpp"
#include "case/validate.hpp"
#include "core/case_outline.hpp"
#include "core/process_session.hpp"
#include "core/value_text.hpp"
#include "core/written_file.hpp"

namespace breccia::gui {
namespace {

/// Whether the process that wrote a snapshot still runs. Its number alone is not sufficient: after a restart of the
/// machine another process may have it.
bool writer_runs(const QJsonObject& snapshot) {
  const std::optional<qint64> start = start_of_process(static_cast<pid_t>(snapshot["process"].toDouble()));
  return start && (!snapshot.contains("started") || *start == static_cast<qint64>(snapshot["started"].toDouble()));
}

}  // namespace

/// One replacement of a piece of the text.
class TextEdit final : public QUndoCommand {
 public:
  TextEdit(Document& document, TextChange change, const QString& words, bool merges)
      : QUndoCommand(words), document_(document), change_(std::move(change)), merges_(merges) {}
  void redo() override { document_.apply(change_); }
  void undo() override { document_.apply(reversed(change_)); }
  [[nodiscard]] int id() const override { return merges_ ? 1 : -1; }
  // Letters that are typed one behind the other are one step; a new line begins another.
  bool mergeWith(const QUndoCommand* next) override {
    const auto& later = static_cast<const TextEdit&>(*next).change_;
    if (!later.removed.empty() || !change_.removed.empty() || later.at != change_.at + change_.inserted.size() ||
        change_.inserted.ends_with('\n'))
      return false;
    change_.inserted += later.inserted;
    return true;
  }

 private:
  Document& document_;
  TextChange change_;
  bool merges_;
};

Document::Document(QString state_folder, QObject* parent) : QObject(parent), state_folder_(std::move(state_folder)) {
  autosave_.setSingleShot(true);
  autosave_.setInterval(kAutosaveDelay);
  connect(&autosave_, &QTimer::timeout, this, [this] { write_snapshot(); });
  connect(&undo_, &QUndoStack::cleanChanged, this, [this](bool clean) { emit modification_changed(!clean); });
}

QString Document::folder() const { return QFileInfo(file_).absolutePath(); }

void Document::start(const QString& file, const QByteArray& text) {
  remove_snapshot();
  file_ = QFileInfo(file).absoluteFilePath();
  undo_.clear();
  places_ = TomlPlaces(text.toStdString());
  on_disk_ = text;
  open_ = true;
}

QString Document::open(const QString& file) {
  QFile in(file);
  const QFileInfo about(file);
  if (about.exists() && !about.isFile()) return tr("%1 cannot be read: %2").arg(file, tr("it is no regular file"));
  if (!in.open(QIODevice::ReadOnly)) return tr("%1 cannot be read: %2").arg(file, in.errorString());
  start(file, in.readAll());
  emit renamed();
  emit changed();
  return {};
}

void Document::recover(const Recovery& recovery) {
  QFile in(recovery.file);
  start(recovery.file, in.open(QIODevice::ReadOnly) ? in.readAll() : QByteArray());
  push(difference(places_.text(), recovery.text.toStdString()), tr("recover unsaved edits"));
  if (write_snapshot()) QFile::remove(recovery.snapshot);
  emit renamed();
  emit changed();
}

QString Document::save() {
  const QString error = written(file_, text());
  if (!error.isEmpty()) return error;
  on_disk_ = text();
  undo_.setClean();
  remove_snapshot();
  return {};
}

QString Document::save_as(const QString& file) {
  const QString absolute = QFileInfo(file).absoluteFilePath();
  const bool moved = name_files_from(QFileInfo(absolute).absolutePath());
  const QString error = written(absolute, text());
  if (!error.isEmpty()) {
    if (moved) undo_.undo();
    return error;
  }
  remove_snapshot();
  file_ = absolute;
  on_disk_ = text();
  undo_.setClean();
  emit renamed();
  return {};
}

bool Document::name_files_from(const QString& folder) {
  const QDir before = QFileInfo(file_).absoluteDir(), after(folder);
  if (before == after) return false;
  std::string text = places_.text();
  for (const Place& place : places_.all()) {
    const case_::Key* key = case_::row_at(place.path);
    if (place.kind != Place::Kind::value || key == nullptr) continue;
    const QString name = shown_value(*key, value(QString::fromStdString(place.path)));
    const bool is_script = key->path == "insitu.pipeline[].name" && case_::is_script(name.toStdString());
    if ((key->type != case_::ValueType::path && !is_script) || name.isEmpty() || QDir::isAbsolutePath(name)) continue;
    const QString there = after.relativeFilePath(before.absoluteFilePath(name));
    text = applied(text, TomlPlaces(text).set(place.path, quoted(there).toStdString()));
  }
  if (text == places_.text()) return false;
  take_text(text, tr("names of files, from the new folder"));
  return true;
}

bool Document::changed_on_disk() const {
  QFile in(file_);
  return open_ && in.open(QIODevice::ReadOnly) && in.readAll() != on_disk_;
}

bool Document::is_on_disk() const {
  QFile in(file_);
  return open_ && in.open(QIODevice::ReadOnly) && in.readAll() == on_disk_;
}

QString Document::reload() {
  QFile in(file_);
  if (!in.open(QIODevice::ReadOnly)) return tr("%1 cannot be read: %2").arg(file_, in.errorString());
  on_disk_ = in.readAll();
  push(difference(places_.text(), on_disk_.toStdString()), tr("reload the file"));
  undo_.setClean();
  remove_snapshot();
  return {};
}

void Document::close() {
  remove_snapshot();
  open_ = false;
  file_.clear();
  undo_.clear();
  places_ = TomlPlaces();
  emit renamed();
  emit changed();
}

QString Document::value(const QString& path) const {
  const std::string_view found = places_.value(path.toStdString());
  return QString::fromUtf8(found.data(), static_cast<int>(found.size()));
}

void Document::set_value(const QString& path, const QString& toml) {
  push(places_.set(path.toStdString(), toml.toStdString()), tr("set %1").arg(words_of(path, places_)));
}

void Document::remove(const QString& path) {
  push(places_.remove(path.toStdString()), tr("remove %1").arg(words_of(path, places_)));
}

void Document::add_entry(const QString& list, const QString& lines) {
  push(places_.add_entry(list.toStdString(), lines.toStdString()), tr("add %1").arg(words_of(list, places_)));
}

void Document::set_text(const QByteArray& text) {
  push(difference(places_.text(), text.toStdString()), tr("edit text"), true);
}

void Document::take_text(const std::string& text, const QString& words) {
  push(difference(places_.text(), text), words);
}

void Document::push(const TextChange& change, const QString& words, bool merges) {
  if (!change.empty()) undo_.push(new TextEdit(*this, change, words, merges));
}

void Document::apply(const TextChange& change) {
  places_ = TomlPlaces(applied(places_.text(), change));
  if (!autosave_.isActive()) autosave_.start();  // not restarted: steady typing must not put it off
  emit changed();
}

std::vector<Problem> Document::problems(const std::optional<MeshGroups>& mesh) const {
  try {
    const case_::Case read = case_::read_case_text(places_.text(), file_.toStdString());
    if (mesh)
      return case_::check_groups(read, {mesh->volumes, mesh->surfaces, mesh->nodes, mesh->sets}, mesh->num_bodies);
  } catch (const InputError& error) {
    return error.problems();
  }
  return {};
}

bool Document::editable_as_text() const {
  const QByteArray bytes = text();
  if (bytes.contains('\0') || QString::fromUtf8(bytes).toUtf8() != bytes) return false;
  const auto returns = bytes.count('\r');
  return returns == 0 || (returns == bytes.count("\r\n") && returns == bytes.count('\n'));
}

QString Document::snapshot_file() const {
  const QByteArray name = QCryptographicHash::hash(file_.toUtf8(), QCryptographicHash::Sha1).toHex().left(16);
  return QDir(state_folder_).filePath(QString("unsaved-%1-%2.json").arg(QString::fromLatin1(name)).arg(::getpid()));
}

bool Document::write_snapshot() {
  if (!open_) return true;
  if (!modified()) {  // all edits were undone
    remove_snapshot();
    emit snapshot_tried({});
    return true;
  }
  const QJsonObject json{{"file", file_},
                         {"process", static_cast<qint64>(::getpid())},
                         {"started", start_of_process(::getpid()).value_or(0)},
                         {"text", QString::fromLatin1(text().toBase64())}};
  const QString error = written(snapshot_file(), QJsonDocument(json).toJson(QJsonDocument::Compact));
  if (!error.isEmpty()) autosave_.start();
  emit snapshot_tried(error);
  return error.isEmpty();
}

void Document::remove_snapshot() {
  autosave_.stop();
  if (!file_.isEmpty()) QFile::remove(snapshot_file());
}

std::vector<Recovery> Document::recoveries(const QString& state_folder) {
  std::vector<Recovery> found;
  const QDir folder(state_folder);
  for (const QString& name : folder.entryList({"unsaved-*.json"}, QDir::Files, QDir::Time)) {
    QFile in(folder.filePath(name));
    if (!in.open(QIODevice::ReadOnly)) continue;
    const QJsonObject json = QJsonDocument::fromJson(in.readAll()).object();
    if (json.isEmpty() || writer_runs(json)) continue;
    found.push_back(
        {folder.filePath(name), json["file"].toString(), QByteArray::fromBase64(json["text"].toString().toLatin1())});
  }
  return found;
}

void Document::discard(const Recovery& recovery) { QFile::remove(recovery.snapshot); }

}  // namespace breccia::gui
