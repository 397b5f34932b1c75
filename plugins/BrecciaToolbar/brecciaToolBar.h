#ifndef brecciaToolBar_h
#define brecciaToolBar_h

#include <QToolBar>

/// A button for each of the five usual pictures of a run, drawn by the macros that lie beside the plugin.
class brecciaToolBar : public QToolBar {
  Q_OBJECT
 public:
  explicit brecciaToolBar(QWidget* parent = nullptr);
};

#endif
