#pragma once

#include <QComboBox>
#include <QDialog>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QTableWidget>

#include "core/function_edit.hpp"
#include "widgets/line_chart.hpp"

namespace breccia::gui {

/// A function of time: its kind, its numbers, and what the solver makes of it over the run. The case gets it when it is
/// accepted, as one edit.
class FunctionDialog final : public QDialog {
  Q_OBJECT
 public:
  /// @param path  of a value whose key takes functions
  FunctionDialog(Document& document, const QString& path, QWidget* parent = nullptr);
  void accept() override;

 private:
  void make_head(QFormLayout& head);
  void show_parts();
  void show_kind();
  [[nodiscard]] QWidget* box_of(const FunctionPart& part, bool alone);
  void add_number(const FunctionPart& part, const FunctionNumber& number, QFormLayout& form);
  void add_table(const FunctionPart& part, QFormLayout& form);
  [[nodiscard]] QTableWidget* table_of(const FunctionPart& part);
  void paste(const FunctionPart& part);
  void show_curves();
  [[nodiscard]] int component() const { return component_->currentIndex(); }

  Document& document_;
  FunctionEdit edit_;
  QComboBox *component_, *kind_;
  QPushButton* add_;
  QScrollArea* area_;
  LineChart* chart_;
  QLabel* words_;
};

/// Kind of a summand for people: "ramp".
[[nodiscard]] QString words_of_kind(const QString& kind);

}  // namespace breccia::gui
