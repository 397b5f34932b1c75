#pragma once

#include <QListWidget>

#include "core/places.hpp"

namespace breccia::gui {

/// Its drawing on a clear ground, as a resource; not each template may have one.
[[nodiscard]] QString picture_of_template(const Template& t);

/// The first thing one sees: templates with pictures, recent cases, runs that were started here.
class StartPage final : public QWidget {
  Q_OBJECT
 public:
  explicit StartPage(const Places& places, QWidget* parent = nullptr);
  void refresh(const std::vector<RunRecord>& runs);

 signals:
  void template_chosen(int number);
  void case_chosen(const QString& file);
  void run_chosen(const QString& folder);
  void demo_wanted();
  void open_wanted();
  void import_wanted();

 private:
  const Places& places_;
  QListWidget *templates_, *recent_, *runs_;
};

}  // namespace breccia::gui
