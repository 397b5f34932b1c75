#include "widgets/library_dialog.hpp"

#include <QDialogButtonBox>
#include <QHeaderView>
#include <QMessageBox>
#include <QSplitter>
#include <QVBoxLayout>

#include "core/value_text.hpp"

namespace breccia::gui {
namespace {

constexpr int kNumber = Qt::UserRole;

const case_::Key* key_of(const QString& name) {
  const QString path = name.startsWith("joint.") ? "joint[]." + name.mid(6) : "material[]." + name;
  return case_::find_key(path.toStdString());
}

}  // namespace

LibraryDialog::LibraryDialog(const UserLibrary& library, const QString& group, QWidget* parent)
    : QDialog(parent),
      library_(library),
      filter_(new QLineEdit),
      list_(new QTreeWidget),
      values_(new QTableWidget),
      note_(new QLabel),
      take_(new QPushButton(tr("&Take these values"))),
      remove_(new QPushButton(tr("&Remove from my library"))) {
  setWindowTitle(tr("Materials for %1").arg(group));
  setObjectName("library");
  resize(900, 560);
  filter_->setPlaceholderText(tr("Find: granite, glass, ..."));
  filter_->setObjectName("library_filter");
  filter_->setAccessibleName(tr("Find a material"));
  filter_->setToolTip(tr("Shows the materials whose name or kind contains this text"));
  list_->setHeaderHidden(true);
  list_->setObjectName("library_list");
  list_->setAccessibleName(tr("Materials"));
  list_->setToolTip(tr("Materials by kind; those of your library stand last"));
  values_->setColumnCount(3);
  values_->setHorizontalHeaderLabels({tr("key"), tr("value"), tr("source")});
  values_->setObjectName("library_values");
  values_->setAccessibleName(tr("Values of the material"));
  values_->setToolTip(tr("Every value with its source; derived and assumed values are marked"));
  values_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  values_->setTabKeyNavigation(false);
  values_->setWordWrap(true);
  values_->verticalHeader()->hide();
  values_->horizontalHeader()->setStretchLastSection(true);
  take_->setObjectName("library_take");
  take_->setAccessibleName(tr("Take these values"));
  take_->setToolTip(tr("Puts the values into the material and into the joints of its group; one undo takes them back"));
  remove_->setObjectName("library_remove");
  remove_->setAccessibleName(tr("Remove from my library"));
  remove_->setToolTip(tr("Only materials of your own can be removed"));
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  buttons->addButton(take_, QDialogButtonBox::AcceptRole);
  buttons->addButton(remove_, QDialogButtonBox::ActionRole);
  for (QAbstractButton* b : buttons->buttons())
    if (b->toolTip().isEmpty()) b->setToolTip(tr("Change nothing"));
  auto* left = new QWidget;
  auto* column = new QVBoxLayout(left);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(filter_);
  column->addWidget(list_, 1);
  auto* halves = new QSplitter;
  halves->addWidget(left);
  note_->setWordWrap(true);
  note_->setObjectName("library_note");
  auto* right = new QWidget;
  auto* about = new QVBoxLayout(right);
  about->setContentsMargins(0, 0, 0, 0);
  about->addWidget(values_, 1);
  about->addWidget(note_);
  halves->addWidget(right);
  halves->setSizes({280, 620});
  auto* all = new QVBoxLayout(this);
  all->addWidget(halves, 1);
  all->addWidget(buttons);
  take_->setDefault(true);  // of the dialog, in which it must stand
  connect(filter_, &QLineEdit::textChanged, this, &LibraryDialog::fill);
  connect(list_, &QTreeWidget::currentItemChanged, this, &LibraryDialog::show_chosen);
  connect(list_, &QTreeWidget::itemDoubleClicked, this, [this] {
    if (chosen() != nullptr) accept();
  });
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(remove_, &QPushButton::clicked, this, &LibraryDialog::remove_chosen);
  fill();
}

const LibraryMaterial* LibraryDialog::chosen() const {
  const QTreeWidgetItem* item = list_->currentItem();
  const QVariant number = item == nullptr ? QVariant() : item->data(0, kNumber);
  return number.isValid() ? &materials_[number.toUInt()] : nullptr;
}

void LibraryDialog::fill() {
  materials_ = shipped_materials();
  for (LibraryMaterial& own : library_.load()) materials_.push_back(std::move(own));
  list_->clear();
  QMap<QString, QTreeWidgetItem*> kinds;
  for (std::size_t i = 0; i < materials_.size(); ++i) {
    const LibraryMaterial& m = materials_[i];
    const QString kind = m.own ? tr("my library") : m.kind;
    if (!(m.name + " " + kind).contains(filter_->text().trimmed(), Qt::CaseInsensitive)) continue;
    if (!kinds.contains(kind)) {
      kinds[kind] = new QTreeWidgetItem(list_, {kind});
      kinds[kind]->setFlags(Qt::ItemIsEnabled);
    }
    auto* item = new QTreeWidgetItem(kinds[kind], {m.name});
    item->setData(0, kNumber, static_cast<uint>(i));
  }
  list_->expandAll();
  if (list_->topLevelItemCount() > 0) list_->setCurrentItem(list_->topLevelItem(0)->child(0));
  show_chosen();
}

void LibraryDialog::show_chosen() {
  const LibraryMaterial* m = chosen();
  take_->setEnabled(m != nullptr);
  remove_->setEnabled(m != nullptr && m->own);
  values_->setRowCount(0);
  note_->setText(m == nullptr ? QString() : m->note);
  if (m == nullptr) return;
  const auto add = [this](const QStringList& cells) {
    const int row = values_->rowCount();
    values_->setRowCount(row + 1);
    for (int c = 0; c < cells.size(); ++c) values_->setItem(row, c, new QTableWidgetItem(cells[c]));
  };
  for (const MaterialValue& v : m->values) {
    const case_::Key* key = key_of(v.key);
    const QString label = key == nullptr ? v.key : label_of(*key) + (v.key.startsWith("joint.") ? tr(" (joints)") : "");
    add({label, key == nullptr ? v.toml : shown_value(*key, v.toml), v.source});
  }
  values_->resizeColumnToContents(0);
  values_->resizeColumnToContents(1);
  values_->resizeRowsToContents();
}

void LibraryDialog::remove_chosen() {
  const LibraryMaterial* m = chosen();
  if (m == nullptr || !m->own) return;
  if (const QString error = library_.remove(m->name); !error.isEmpty())
    QMessageBox::warning(this, tr("Breccia"), error);
  fill();
}

}  // namespace breccia::gui
