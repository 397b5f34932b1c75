#include "widgets/view3d.hpp"

#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkRenderWindowInteractor.h>

#include <QLabel>
#include <QMouseEvent>
#include <QPushButton>
#include <QSet>
#include <QVBoxLayout>

#include "widgets/folding_bar.hpp"

namespace breccia::gui {

View3D::View3D(QWidget* parent)
    : QWidget(parent),
      canvas_(new QVTKOpenGLNativeWidget),
      colour_(new QComboBox),
      joints_(new QComboBox),
      damage_(new QComboBox),
      edges_(new QCheckBox(tr("Edges"))),
      skin_(new QCheckBox(tr("So&lid"))),
      loads_(new QCheckBox(tr("Loads"))),
      explode_(new QSlider(Qt::Horizontal)),
      look_(new QMenu(tr("&View from"), this)),
      range_(new ColourRangeBox),
      cut_(new CutBar),
      deformation_(new DeformationBox) {
  window_->SetMultiSamples(0);
  canvas_->setRenderWindow(window_);
  window_->SetNumberOfLayers(2);
  window_->AddRenderer(scene_.renderer());
  window_->AddRenderer(scene_.axes_renderer());
  vtkNew<vtkInteractorStyleTrackballCamera> style;
  window_->GetInteractor()->SetInteractorStyle(style);
  canvas_->setObjectName("canvas");
  canvas_->setAccessibleName(tr("3D view"));
  canvas_->setToolTip(tr("Drag: turn; wheel: zoom; middle button: move; click: choose a face or a group"));
  canvas_->installEventFilter(this);
  canvas_->setFocusPolicy(Qt::StrongFocus);
  canvas_->setMinimumSize(320, 220);

  for (const auto& [colouring, name] : colourings())
    colour_->addItem(QString::fromStdString(name), static_cast<int>(colouring));
  colour_->setObjectName("colour_by");
  colour_->setAccessibleName(tr("Colour by"));
  colour_->setToolTip(tr("Quantity of the colours"));
  connect(colour_, qOverload<int>(&QComboBox::currentIndexChanged), this, &View3D::take_colouring);
  connect(colour_, qOverload<int>(&QComboBox::activated), this, [this] { choice().is_chosen = true; });
  make_joints_boxes();
  make_boxes();
  make_look_menu();
  make_cut_bar();
  connect(deformation_, &DeformationBox::chosen, this, &View3D::deformation_chosen);
  connect(range_, &ColourRangeBox::chosen, this, [this](const ColourRange& range) {
    scene_.set_colour_range(range);
    show_range();
    render();
  });
  show_range();
  fill_bar();
}

void View3D::make_cut_bar() {
  cut_->set_model([this](const Vector& way) { return scene_.extent(way); }, [this] { return scene_.look(); });
  connect(cut_, &CutBar::changed, this, [this] {
    scene_.set_cut(cut_->plane());
    show_range();
    write_caption();
    render();
  });
}

/// Which joints are drawn, and their colours.
void View3D::make_joints_boxes() {
  damage_->addItem(tr("broken"));
  for (const int percent : {90, 75, 50, 25, 0}) damage_->addItem(tr("≥ %1 %").arg(percent), percent / 100.0);
  damage_->setObjectName("joints_damage");
  damage_->setAccessibleName(tr("Joints that are drawn"));
  damage_->setToolTip(
      tr("Broken joints are the cracks; others hold, and are drawn only where they have at least so much damage"));
  connect(damage_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this] {
    const QVariant least = damage_->currentData();
    scene_.set_least_damage(least.isValid() ? std::optional(least.toDouble()) : std::nullopt);
    render();
  });
  joints_->addItem(tr("mode"), static_cast<int>(JointColouring::mode));
  joints_->addItem(tr("time of failure"), static_cast<int>(JointColouring::time_of_failure));
  joints_->addItem(tr("hidden"), static_cast<int>(JointColouring::hidden));
  joints_->setObjectName("joints_by");
  joints_->setAccessibleName(tr("Joints by"));
  joints_->setToolTip(
      tr("Quantity of the colours of joints; intact joints have no time of failure: grey. Hidden: none is drawn"));
  connect(joints_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this] {
    scene_.set_joint_colouring(static_cast<JointColouring>(joints_->currentData().toInt()));
    render();
  });
}

void View3D::take_colouring() {
  scene_.set_colouring(static_cast<Colouring>(colour_->currentData().toInt()));
  choice().colouring = scene_.colouring();
  show_range();
  render();
  emit colouring_changed(scene_.colouring());
}

void View3D::make_boxes() {
  edges_->setObjectName("edges");
  edges_->setAccessibleName(tr("Edges of elements"));
  edges_->setToolTip(tr("Draw the edges of the elements"));
  connect(edges_, &QCheckBox::toggled, this, [this](bool on) {
    scene_.show_edges(on);
    render();
  });
  skin_->setObjectName("solid");
  skin_->setChecked(true);
  skin_->setAccessibleName(tr("Solid bodies"));
  skin_->setToolTip(tr("Draw the bodies opaque; otherwise they are transparent and show the broken joints"));
  connect(skin_, &QCheckBox::toggled, this, [this](bool on) {
    scene_.show_skin(on);
    render();
  });
  loads_->setObjectName("loads");
  loads_->setChecked(true);
  loads_->setShortcut(QKeySequence("Ctrl+L"));
  loads_->setAccessibleName(tr("Loads and constraints"));
  loads_->setToolTip(
      tr("Draw the conditions of the current stage: arrows for loads and motions, cones for constraints (Ctrl+L)"));
  connect(loads_, &QCheckBox::toggled, this, [this](bool on) {
    scene_.show_loads(on);
    render();
  });
  explode_->setObjectName("explode");
  explode_->setRange(0, 100);
  explode_->setMinimumWidth(60);
  explode_->setMaximumWidth(120);
  explode_->setAccessibleName(tr("Explode"));
  explode_->setToolTip(tr("Moves the parts of different ranks away from each other"));
  connect(explode_, &QSlider::valueChanged, this, [this](int x) {
    scene_.set_explode(x / 50.0);
    render();
  });
}

void View3D::make_look_menu() {
  const auto add = [this](const QString& text, const QString& keys, LookFrom where) {
    QAction* action = look_->addAction(text);
    action->setShortcut(QKeySequence(keys));
    connect(action, &QAction::triggered, this, [this, where] {
      scene_.look_from(where);
      render();
    });
  };
  add(tr("A &corner"), "Ctrl+0", LookFrom::corner);
  add(tr("+x"), "Ctrl+1", LookFrom::plus_x);
  add(tr("-x"), "Ctrl+2", LookFrom::minus_x);
  add(tr("+y"), "Ctrl+3", LookFrom::plus_y);
  add(tr("-y"), "Ctrl+4", LookFrom::minus_y);
  add(tr("+z"), "Ctrl+5", LookFrom::plus_z);
  add(tr("-z"), "Ctrl+6", LookFrom::minus_z);
  look_->addSeparator();
  QAction* axes = look_->addAction(tr("&Axes and scale"));
  axes->setShortcut(QKeySequence("Ctrl+7"));
  axes->setCheckable(true);
  axes->setChecked(true);
  connect(axes, &QAction::toggled, this, [this](bool on) {
    scene_.show_axes(on);
    render();
  });
}

void View3D::fill_bar() {
  auto* look = new QPushButton(tr("View from"));
  look->setObjectName("look_from");
  look->setAccessibleName(tr("View from"));
  look->setToolTip(tr("View along an axis (Ctrl+1 to Ctrl+6) or from a corner (Ctrl+0); axes and scale (Ctrl+7)"));
  look->setMenu(look_);
  auto* fit = new QPushButton(tr("Fit"));
  fit->setObjectName("fit");
  fit->setAccessibleName(tr("Fit the view"));
  fit->setToolTip(tr("Show everything"));
  connect(fit, &QPushButton::clicked, this, [this] {
    scene_.reset_camera();
    render();
  });

  auto* bar = new FoldingBar;
  auto* label = new QLabel(tr("&Colour by"));
  label->setBuddy(colour_);
  QHBoxLayout *shown = bar->row(0), *seen_from = bar->row(1);
  shown->addWidget(label);
  shown->addWidget(colour_);
  shown->addWidget(edges_);
  shown->addWidget(skin_);
  shown->addWidget(loads_);
  seen_from->addWidget(new QLabel(tr("Joints")));
  seen_from->addWidget(damage_);
  seen_from->addWidget(joints_);
  seen_from->addWidget(new QLabel(tr("Explode")));
  seen_from->addWidget(explode_);
  seen_from->addStretch();
  seen_from->addWidget(look);
  seen_from->addWidget(fit);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(2, 2, 2, 2);
  column->addWidget(bar);
  auto* how = new FoldingBar;
  how->row(0)->addWidget(cut_, 1);
  how->row(1)->addWidget(range_);
  how->row(1)->addWidget(new QLabel(tr("Displacements")));
  how->row(1)->addWidget(deformation_);
  how->row(1)->addStretch();
  column->addWidget(how);
  column->addWidget(canvas_, 1);
}

bool View3D::eventFilter(QObject* watched, QEvent* event) {
  constexpr int kStill = 3;  // pixels that a hand moves in a click
  if (watched == canvas_ && event->type() == QEvent::MouseButtonPress) {
    pressed_ = static_cast<QMouseEvent*>(event)->pos();
  } else if (watched == canvas_ && event->type() == QEvent::MouseButtonRelease) {
    const auto* mouse = static_cast<QMouseEvent*>(event);
    if (mouse->button() == Qt::LeftButton && (mouse->pos() - pressed_).manhattanLength() <= kStill) {
      if (const Scene::Picked what = picked_at(mouse->pos()); !what.volume.empty()) emit picked(what);
    }
  }
  return QWidget::eventFilter(watched, event);
}

Scene::Picked View3D::picked_at(const QPoint& place) const {
  const double ratio = canvas_->devicePixelRatioF();
  return scene_.picked_at(ratio * place.x(), ratio * (canvas_->height() - 1 - place.y()));
}

void View3D::set_picking(bool on) {
  on ? canvas_->setCursor(Qt::CrossCursor) : canvas_->unsetCursor();
  if (on) canvas_->setFocus();
}

/// A call that waits comes before the window is painted, which takes long enough the first time.
void View3D::render() {
  if (will_render_) return;
  will_render_ = true;
  QMetaObject::invokeMethod(this, &View3D::render_now, Qt::QueuedConnection);
}

void View3D::render_now() {
  will_render_ = false;
  window_->Render();
}

void View3D::write_caption() {
  const QString words = marked_.isEmpty() ? caption_ : marked_;
  scene_.set_caption((scene_.has_data() ? words + scale_words_ + cut_->words() : words).toStdString());
}

void View3D::show_range() {
  range_->setEnabled(scene_.has_data() && quantity_of(scene_.colouring()));
  range_->show_range(scene_.colour_range(), scene_.range());
}

void View3D::show_frame(const FrameData& frame, const QString& caption) {
  const bool is_new = !scene_.has_data();
  scene_.show(frame);
  caption_ = caption;
  marked_.clear();
  scale_words_ = words_of(frame.deformation);
  cut_->follow_model(is_new);
  show_range();
  write_caption();
  render();
}

void View3D::mark(vtkPolyData* faces, const QString& words) {
  scene_.mark(faces);
  marked_ = faces == nullptr ? QString() : words;
  write_caption();
  render();
}

void View3D::clear(const QString& caption) {
  scene_.clear();
  caption_ = caption;
  marked_.clear();
  write_caption();
  render();
}

void View3D::set_colouring(Colouring colouring) {
  choice().is_chosen = true;
  show_colouring(colouring);
}

void View3D::show_colouring(Colouring colouring) {
  const int index = colour_->findData(static_cast<int>(colouring));
  if (index >= 0) colour_->setCurrentIndex(index);
}

void View3D::offer_colouring(Colouring colouring) {
  if (!choice().is_chosen) show_colouring(colouring);
}

void View3D::forget_colours() {
  choices_ = {};
  scene_.forget_colour_ranges();
  show_colouring(Colouring::group);
  show_range();
}

void View3D::show_results(bool on) {
  deformation_->setEnabled(on);
  if (on == shows_results_) return;
  shows_results_ = on;
  show_colouring(choice().colouring);
}

void View3D::set_loads(std::vector<Load> loads) {
  scene_.set_loads(std::move(loads));
  render();
}

void View3D::set_dark(bool dark) {
  scene_.set_dark(dark);
  render();
}

QImage View3D::picture() {
  render_now();
  return canvas_->grabFramebuffer();
}

double View3D::drawn_share() {
  const QImage image = picture();
  qint64 drawn = 0;
  // The background has one colour a line: what differs from its left edge has been drawn.
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) drawn += image.pixel(x, y) != image.pixel(0, y) ? 1 : 0;
  return image.isNull() ? 0 : static_cast<double>(drawn) / (static_cast<double>(image.width()) * image.height());
}

}  // namespace breccia::gui
