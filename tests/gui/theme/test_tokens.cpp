// SPDX-License-Identifier: MIT
#include "theme/tokens.h"

#include <QRegularExpression>
#include <QtTest>
#include <cmath>

#include "theme/theme.h"

using namespace relucent;
using namespace relucent::gui;

namespace {

/// Relative luminance and contrast.  Source: WCAG 2.1.
double luminance(const QColor& colour) {
  auto linear = [](double value) {
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(colour.redF()) + 0.7152 * linear(colour.greenF()) + 0.0722 * linear(colour.blueF());
}
double contrast(const QColor& a, const QColor& b) {
  double bright = std::max(luminance(a), luminance(b)), dark = std::min(luminance(a), luminance(b));
  return (bright + 0.05) / (dark + 0.05);
}

}  // namespace

class TestTokens : public QObject {
  Q_OBJECT

 private slots:
  void textCanBeRead_data() {
    QTest::addColumn<int>("look");
    QTest::newRow("dark") << static_cast<int>(Look::dark);
    QTest::newRow("light") << static_cast<int>(Look::light);
  }
  void textCanBeRead() {
    QFETCH(int, look);
    const Colours& c = colours(static_cast<Look>(look));
    for (const QColor& ground : {c.window, c.rail, c.card, c.raised, c.input})
      for (const QColor& text :
           {c.text, c.secondary, c.disabled, c.accent, c.good, c.amber, c.error, c.information})
        QVERIFY2(
            contrast(text, ground) >= 4.5,
            qPrintable(QString("%1 on %2: %3").arg(text.name(), ground.name()).arg(contrast(text, ground))));
    QVERIFY(contrast(c.onAccent, c.accent) >= 4.5);
    QVERIFY(contrast(c.text, c.accentGround) >= 4.5 && contrast(c.secondary, c.accentGround) >= 4.5);
    QVERIFY(contrast(c.amber, c.amberGround) >= 4.5 && contrast(c.error, c.errorGround) >= 4.5);
    QVERIFY(contrast(c.information, c.informationGround) >= 4.5);
    for (const QColor& ground : {c.window, c.card, c.input}) QVERIFY(contrast(c.border, ground) >= 3.0);
  }

  void everyNameInTheStyleSheetIsAColour() {
    for (Look look : {Look::dark, Look::light}) {
      QString sheet = styleSheetOf(colours(look));
      QRegularExpression leftOver("\\{[a-zA-Z]+\\}");
      QVERIFY2(!leftOver.match(sheet).hasMatch(), qPrintable(leftOver.match(sheet).captured()));
    }
  }
};

QTEST_GUILESS_MAIN(TestTokens)
#include "test_tokens.moc"
