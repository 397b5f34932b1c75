#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QLineEdit>
#include <QSlider>
#include <array>
#include <functional>
#include <optional>

#include "render/cut.hpp"

class QAction;

namespace breccia::gui {

/// Where the model is cut open: a direction, a place along it by slider and by value, and which side is hidden.
class CutBar final : public QWidget {
  Q_OBJECT
 public:
  explicit CutBar(QWidget* parent = nullptr);

  /// No plane: the model is whole.
  [[nodiscard]] const std::optional<CutPlane>& plane() const { return plane_; }
  /// Switches it on, as it was last, and off.
  [[nodiscard]] QAction* action() { return action_; }
  /// Extent of the moving model, which is the range of the slider.
  /// @param extent  its lowest and highest coordinate along a direction, m
  /// @param look    the view direction
  void set_model(std::function<std::array<double, 2>(const Vector&)> extent, std::function<Vector()> look);
  /// The model has moved. @param is_new  it is another one, which is cut through its middle if the plane misses it
  void follow_model(bool is_new);
  /// ", cut at x = 12 mm"; empty: it is whole.
  [[nodiscard]] QString words() const;

 signals:
  void changed();

 private:
  enum class Way { none, x, y, z, view };
  [[nodiscard]] Way way() const { return static_cast<Way>(way_->currentData().toInt()); }
  void make_fields();
  void choose_way();
  void take_slider(int tick);
  void take_typed();
  void to_middle();
  void set_place(double place);
  void show_place();

  QComboBox* way_;
  QSlider* slider_;
  QLineEdit* place_;
  QCheckBox* other_;
  QAction* action_;
  std::function<std::array<double, 2>(const Vector&)> extent_;
  std::function<Vector()> look_;
  std::optional<CutPlane> plane_;
  Vector normal_{1, 0, 0};  ///< the place counts along it; the plane's own may point the other way
  double at_ = 0;           ///< m
  int last_way_ = 1;        ///< row, that the action switches on
};

}  // namespace breccia::gui
