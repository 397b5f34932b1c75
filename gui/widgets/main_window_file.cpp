#include <QCryptographicHash>
#include <QDir>
#include <QFile>
#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <QPushButton>
#include <QStatusBar>

#include "core/text_differences.hpp"
#include "widgets/case_tree.hpp"
#include "widgets/main_window.hpp"
#include "widgets/problems_panel.hpp"
#include "widgets/property_form.hpp"

// The file of the case: opened elsewhere, changed elsewhere, saved, lost and found.

namespace breccia::gui {
namespace {

constexpr int kShownDifferences = 12;  // lines

/// What one text has and the other has not, in a few lines.
QString differences_words(const QByteArray& before, const QByteArray& after) {
  QStringList lines = line_differences(QString::fromUtf8(before), QString::fromUtf8(after));
  const auto more = lines.size() - kShownDifferences;
  lines = lines.mid(0, kShownDifferences);
  if (more > 0) lines << MainWindow::tr("... and %1 lines more").arg(more);
  return lines.join('\n');
}

QByteArray content_of(const QString& file) {
  QFile in(file);
  return in.open(QIODevice::ReadOnly) ? in.readAll() : QByteArray();
}

}  // namespace

void MainWindow::tell_trouble(const QString& what, const QString& words, const QString& error) {
  const QString text = error.isEmpty() ? QString() : QString("%1: %2").arg(words, error);
  if (!messages_->set_trouble(what, text) || text.isEmpty()) return;
  statusBar()->showMessage(text, 15000);
  if (document_.is_open()) show_dock("dock_messages");
}

void MainWindow::remember_file() {
  tell_trouble("recent", tr("This case is not kept among the recent ones"), remember_case(places_, document_.file()));
}

/// Of all cases; of one: what stands in its file is open. What is not decided now is offered again.
void MainWindow::offer_recovery(const QString& of) {
  for (const Recovery& recovery : Document::recoveries(places_.state)) {
    if (!of.isEmpty() && recovery.file != of) continue;
    QMessageBox box(QMessageBox::Question, tr("Unsaved edits"),
                    tr("Breccia ended without saving its edits of\n%1\nTake them up again?").arg(recovery.file),
                    QMessageBox::Yes | QMessageBox::Discard | QMessageBox::Cancel, this);
    box.setInformativeText(differences_words(content_of(recovery.file), recovery.text));
    box.button(QMessageBox::Yes)->setText(tr("&Take them up"));
    box.button(QMessageBox::Cancel)->setText(tr("&Later"));
    box.setDefaultButton(QMessageBox::Yes);
    const int answer = box.exec();
    if (answer == QMessageBox::Discard) {
      Document::discard(recovery);
      continue;
    }
    if (answer != QMessageBox::Yes) return;
    document_.recover(recovery);
    show_workspace();
    stage_selected(tree_->stage(), tree_->path());
    validate();
    return;
  }
}

bool MainWindow::save() {
  form_->take_typed();
  if (!document_.is_open()) return false;
  if (document_.changed_on_disk()) return settle_with_disk();
  const QString error = document_.save();
  look_at_disk();
  if (!error.isEmpty())
    QMessageBox::warning(this, tr("Breccia"), tr("%1\nFile > Save as... writes the case elsewhere.").arg(error));
  return error.isEmpty();
}

void MainWindow::save_as() {
  form_->take_typed();
  if (!document_.is_open()) return;
  const QString name =
      QFileDialog::getSaveFileName(this, tr("Save the case as"), document_.file(), tr("Cases (*.toml)"));
  if (name.isEmpty()) return;
  if (const QString error = document_.save_as(name); !error.isEmpty()) {
    QMessageBox::warning(this, tr("Breccia"), error);
    return;
  }
  remember_file();
  validate();  // relative names start from another folder
}

void MainWindow::look_at_disk() {
  claim_case();
  tell_trouble("disk", tr("Another program has changed or removed the case since it was opened here"),
               document_.is_open() && !document_.is_on_disk() ? document_.file() : QString());
}

/// Whether the case on disk is the one in the window. An edited case is saved, with its own dialog.
bool MainWindow::agrees_with_disk() {
  if (!document_.is_open() || document_.modified() || document_.is_on_disk()) return true;
  return QFileInfo::exists(document_.file()) ? settle_with_disk() : save();
}

bool MainWindow::settle_with_disk() {
  QMessageBox box(QMessageBox::Question, tr("Breccia"),
                  tr("Another program has changed\n%1\nsince it was opened.").arg(document_.file()),
                  QMessageBox::Open | QMessageBox::Save | QMessageBox::Cancel, this);
  box.setInformativeText(tr("Its differences from this window (undo restores the present text):\n%1")
                             .arg(differences_words(document_.text(), content_of(document_.file()))));
  box.button(QMessageBox::Open)->setText(tr("&Take that over"));
  box.button(QMessageBox::Save)->setText(tr("&Write over it"));
  box.setDefaultButton(QMessageBox::Cancel);
  const int answer = box.exec();
  QString error;
  if (answer == QMessageBox::Open) error = document_.reload();
  if (answer == QMessageBox::Save) error = document_.save();
  if (!error.isEmpty()) QMessageBox::warning(this, tr("Breccia"), error);
  look_at_disk();
  return answer != QMessageBox::Cancel && error.isEmpty();
}

bool MainWindow::may_leave_case() {
  form_->take_typed();
  if (!document_.is_open() || !document_.modified()) return true;
  const auto answer = QMessageBox::question(this, tr("Breccia"), tr("Save the edits of %1?").arg(document_.file()),
                                            QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel);
  return answer == QMessageBox::Discard || (answer == QMessageBox::Save && save());
}

void MainWindow::claim_case() {
  const QByteArray name =
      QCryptographicHash::hash(document_.file().toUtf8(), QCryptographicHash::Sha1).toHex().left(16);
  const QString lock = document_.is_open() ? QString("%1/open-%2.lock").arg(places_.state, QString(name)) : QString();
  if (lock != claimed_) claim_ = lock.isEmpty() ? nullptr : std::make_unique<QLockFile>(lock);
  claimed_ = lock;
  QString other;
  if (claim_ != nullptr && !claim_->isLocked()) {
    claim_->setStaleLockTime(0);  // no time limit; a lock of a process that has ended does not count
    qint64 process = 0;
    QString host, program;
    if (!claim_->tryLock(0) && claim_->error() == QLockFile::LockFailedError &&
        claim_->getLockInfo(&process, &host, &program))
      other = tr("process %1 on %2 has %3 open").arg(process).arg(host, document_.file());
  }
  tell_trouble("elsewhere",
               tr("This case is open in another window as well; the last save overwrites earlier "
                  "ones"),
               other);
}

}  // namespace breccia::gui
