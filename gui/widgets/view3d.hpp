#pragma once

#include <QVTKOpenGLNativeWidget.h>
#include <vtkNew.h>

#include <QCheckBox>
#include <QComboBox>
#include <QImage>
#include <QMenu>
#include <QSlider>

#include "render/scene.hpp"
#include "widgets/colour_range_box.hpp"
#include "widgets/cut_bar.hpp"
#include "widgets/deformation_box.hpp"

namespace breccia::gui {

/// The 3D view with what it is coloured by.
class View3D final : public QWidget {
  Q_OBJECT
 public:
  explicit View3D(QWidget* parent = nullptr);

  [[nodiscard]] Scene& scene() { return scene_; }
  void show_frame(const FrameData& frame, const QString& caption);
  void clear(const QString& caption);
  [[nodiscard]] const QString& caption() const { return caption_; }
  /// Chooses what the mesh or the results in view are coloured by.
  void set_colouring(Colouring colouring);
  /// The same, unless one has been chosen for them.
  void offer_colouring(Colouring colouring);
  /// Another case follows: it has its mesh in the colours of its groups, and ranges of its own.
  void forget_colours();
  /// View directions, each with its key.
  [[nodiscard]] QMenu* look_menu() { return look_; }
  [[nodiscard]] QAction* cut_action() { return cut_->action(); }
  /// How displacements are to be drawn, as of Deformation.
  [[nodiscard]] double deformation() const { return deformation_->scale(); }
  /// Frames of a run follow, or the mesh at rest: each keeps its colouring, and frames have displacements.
  void show_results(bool on);
  /// Draws these faces in front of all others, with words for them; nullptr: none, and the caption of the frame.
  void mark(vtkPolyData* faces, const QString& words);
  /// Seen as glyphs where that is switched on.
  void set_loads(std::vector<Load> loads);
  void set_dark(bool dark);
  /// Soon, once for all requests until then.
  void render();
  void render_now();
  /// What is drawn now.
  [[nodiscard]] QImage picture();
  /// Shows that a click is waited for.
  void set_picking(bool on);
  /// What is seen at a place of the canvas.
  [[nodiscard]] Scene::Picked picked_at(const QPoint& place) const;
  /// Share of the pixels that differ from the background; for tests.
  [[nodiscard]] double drawn_share();

 signals:
  /// It was clicked on, without dragging.
  void picked(const Scene::Picked& what);
  void colouring_changed(Colouring colouring);
  /// The frame in view is to be drawn anew with it.
  void deformation_chosen();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  /// What a mesh or results are coloured by.
  struct Choice {
    Colouring colouring = Colouring::group;
    bool is_chosen = false;
  };
  void make_look_menu();
  void make_joints_boxes();
  void take_colouring();
  void show_colouring(Colouring colouring);
  [[nodiscard]] Choice& choice() { return choices_[shows_results_ ? 1 : 0]; }
  void make_boxes();
  void make_cut_bar();
  void fill_bar();
  /// What the ends of the colours are now.
  void show_range();
  /// What is drawn, and how.
  void write_caption();
  Scene scene_;
  vtkNew<vtkGenericOpenGLRenderWindow> window_;
  QVTKOpenGLNativeWidget* canvas_;
  std::array<Choice, 2> choices_;  ///< of a mesh, of results
  bool shows_results_ = false;
  QComboBox *colour_, *joints_, *damage_;
  QCheckBox *edges_, *skin_, *loads_;
  QSlider* explode_;
  QMenu* look_;
  ColourRangeBox* range_;
  CutBar* cut_;
  DeformationBox* deformation_;
  QString scale_words_;  ///< of the frame, where displacements are not drawn as they are
  QString caption_;      ///< of the frame
  QString marked_;       ///< words for the faces that are marked; empty: there are none
  QPoint pressed_;
  bool will_render_ = false;
};

}  // namespace breccia::gui
