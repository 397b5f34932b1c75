#pragma once

#include <QByteArray>
#include <QObject>
#include <QTimer>
#include <QUndoStack>
#include <optional>
#include <vector>

#include "base/error.hpp"
#include "core/toml_places.hpp"

namespace breccia::gui {

/// Unsaved edits of an earlier session that was killed.
struct Recovery {
  QString snapshot;  ///< file of the state folder
  QString file;      ///< of the case
  QByteArray text;
};

/// What the names of groups in a case may stand for.
struct MeshGroups {
  std::vector<std::string> volumes, surfaces, nodes;
  int num_bodies = 0;
  std::vector<std::string> sets{};  ///< volume groups that carry no material
};

/// A case that is being edited. Its text is the truth, kept byte for byte; an edit replaces one piece of it and can be
/// undone. A snapshot of unsaved edits is in the state folder at most `kAutosaveDelay` after an edit.
class Document final : public QObject {
  Q_OBJECT
 public:
  static constexpr int kAutosaveDelay = 1000;  // ms

  /// @param state_folder  of snapshots; made when needed
  explicit Document(QString state_folder, QObject* parent = nullptr);

  /// Reads a file. Returns what went wrong, empty: nothing.
  [[nodiscard]] QString open(const QString& file);
  /// Takes a snapshot up again: the case of `file`, edited.
  void recover(const Recovery& recovery);
  [[nodiscard]] QString save();
  [[nodiscard]] QString save_as(const QString& file);
  /// Another program has written the file since it was read or saved here.
  [[nodiscard]] bool changed_on_disk() const;
  /// The file is there and holds what was last read or written here.
  [[nodiscard]] bool is_on_disk() const;
  /// Loads the changes of another program, as an edit that can be undone. Returns the error, if any.
  [[nodiscard]] QString reload();
  /// Ends the work on this case; the snapshot is removed.
  void close();

  [[nodiscard]] const QString& file() const { return file_; }
  [[nodiscard]] QString folder() const;
  [[nodiscard]] bool is_open() const { return open_; }
  [[nodiscard]] bool modified() const { return !undo_.isClean(); }
  [[nodiscard]] QByteArray text() const { return QByteArray::fromStdString(places_.text()); }
  [[nodiscard]] const TomlPlaces& places() const { return places_; }
  [[nodiscard]] QUndoStack& undo_stack() { return undo_; }

  /// TOML text of what stands at a path; empty: nothing does.
  [[nodiscard]] QString value(const QString& path) const;
  /// Edits, each one undoable step. An edit that changes nothing is none.
  void set_value(const QString& path, const QString& toml);
  void remove(const QString& path);
  /// @param lines  "key = value\n..." of the new [[list]] entry
  void add_entry(const QString& list, const QString& lines);
  /// The whole text at once; steps that follow each other at neighbouring places while the user types are one.
  void set_text(const QByteArray& text);

  /// The whole text at once, as one edit. @param words  what it does
  void take_text(const std::string& text, const QString& words);

  /// Problems that the solver's reader reports for the present text. If there are none and the mesh is known: problems
  /// of the names of groups.
  [[nodiscard]] std::vector<Problem> problems(const std::optional<MeshGroups>& mesh = {}) const;
  /// True when the text, as it is shown, gives back the same bytes: UTF-8, one kind of line ends.
  [[nodiscard]] bool editable_as_text() const;

  /// Snapshots of processes that are no more.
  [[nodiscard]] static std::vector<Recovery> recoveries(const QString& state_folder);
  static void discard(const Recovery& recovery);

 signals:
  void changed();  ///< the text
  void renamed();  ///< the file
  void modification_changed(bool modified);
  /// A snapshot was tried. @param error  empty: it is there; else another try follows
  void snapshot_tried(const QString& error);

 private:
  friend class TextEdit;
  void apply(const TextChange& change);
  /// Files that the text names relative to its folder, from another folder. @return  whether there are any
  bool name_files_from(const QString& folder);
  void push(const TextChange& change, const QString& words, bool merges = false);
  void start(const QString& file, const QByteArray& text);
  /// @return  whether all edits are kept
  bool write_snapshot();
  void remove_snapshot();
  [[nodiscard]] QString snapshot_file() const;

  QString state_folder_, file_;
  bool open_ = false;
  TomlPlaces places_;
  QByteArray on_disk_;  ///< content of the file when it was last read or written here
  QUndoStack undo_;
  QTimer autosave_;
};

}  // namespace breccia::gui
