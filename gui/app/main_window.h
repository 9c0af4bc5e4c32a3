// SPDX-License-Identifier: MIT
#pragma once

#include <QLabel>
#include <QMainWindow>
#include <QPointer>
#include <QStackedWidget>
#include <vector>

#include "app/language.h"
#include "wizard/frame/action_bar.h"
#include "wizard/frame/banner_bar.h"
#include "wizard/frame/end_question.h"
#include "wizard/frame/page_view.h"
#include "wizard/frame/preferences.h"
#include "wizard/frame/status_strip.h"
#include "wizard/frame/step_rail.h"

namespace relucent::gui {

class HelpWindow;

/// The frame around all pages: rail, header, banner, stage, inspector, action bar, status strip, and the keys
/// that work everywhere. Knows pages by their interface only.
class MainWindow : public QMainWindow {
  Q_OBJECT

 public:
  /// `views`: one for each page of the wizard.
  MainWindow(Session& session, Wizard& wizard, Preferences& preferences, const Language& language,
             std::vector<PageView> views);

  void showSettings();
  /// Opens the guide at the page of the current step.
  void showHelp();
  /// Also while something is measured or played, which close() asks about first.
  void closeWithoutAsking();

 protected:
  void showEvent(QShowEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  void closeEvent(QCloseEvent* event) override;

 Q_SIGNALS:
  /// A calibration was dropped on the window.
  void dropped(const QString& folder);

 private:
  void buildHeader();
  void buildRailFooter();
  void fitRailFooter();
  void bindKeys();
  void setFullScreen(bool whole);
  void refresh();
  void moveToNextRegion();
  void undo();
  void redo();
  void returnFocus();
  void returnKeptFocus();
  void forgetKeptFocus();
  void followFocus(QWidget* before, QWidget* now);
  bool isPassedOn(const QWidget* before, const QWidget* now) const;
  void tell(const PageModel& page, const FailureReport& report);
  void closeOnceDevicesAreFree();

  Session& session_;
  Wizard& wizard_;
  Preferences& preferences_;
  const Language& language_;
  std::vector<PageView> views_;
  StepRail* rail_;
  BannerBar* banner_;
  bool hasWorked_ = false;       // the page that is looked at
  QPointer<QWidget> focusKept_;  // of a button in the inspector that cannot be pressed now
  bool isReturning_ = false;     // the focus that was kept
  QPointer<QWidget> focusLent_;  // until the command that had it can be given again
  ActionBar* actions_;
  StatusStrip* strip_;
  QWidget* header_;
  EndQuestion endQuestion_;
  bool asksBeforeClosing_ = true;
  ElidedLabel *title_, *subtitle_;
  QPushButton* dim_;
  std::vector<QPushButton*> footer_;  // of the rail
  HelpWindow* help_ = nullptr;        // once it has been opened
  QStackedWidget *stages_, *inspectors_;
};

}  // namespace relucent::gui
