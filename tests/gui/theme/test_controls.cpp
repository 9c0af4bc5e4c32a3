// SPDX-License-Identifier: MIT
// Texts that somebody typed are shown as they are.
#include "theme/controls.h"

#include <QTextDocumentFragment>
#include <QtTest>

using namespace relucent::gui;

class TestControls : public QObject {
  Q_OBJECT

 private slots:
  /// Law: no label, nor its tooltip, takes a user's words for rich text.
  void usersWordsAreNoRichText_data() {
    QTest::addColumn<QString>("text");
    QTest::newRow("a name") << "Dome";
    QTest::newRow("what looks like markup") << "Dome <b>x";
    QTest::newRow("an entity") << "Dome &amp; <i>x</i>";
  }
  void usersWordsAreNoRichText() {
    QFETCH(QString, text);
    const std::unique_ptr<QLabel> label(labelOf(text));
    const std::unique_ptr<ElidedLabel> elided(elidedLabel("note"));
    elided->resize(1000, 20);
    elided->setWhole(text);
    for (const QLabel* shown : {label.get(), static_cast<QLabel*>(elided.get())}) {
      QCOMPARE(shown->textFormat(), Qt::PlainText);
      QCOMPARE(shown->text(), text);
    }
    const QString tip = elided->toolTip();
    QCOMPARE(Qt::mightBeRichText(tip) ? QTextDocumentFragment::fromHtml(tip).toPlainText() : tip, text);
  }
};

QTEST_MAIN(TestControls)
#include "test_controls.moc"
