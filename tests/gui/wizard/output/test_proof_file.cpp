// SPDX-License-Identifier: MIT
// A verification photograph that is looked at on another day.
#include "wizard/output/proof_file.h"

#include <QTemporaryDir>
#include <QtTest>

#include "relucent/base/file.h"
#include "relucent/image/exr.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::gui;
using namespace relucent::image;

class TestProofFile : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  std::filesystem::path path() const { return folder_.path().toStdString(); }

  static Proof proof() {
    Proof proof;
    proof.figures.method = Method::refined;
    proof.figures.before = {{18.5, 15.25}, {18.25, 15.5}, 0.03};
    proof.figures.after = {{38.0, 2.25}, {36.5, 2.75}, 0.05};
    proof.figures.reachable = 0.968;
    proof.taken = QDateTime(QDate(2026, 3, 29), QTime(1, 30, 5));
    proof.measured = "2026-03-28T22:00:00Z";
    proof.shownFrom = "0123456789abcdef";
    proof.picture = "/pictures/\u00fcber all.png";
    proof.content.picture = "picture.png";
    proof.content.corners = Corners{{{1.0, 2.0}, {40.0, 2.5}, {41.0, 30.0}, {0.5, 31.0}}};
    return proof;
  }

  /// As proving leaves them.
  void writePictures(QSize photograph) {
    QImage wanted(4, 3, QImage::Format_RGB32);
    wanted.fill(Qt::darkRed);
    QImage after(photograph, QImage::Format_RGB32);
    after.fill(Qt::darkGreen);
    QVERIFY(wanted.save(folder_.filePath("target.png")) && after.save(folder_.filePath("after.png")));
    writeExr(path() / "after_delta_e.exr", Image(Size{4, 3}, 1, 2.5f), ExrType::floatType);
  }

 private slots:
  void init() {
    for (const char* file : {"proof.json", "target.png", "after.png", "after_delta_e.exr"})
      QFile::remove(folder_.filePath(file));
  }

  void whatIsSavedIsLoaded() {
    writePictures({4, 3});
    const Proof saved = proof();
    saveProof(saved, path());
    const auto loaded = loadProof(path());
    QVERIFY(loaded != nullptr);
    QCOMPARE(loaded->figures.method, saved.figures.method);
    QCOMPARE(loaded->figures.before.measured.deltaE, saved.figures.before.measured.deltaE);
    QCOMPARE(loaded->figures.after.predicted.psnr, saved.figures.after.predicted.psnr);
    QCOMPARE(loaded->figures.after.surprise, saved.figures.after.surprise);
    QCOMPARE(loaded->figures.reachable, saved.figures.reachable);
    QCOMPARE(loaded->taken, saved.taken);
    QCOMPARE(loaded->measured, saved.measured);
    QCOMPARE(loaded->shownFrom, saved.shownFrom);
    QCOMPARE(loaded->picture, saved.picture);
    QVERIFY(loaded->content == saved.content);
    QCOMPARE(loaded->view(0).photograph.size(), QSize(4, 3));
    QCOMPARE(loaded->view(0).deltaE.at(1, 1, 0), 2.5f);
    QVERIFY(loaded->isAsPredicted());
  }

  void whatIsBrokenIsNoProof_data() {
    QTest::addColumn<QByteArray>("json");
    QTest::addColumn<QSize>("photograph");
    QTest::newRow("none") << QByteArray() << QSize(4, 3);
    QTest::newRow("no JSON") << QByteArray("{\"taken\": ") << QSize(4, 3);
    QTest::newRow("not all") << QByteArray("{\"taken\": \"2026-03-29T01:30:05Z\"}") << QSize(4, 3);
    QTest::newRow("pictures of two photographs") << QByteArray("as it was") << QSize(5, 3);
  }
  void whatIsBrokenIsNoProof() {
    QFETCH(QByteArray, json);
    QFETCH(QSize, photograph);
    writePictures(photograph);
    if (json == "as it was")
      saveProof(proof(), path());
    else if (!json.isEmpty())
      writeFileAtomically(path() / "proof.json", json.toStdString());
    QVERIFY(loadProof(path()) == nullptr);
  }
};

QTEST_GUILESS_MAIN(TestProofFile)
#include "test_proof_file.moc"
