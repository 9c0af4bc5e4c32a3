// SPDX-License-Identifier: MIT
// The user's guide: in every language that has a folder it is whole, speaks as the program does, and leads
// nowhere that is not there; a page that a language lacks is English.
#include <QCollator>
#include <QDir>
#include <QTemporaryDir>
#include <QTextDocument>
#include <QtTest>
#include <algorithm>
#include <stdexcept>

#include "app/guide.h"
#include "gui/app/translation_file.h"
#include "guide/guide_html.h"

using namespace relucent;
using namespace relucent::gui;

namespace {

const QString resource = ":/help";

/// What a pattern's group catches, or all of it.
QStringList allOf(const QString& pattern, const QString& text) {
  QStringList found;
  for (auto match = QRegularExpression(pattern).globalMatch(text); match.hasNext();) {
    QRegularExpressionMatch one = match.next();
    found << one.captured(one.lastCapturedIndex());
  }
  return found;
}

/// What a page has as many of in every language.
QList<QPair<QString, QString>> kinds() {
  return {{"headings", R"((?:^|\n)# )"},
          {"headings of parts", R"(\n## )"},
          {"pictures", R"(!\[[^\]]+\]\()"},
          {"links", R"((?<!!)\[[^\]]+\]\()"},
          {"items", R"(\n- )"},
          {"words in bold", R"(\*\*[^*]+\*\*)"},
          {"paragraphs", R"(\n\n)"},
          {"codes", "`[^`]+`"}};
}

/// "Venue" of "1 Venue".
QString withoutNumber(QString title) {
  return title.remove(QRegularExpression(R"(^\d+ )"));
}

/// As it reads within a sentence.
QString plain(QString words) {
  return words.remove(QRegularExpression("[.。]$")).toLower();
}

QString evenSpaces(QString text) {
  return text.replace(QRegularExpression("[\\x{a0}\\x{202f}]"), " ");
}

QRegularExpression patternOf(const QString& pattern) {
  return QRegularExpression(pattern, QRegularExpression::CaseInsensitiveOption);
}

/// Messages of the program that a quotation is the whole of, or the first sentences; then "more" is captured.
/// Its "…" and its numbers may be what the program fills in.
QRegularExpression messageQuotedAs(QString quote) {
  const QString gap = R"(\{\d?\}|%L?\d)";
  QString pattern = QRegularExpression::escape(quote.remove(QRegularExpression("[.]$")));
  pattern.replace(QRegularExpression(R"((?<![.\d])(\d+)(?!\d|\\\.\d))"), R"((?:\1|)" + gap + ')');
  pattern.replace(QRegularExpression::escape("…"), "(?:" + gap + ')');
  return patternOf('^' + pattern + R"((?:\.?$|(?<more>[.:]\s)))");
}

/// The first sentence of a message that goes on.
QString beginningOf(const QString& message, bool goesOn) {
  static const QRegularExpression end(R"([.:](?=\s)|[。：])");
  return goesOn ? message.left(message.indexOf(end)).trimmed() : message;
}

/// How a guide may quote a message.
QRegularExpression asQuoted(QString message) {
  message = evenSpaces(message.remove(QRegularExpression("[.。]$")));
  QString pattern = QRegularExpression::escape(message);
  pattern.replace(QRegularExpression(R"(\\\{\d?\\\}|\\%L?\d)"), R"((?:…|\d+))");
  return patternOf(pattern);
}

QString read(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
}

/// A guide of three pages, which not every language has.
class SmallGuide {
 public:
  SmallGuide() {
    for (const char* page :
         {"en/1", "en/2", "en/3", "de/1", "de/4", "ar_EG/1", "ar/1", "ar/2", "zh_CN/1", "pictures/none"})
      write(page);
  }
  QString path() const { return folder_.path(); }

 private:
  void write(const QString& page) {
    QString language = page.section('/', 0, 0), id = page.section('/', 1);
    QDir(path()).mkpath(language);
    QFile file(path() + '/' + page + (language == "pictures" ? ".png" : ".md"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(QString("# %1 %2\n\n[two](2.md)\n").arg(id, language).toUtf8());
  }
  QTemporaryDir folder_;
};

}  // namespace

class TestGuide : public QObject {
  Q_OBJECT

  void everyLanguage() {
    QTest::addColumn<QString>("language");
    for (const QString& language : guideLanguages(resource)) QTest::newRow(qPrintable(language)) << language;
  }

 private slots:
  void everyLanguageHasEveryPage_data() { everyLanguage(); }
  void everyLanguageHasEveryPage() {
    QFETCH(QString, language);
    QList<HelpPage> english = guidePages(resource, "en"), pages = guidePages(resource, language);
    QCOMPARE(pages.size(), english.size());
    for (int i = 0; i < pages.size(); ++i) {
      QVERIFY2(pages[i].language == language, qPrintable(english[i].id + " is missing"));
      QVERIFY2(!pages[i].title.isEmpty(), qPrintable(pages[i].id));
      for (const auto& [kind, pattern] : kinds())
        QVERIFY2(allOf(pattern, pages[i].text).size() == allOf(pattern, english[i].text).size(),
                 qPrintable(QString("%1: %2 %3, %4 in English")
                                .arg(pages[i].id, QString::number(allOf(pattern, pages[i].text).size()), kind,
                                     QString::number(allOf(pattern, english[i].text).size()))));
    }
  }

  void nothingLeadsNowhere_data() { everyLanguage(); }
  void nothingLeadsNowhere() {
    QFETCH(QString, language);
    QList<HelpPage> english = guidePages(resource, "en"), pages = guidePages(resource, language);
    QMap<QString, QString> titles;
    for (const HelpPage& page : pages) titles[page.id + ".md"] = withoutNumber(page.title);
    static const QString target = R"(\]\(([^)]+)\))";
    for (int i = 0; i < pages.size(); ++i) {
      QStringList targets = allOf(target, pages[i].text), wanted = allOf(target, english[i].text);
      // Sentences have another order in another language.
      targets.sort();
      wanted.sort();
      QCOMPARE(targets, wanted);
      for (const QString& link : targets)
        QVERIFY2(link.startsWith("https:") ||
                     QFile::exists(QDir::cleanPath(resource + '/' + language + '/' + link)),
                 qPrintable(pages[i].id + ": " + link));
      if (i < 8) QCOMPARE(allOf(R"(\.png\))", pages[i].text).size(), 1);  // a page a step, with its picture
      static const QRegularExpression link(R"(\[([^\]]+)\]\(([^)]+\.md)\))");
      for (auto match = link.globalMatch(pages[i].text); match.hasNext();) {
        QRegularExpressionMatch one = match.next();
        QCOMPARE(one.captured(1).toLower(), titles.value(one.captured(2)).toLower());
      }
    }
  }

  void everyPageIsMarkdown_data() { everyLanguage(); }
  void everyPageIsMarkdown() {
    QFETCH(QString, language);
    for (const HelpPage& page : guidePages(resource, language)) {
      QTextDocument document;
      document.setMarkdown(page.text);
      // Between Chinese letters and signs, ** may stay what it is.
      for (const char* mark : {"*", "](", "`"})
        QVERIFY2(!document.toPlainText().contains(mark), qPrintable(page.id + ": " + mark));
    }
  }

  void theProgramsWordsAreQuoted_data() { everyLanguage(); }
  void theProgramsWordsAreQuoted() {
    QFETCH(QString, language);
    QMultiMap<QString, QString> words;
    for (const TranslatedSentence& sentence :
         sentencesOf(QString(RELUCENT_SOURCE "/translations/relucent_%1.ts").arg(language)))
      words.insert(plain(sentence.source),
                   plain(language == "en" ? sentence.source : sentence.forms.value(0)));
    QList<HelpPage> english = guidePages(resource, "en"), pages = guidePages(resource, language);
    int found = 0;
    for (int i = 0; i < pages.size(); ++i) {
      QStringList quoted = allOf(R"((?<!\*)\*([^*]+)\*(?!\*))", english[i].text);
      if (i < 8) quoted << withoutNumber(english[i].title);
      QString text = pages[i].text.toLower();
      for (const QString& phrase : quoted) {
        QStringList translated = words.values(plain(phrase));
        found += static_cast<int>(translated.size());
        auto holds = [&](const QString& word) { return text.contains(word); };
        QVERIFY2(translated.isEmpty() || std::any_of(translated.begin(), translated.end(), holds),
                 qPrintable(pages[i].id + ": " + phrase + ": " + translated.join(", ")));
      }
    }
    QVERIFY(language == "en" || found > 40);
  }

  /// Law: what stands in quotation marks is a message of the program, or the sentences that it begins with,
  /// and it is that message in every language.
  void quotedMessagesAreTheProgramsOwn_data() { everyLanguage(); }
  void quotedMessagesAreTheProgramsOwn() {
    QFETCH(QString, language);
    // English has a file of its plurals only; the file of any other language has every sentence.
    const QString known = language == "en" ? QString("de") : language;
    const QList<TranslatedSentence> program =
        sentencesOf(QString(RELUCENT_SOURCE "/translations/relucent_%1.ts").arg(known));
    const QList<HelpPage> english = guidePages(resource, "en"), pages = guidePages(resource, language);
    int found = 0;
    for (int i = 0; i < pages.size(); ++i) {
      const QString page = evenSpaces(pages[i].text);
      for (const QString& quote : allOf("“([^”]+)”", english[i].text)) {
        QStringList said;
        const QRegularExpression message = messageQuotedAs(quote);
        for (const TranslatedSentence& sentence : program)
          if (const auto match = message.match(sentence.source); match.hasMatch())
            said << (language == "en" ? quote
                                      : beginningOf(sentence.forms.value(0), match.hasCaptured("more")));
        QVERIFY2(!said.isEmpty(), qPrintable(pages[i].id + ": the program never says " + quote));
        QVERIFY2(
            std::ranges::any_of(said, [&](const QString& word) { return page.contains(asQuoted(word)); }),
            qPrintable(pages[i].id + ": " + quote + ": " + said.join(", ")));
        ++found;
      }
    }
    QVERIFY(found > 10);
  }

  void wordsAreInTheirOrder_data() { everyLanguage(); }
  void wordsAreInTheirOrder() {
    QFETCH(QString, language);
    if (QLocale(language).script() != QLocale::LatinScript) QSKIP("its order is by sound or by strokes");
    QStringList words = allOf(R"((?:^|\n)\*\*([^*]+)\.\*\*)", guidePages(resource, language).last().text);
    QVERIFY(words.size() > 30);
    QCollator collator{QLocale(language)};
    collator.setIgnorePunctuation(true);
    for (int i = 1; i < words.size(); ++i)
      QVERIFY2(collator.compare(words[i - 1], words[i]) < 0,
               qPrintable(words[i - 1] + " before " + words[i]));
  }

  void aMissingPageIsEnglish_data() {
    QTest::addColumn<QString>("language");
    QTest::addColumn<QStringList>("languages");
    QTest::newRow("exact") << "de" << QStringList{"de", "en", "en"};
    QTest::newRow("without its country") << "de_AT" << QStringList{"de", "en", "en"};
    QTest::newRow("exact, then without its country") << "ar_EG" << QStringList{"ar_EG", "ar", "en"};
    QTest::newRow("of another country") << "zh_TW" << QStringList{"en", "en", "en"};
    QTest::newRow("none") << "xx" << QStringList{"en", "en", "en"};
    QTest::newRow("empty") << QString() << QStringList{"en", "en", "en"};
  }
  void aMissingPageIsEnglish() {
    QFETCH(QString, language);
    QFETCH(QStringList, languages);
    SmallGuide guide;
    QStringList found;
    for (const HelpPage& page : guidePages(guide.path(), language)) {
      QCOMPARE(page.title, page.id + ' ' + page.language);
      found << page.language;
    }
    QCOMPARE(found, languages);
  }

  void languagesAreThoseWithPages() {
    SmallGuide guide;
    QCOMPARE(guideLanguages(guide.path()), QStringList({"ar", "ar_EG", "de", "en", "zh_CN"}));
    QCOMPARE(guideLanguages(guide.path() + "/nowhere"), QStringList());
    QVERIFY(guidePages(guide.path() + "/nowhere", "de").isEmpty());
  }

  void browsersAreToldTheLanguage_data() {
    QTest::addColumn<QString>("page");
    QTest::addColumn<QString>("language");
    QTest::addColumn<QString>("side");
    QTest::newRow("left to right") << "de/1.html"
                                   << "de"
                                   << "ltr";
    QTest::newRow("index") << "de/index.html"
                           << "de"
                           << "ltr";
    QTest::newRow("missing page") << "de/2.html"
                                  << "en"
                                  << "ltr";
    QTest::newRow("right to left") << "ar/2.html"
                                   << "ar"
                                   << "rtl";
    QTest::newRow("right to left, index") << "ar/index.html"
                                          << "ar"
                                          << "rtl";
    QTest::newRow("right to left, missing page") << "ar/3.html"
                                                 << "en"
                                                 << "ltr";
    QTest::newRow("country") << "zh_CN/1.html"
                             << "zh-CN"
                             << "ltr";
  }
  void browsersAreToldTheLanguage() {
    QFETCH(QString, page);
    QFETCH(QString, language);
    QFETCH(QString, side);
    SmallGuide guide;
    QTemporaryDir html;
    writeGuide(guide.path(), html.path());
    QString text = read(html.filePath(page));
    QVERIFY2(text.contains(QString(R"(<html lang="%1" dir="%2">)").arg(language, side)), qPrintable(text));
    QVERIFY(page.contains("index") || text.contains(R"(<a href="2.html">)"));
    QVERIFY(!text.contains(".md"));
    QVERIFY_THROWS_EXCEPTION(std::runtime_error, writeGuide(html.path() + "/nowhere", html.path()));
  }
};

QTEST_MAIN(TestGuide)
#include "test_guide.moc"
