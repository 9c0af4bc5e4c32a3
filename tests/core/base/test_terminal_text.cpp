// SPDX-License-Identifier: MIT
#include "relucent/base/terminal_text.h"

#include <QtTest>

#include "relucent/base/random.h"

using namespace relucent;
using namespace std::string_literals;

class TestTerminalText : public QObject {
  Q_OBJECT

 private slots:
  void whatTerminalsObeyIsSpelledOut_data() {
    QTest::addColumn<std::string>("text");
    QTest::addColumn<std::string>("shown");
    auto row = [](const char* name, const std::string& text, const std::string& shown) {
      QTest::newRow(name) << text << shown;
    };
    row("plain", "R, G and B of flood-1.exr: 3 x 4\n", "R, G and B of flood-1.exr: 3 x 4\n");
    row("languages", "Größe λ² 画像 صورة 🎭", "Größe λ² 画像 صورة 🎭");
    row("tab and line feed", "a\tb\nc", "a\tb\nc");
    row("colour", "\x1b[31mred\x1b[0m", "\\x1b[31mred\\x1b[0m");
    row("title", "\x1b]0;owned\x07", "\\x1b]0;owned\\x07");
    row("carriage return", "safe\rgone", "safe\\x0dgone");
    row("delete", "a\x7f", "a\\x7f");
    row("zero", "a\0b"s, "a\\x00b");
    row("C1",
        "a\xc2\x9b"
        "31m",
        "a\\xc2\\x9b31m");
    row("no-break space", "1\xc2\xa0m", "1\xc2\xa0m");
    row("raw C1",
        "\x9b"
        "31m",
        "\\x9b31m");
    row("cut off", "\xe2\x82", "\\xe2\\x82");
    row("too long", "\xc0\x9b", "\\xc0\\x9b");
    row("surrogate", "\xed\xa0\x80", "\\xed\\xa0\\x80");
    row("beyond Unicode", "\xf4\x90\x80\x80", "\\xf4\\x90\\x80\\x80");
  }
  void whatTerminalsObeyIsSpelledOut() {
    QFETCH(std::string, text);
    QFETCH(std::string, shown);
    QCOMPARE(forTerminal(text), shown);
  }

  void aLogLineIsOneLine() { QCOMPARE(forLogLine("a\nplaying\tb"), "a\\x0aplaying\tb"s); }

  /// Law: whatever comes in, what comes out is UTF-8 without control characters, and stays as it is then.
  void anythingComesOutHarmless() {
    Random random{1};
    for (int round = 0; round < 2000; ++round) {
      std::string text;
      for (int i = 0; i < 24; ++i) text += static_cast<char>(256.0 * random.uniform());
      const std::string shown = forTerminal(text);
      QCOMPARE(QString::fromUtf8(shown.c_str(), static_cast<qsizetype>(shown.size())).toStdString(), shown);
      for (QChar letter : QString::fromStdString(shown))
        QVERIFY(letter == '\n' || letter == '\t' || letter.category() != QChar::Other_Control);
      QCOMPARE(forTerminal(shown), shown);
    }
  }
};

QTEST_APPLESS_MAIN(TestTerminalText)
#include "test_terminal_text.moc"
