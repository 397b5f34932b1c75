#include "widgets/start_page.hpp"

#include <QDir>
#include <QFileInfo>
#include <QGridLayout>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QVBoxLayout>

/// Resources of a static library have to be initialised, outside of any namespace.
static void take_pictures_of_templates() { Q_INIT_RESOURCE(templates); }

namespace breccia::gui {
namespace {

constexpr QSize kPicture(200, 130);

/// The picture of a template that comes with the program, the one in its folder, or its title where it has none.
QIcon icon_of(const Template& t) {
  QPixmap picture(picture_of_template(t));
  if (picture.isNull()) picture = QPixmap(t.picture);
  if (picture.isNull()) {
    picture = QPixmap(kPicture);
    picture.fill(QColor(96, 112, 128));
    QPainter painter(&picture);
    painter.setPen(Qt::white);
    QFont font = painter.font();
    font.setPixelSize(20);
    painter.setFont(font);
    painter.drawText(picture.rect().adjusted(8, 8, -8, -8), Qt::AlignCenter | Qt::TextWordWrap, t.title);
  }
  return QIcon(picture);
}

/// Shows a hint while it is empty.
class HintedList final : public QListWidget {
 public:
  explicit HintedList(const QString& hint) : hint_(hint) { setAccessibleDescription(hint); }

 protected:
  void paintEvent(QPaintEvent* event) override {
    QListWidget::paintEvent(event);
    if (count() > 0) return;
    QPainter painter(viewport());
    painter.setPen(palette().color(QPalette::Disabled, QPalette::Text));
    painter.drawText(viewport()->rect().adjusted(8, 8, -8, -8), Qt::AlignTop | Qt::TextWordWrap, hint_);
  }

 private:
  QString hint_;
};

QListWidget* list(const QString& name, const QString& accessible, const QString& hint) {
  auto* made = new HintedList(hint);
  made->setObjectName(name);
  made->setAccessibleName(accessible);
  made->setToolTip(accessible);
  return made;
}

}  // namespace

QString picture_of_template(const Template& t) {
  take_pictures_of_templates();
  return ":/templates/" + QFileInfo(t.case_file).dir().dirName() + ".png";
}

StartPage::StartPage(const Places& places, QWidget* parent)
    : QWidget(parent),
      places_(places),
      templates_(list("templates", tr("Templates: Enter or a click opens a copy"),
                      tr("No template was found: the folder of shipped cases is missing."))),
      recent_(list("recent", tr("Recent cases"), tr("None yet. Cases that are opened or saved here will be listed."))),
      runs_(list("start_runs", tr("Runs started here"),
                 tr("None yet. Runs that are started here will be listed with their state."))) {
  auto* demo = new QPushButton(tr("&Show me: shatter the glass plate"));
  demo->setObjectName("demo");
  demo->setAccessibleName(tr("Show me: shatter the glass plate"));
  demo->setToolTip(tr("Opens the glass template, meshes it and runs it on all cores"));
  QFont large = demo->font();
  large.setPointSizeF(1.2 * large.pointSizeF());
  demo->setFont(large);
  auto* open = new QPushButton(tr("&Open a case..."));
  open->setObjectName("open_case");
  open->setAccessibleName(tr("Open a case"));
  open->setToolTip(tr("Open a case file (Ctrl+O)"));
  auto* import = new QPushButton(tr("&Import a geometry..."));
  import->setObjectName("import_geometry");
  import->setAccessibleName(tr("Import a geometry"));
  import->setToolTip(tr("Makes a case of solids in a STEP, BREP or STL file (Ctrl+I)"));
  templates_->setViewMode(QListView::IconMode);
  templates_->setIconSize(kPicture);
  templates_->setGridSize(QSize(230, 190));
  templates_->setResizeMode(QListView::Adjust);
  templates_->setMovement(QListView::Static);
  templates_->setWordWrap(true);
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(24, 16, 24, 16);
  auto* title = new QLabel(tr("<h1>Breccia</h1>Solids that break: choose a template, change it, run it, watch it."));
  grid->addWidget(title, 0, 0);
  auto* column = new QVBoxLayout;
  column->addWidget(demo);
  column->addWidget(open);
  column->addWidget(import);
  grid->addLayout(column, 0, 1);
  grid->addWidget(new QLabel(tr("<h3>New from a template</h3>")), 1, 0);
  grid->addWidget(templates_, 2, 0, 3, 1);
  grid->addWidget(new QLabel(tr("<h3>Recent cases</h3>")), 1, 1);
  grid->addWidget(recent_, 2, 1);
  grid->addWidget(new QLabel(tr("<h3>Runs</h3>")), 3, 1);
  grid->addWidget(runs_, 4, 1);
  grid->setColumnStretch(0, 3);
  grid->setColumnStretch(1, 2);
  for (const Template& t : templates(places_)) {
    auto* item = new QListWidgetItem(icon_of(t), t.title, templates_);
    item->setToolTip(t.text);
    item->setData(Qt::AccessibleTextRole, t.title + ". " + t.text);
  }
  connect(demo, &QPushButton::clicked, this, &StartPage::demo_wanted);
  connect(open, &QPushButton::clicked, this, &StartPage::open_wanted);
  connect(import, &QPushButton::clicked, this, &StartPage::import_wanted);
  // One click or Enter; itemActivated alone would be a double click on some desktops.
  const auto chosen = [this](QListWidgetItem* item) { emit template_chosen(templates_->row(item)); };
  connect(templates_, &QListWidget::itemClicked, this, chosen);
  connect(recent_, &QListWidget::itemClicked, this,
          [this](QListWidgetItem* i) { emit case_chosen(i->data(Qt::UserRole).toString()); });
  connect(runs_, &QListWidget::itemClicked, this,
          [this](QListWidgetItem* i) { emit run_chosen(i->data(Qt::UserRole).toString()); });
  const auto enter = [this](QListWidgetItem* i) {
    // The style may call a click an activation as well; the page is closed by then.
    if (!isVisible()) return;
    if (i->listWidget() == templates_) emit template_chosen(templates_->row(i));
    if (i->listWidget() == recent_) emit case_chosen(i->data(Qt::UserRole).toString());
    if (i->listWidget() == runs_) emit run_chosen(i->data(Qt::UserRole).toString());
  };
  for (QListWidget* w : {recent_, runs_}) w->setTextElideMode(Qt::ElideMiddle);  // names of runs differ in their ends
  for (QListWidget* w : {templates_, recent_, runs_}) connect(w, &QListWidget::itemActivated, this, enter);
}

void StartPage::refresh(const std::vector<RunRecord>& runs) {
  recent_->clear();
  for (const QString& file : recent_cases(places_)) {
    auto* item = new QListWidgetItem(file, recent_);
    item->setData(Qt::UserRole, file);
    item->setToolTip(file);
  }
  runs_->clear();
  std::vector<Session> sessions;
  for (const RunRecord& run : runs) sessions.push_back(run.session);
  const std::vector<bool> alive = are_alive(sessions);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const RunRecord& run = runs[i];
    auto* item = new QListWidgetItem(tr("%1%2, ranks: %3")
                                         .arg(alive[i] || is_held(run.folder) ? tr("running: ") : QString(), run.folder)
                                         .arg(run.ranks),
                                     runs_);
    item->setData(Qt::UserRole, run.folder);
    item->setToolTip(run.folder);
  }
}

}  // namespace breccia::gui
