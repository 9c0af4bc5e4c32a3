// SPDX-License-Identifier: MIT
// The one list of steps.
#include "wizard/steps.h"

#include <QTemporaryDir>
#include <QtTest>
#include <set>
#include <string>

using namespace relucent;
using namespace relucent::gui;

class TestWizardSteps : public QObject {
  Q_OBJECT

 private slots:
  void eachHasAnIdOfItsOwnAndAName() {
    std::set<std::string> ids;
    for (const WizardStep& step : wizardSteps()) {
      QVERIFY2(ids.insert(step.name.id).second, step.name.id);
      QVERIFY2(!step.name.text().isEmpty(), step.name.id);
    }
    QVERIFY(ids.size() > 1);
  }

  void theFirstIsWhereACalibrationIsOpened() { QCOMPARE(QString(wizardSteps().front().name.id), "venue"); }

  void eachMakesThePageOfItsName() {
    const QTemporaryDir folder;
    QSettings settings(folder.filePath("settings.ini"), QSettings::IniFormat);
    Preferences preferences(settings);
    Session session{std::filesystem::path()};
    for (const WizardStep& step : wizardSteps()) {
      const std::unique_ptr<PageModel> page = step.makePage({session, preferences, settings});
      QVERIFY(page->step() == step.name);
      QCOMPARE(page->name(), step.name.text());
      QVERIFY2(!page->subtitle().isEmpty(), step.name.id);
    }
  }
};

QTEST_MAIN(TestWizardSteps)
#include "test_wizard_steps.moc"
