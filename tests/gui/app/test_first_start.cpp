// SPDX-License-Identifier: MIT
// What the program does before its window is seen for the first time.
#include <QApplication>
#include <QHash>
#include <QSettings>
#include <QTemporaryDir>
#include <QtTest>
#include <numeric>

#include "app/wizard_window.h"

using namespace relucent::gui;

namespace {

/// How often widgets are given a style.
class Styling : public QObject {
 public:
  Styling() { qApp->installEventFilter(this); }
  int times() const { return std::accumulate(times_.begin(), times_.end(), 0); }
  qsizetype widgets() const { return times_.size(); }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == QEvent::StyleChange && watched->isWidgetType()) ++times_[watched];
    return false;
  }

 private:
  QHash<QObject*, int> times_;
};

}  // namespace

class TestFirstStart : public QObject {
  Q_OBJECT

 private slots:
  /// Law: however deep a widget lies, it is styled once before the window is shown. Twice is what Qt does
  /// with those few that make parts of their own, like lists of combo boxes.
  void aWidgetIsStyledOnce() {
    const QTemporaryDir folder;
    QSettings settings(folder.filePath("settings.ini"), QSettings::IniFormat);
    const Styling styling;
    const WizardWindow wizard(settings, folder.filePath("cache").toStdString());
    QVERIFY(styling.widgets() > 100);
    QVERIFY2(styling.times() < 2 * styling.widgets(),
             qPrintable(QString("%1 times, %2 widgets").arg(styling.times()).arg(styling.widgets())));
  }
};

QTEST_MAIN(TestFirstStart)
#include "test_first_start.moc"
