// SPDX-License-Identifier: MIT
// Projectors share photographs, and all cameras see each: four and two take few more than one and one.
#include <QTemporaryDir>
#include <QtTest>
#include <filesystem>

#include "relucent/pipeline/calibrate.h"
#include "support/sanitized.h"

using namespace relucent;
using namespace relucent::pipeline;

class TestSharedPhotographs : public QObject {
  Q_OBJECT

  QTemporaryDir temporary_;

  CalibrateResult measured(const char* venue) const {
    const std::filesystem::path root = temporary_.path().toStdString();
    venue::VenueSettings rig;
    rig.name = venue;
    rig.projector = rig.camera = {64, 48};
    rig.pathsPerPixel = 64;
    CalibrateSettings settings;
    settings.rig = rig;
    Progress silent;
    return calibrate(root / venue, settings, root / "cache", silent);
  }

 private slots:
  void fourProjectorsAndTwoCamerasTakeHalfAsManyMoreAtMost() {
    if (isSanitized) QSKIP("takes minutes; what it runs is in other tests");
    const CalibrateResult one = measured("dome"), four = measured("dome4");
    QVERIFY2(2 * four.exposures <= 3 * one.exposures,
             qPrintable(QString("%1 photographs and %2").arg(four.exposures).arg(one.exposures)));
    QVERIFY2(four.verificationError < 0.03, qPrintable(QString::number(four.verificationError)));
  }
};

QTEST_GUILESS_MAIN(TestSharedPhotographs)
#include "test_shared_photographs.moc"
