// SPDX-License-Identifier: MIT
#include "views/number_text.h"

#include <QTextLayout>
#include <QtTest>
#include <functional>
#include <limits>

using namespace relucent;
using namespace relucent::gui;

namespace {

/// Whether the letters stand from left to right, as in a sentence that is read from the right.
bool standsFromTheLeft(const QString& text) {
  QTextOption option;
  option.setTextDirection(Qt::RightToLeft);
  QTextLayout layout(text);
  layout.setTextOption(option);
  layout.beginLayout();
  QTextLine line = layout.createLine();
  layout.endLayout();
  double before = -1.0;
  for (int i = 0; i < text.size(); ++i) {
    if (text[i].category() == QChar::Other_Format) continue;
    const QList<QGlyphRun> runs = line.glyphRuns(i, 1);
    if (runs.isEmpty() || runs.first().positions().isEmpty()) continue;
    double at = runs.first().positions().first().x();
    if (at < before) return false;
    before = at;
  }
  return true;
}

QString plain(QString text) {
  return text.remove(QChar(0x2068)).remove(QChar(0x2069));
}

}  // namespace

class TestNumberText : public QObject {
  Q_OBJECT

 private slots:
  void init() { QLocale::setDefault(QLocale(QLocale::English, QLocale::UnitedStates)); }
  void cleanup() { QGuiApplication::setLayoutDirection(Qt::LeftToRight); }

  void manyAreSaidInWords_data() {
    QTest::addColumn<quint64>("count");
    QTest::addColumn<QString>("text");
    QTest::newRow("none") << quint64(0) << "0";
    QTest::newRow("thousands") << quint64(999499) << QString::fromUtf8("999\u202F499");
    QTest::newRow("a million") << quint64(1000000) << "1.00 million";
    QTest::newRow("millions") << quint64(30123456) << "30.1 million";
    QTest::newRow("hundreds of them") << quint64(943632423) << "944 million";
    QTest::newRow("billions") << quint64(2148000000) << "2.15 billion";
  }
  void manyAreSaidInWords() {
    QFETCH(quint64, count);
    QFETCH(QString, text);
    QCOMPARE(plain(largeText(count)), text);
  }

  void threeDigits_data() {
    QTest::addColumn<double>("value");
    QTest::addColumn<QString>("text");
    QTest::newRow("nothing") << 0.0 << "0";
    QTest::newRow("small") << 0.01234 << "0.0123";
    QTest::newRow("usual") << 1.2345 << "1.23";
    QTest::newRow("thousands") << 21480.0 << QString::fromUtf8("21\u202F480");
    QTest::newRow("less than nothing") << -21480.0 << QString::fromUtf8("-21\u202F480");
    QTest::newRow("many") << 2148000.0 << QString::fromUtf8("2.1 × 10⁶");
    QTest::newRow("hardly any") << 7.94e-4 << QString::fromUtf8("7.9 × 10⁻⁴");
    QTest::newRow("rounded up to ten") << 9.97e-6 << QString::fromUtf8("1.0 × 10⁻⁵");
    QTest::newRow("none") << std::numeric_limits<double>::quiet_NaN() << QString::fromUtf8("–");
  }
  void threeDigits() {
    QFETCH(double, value);
    QFETCH(QString, text);
    QCOMPARE(numberText(value), text);
  }

  void sharesAreSaidByTheirSize_data() {
    QTest::addColumn<double>("share");
    QTest::addColumn<QString>("text");
    QTest::newRow("nothing") << 0.0 << "0";
    QTest::newRow("hardly any") << 1.4e-5 << "0.0014";
    QTest::newRow("little") << 8e-4 << "0.08";
    QTest::newRow("some") << 0.0123 << "1.2";
    QTest::newRow("less than nothing") << -0.0123 << "-1.2";
    QTest::newRow("all") << 0.9999 << "100";
  }
  void sharesAreSaidByTheirSize() {
    QFETCH(double, share);
    QFETCH(QString, text);
    QCOMPARE(percentText(share), text + QString::fromUtf8("\u202F%"));
  }

  /// Law: what no digit is left of has no sign.
  void nothingIsNotLessThanNothing() {
    QCOMPARE(decimalText(-0.004, 2), QString("0.00"));
    QCOMPARE(decimalText(-0.006, 2), QString("-0.01"));
    QCOMPARE(decimalText(-0.4, 0), QString("0"));
    QCOMPARE(decimalText(0.004, 2), QString("0.00"));
  }

  void thousandsAreApartInSentences() {
    QCOMPARE(groupedText("21480 clusters, median %1", 21480),
             QString::fromUtf8("21\u202F480 clusters, median %1"));
    QCOMPARE(groupedText("999 clusters", 999), QString("999 clusters"));
    QCOMPARE(countText(1234567), QString::fromUtf8("1\u202F234\u202F567"));
  }

  /// In every language the same text; where one reads from the right it keeps its order all the same.
  void keepTheirOrder_data() {
    QTest::addColumn<QString>("left");
    QTest::addColumn<QString>("right");
    auto row = [](const char* name, const std::function<QString()>& text) {
      QString left = text();
      QGuiApplication::setLayoutDirection(Qt::RightToLeft);
      QTest::newRow(name) << left << text();
      QGuiApplication::setLayoutDirection(Qt::LeftToRight);
    };
    row("power", [] { return numberText(7.9e-4); });
    row("decimals", [] { return decimalText(-12.5, 1); });
    row("percent", [] { return percentText(0.986); });
    row("count", [] { return countText(21480); });
    row("bytes", [] { return bytesText(412000000); });
    row("exposure", [] { return exposureText(1.0 / 30.0); });
    row("long exposure", [] { return exposureText(2.5); });
    row("size", [] { return sizeText(1024, 768); });
    row("place", [] { return placeText(12, 34); });
  }
  void keepTheirOrder() {
    QFETCH(QString, left);
    QFETCH(QString, right);
    QCOMPARE(plain(right), left);
    QVERIFY2(standsFromTheLeft(right), qPrintable(right));
  }

  void bytesHaveThreeDigits_data() {
    QTest::addColumn<quint64>("bytes");
    QTest::addColumn<QString>("text");
    QTest::newRow("few") << quint64{6'540'000} << "6.5 MB";
    QTest::newRow("tens") << quint64{29'400'000'000} << "29.4 GB";
    QTest::newRow("hundreds") << quint64{114'000'000} << "114 MB";
    QTest::newRow("nearly the next unit") << quint64{999'400'000} << "999 MB";
  }
  void bytesHaveThreeDigits() {
    QFETCH(quint64, bytes);
    QFETCH(QString, text);
    const auto back = qScopeGuard([before = QLocale()] { QLocale::setDefault(before); });
    QLocale::setDefault(QLocale::c());
    QCOMPARE(plain(bytesText(bytes)), text);
  }

  /// What the isolates are for.
  void withoutThemTheyWouldBeTurnedRound() {
    QVERIFY(!standsFromTheLeft(sizeText(1024, 768)));
    QVERIFY(!standsFromTheLeft(exposureText(1.0 / 30.0)));
  }
};

QTEST_MAIN(TestNumberText)
#include "test_number_text.moc"
