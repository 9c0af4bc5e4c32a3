// SPDX-License-Identifier: MIT
// The guide: nothing in it leads nowhere, in any language.
#include <QDesktopServices>
#include <QDir>
#include <QScrollBar>
#include <QtTest>

#include "app/help_window.h"
#include "app/versions.h"

using namespace relucent;

class TestHelpWindow : public QObject {
  Q_OBJECT

  QUrl outside_;

 public:
  Q_INVOKABLE void show(const QUrl& url) { outside_ = url; }

 private slots:
  void everyLinkAndPictureIsThere_data() {
    QTest::addColumn<QString>("language");
    for (const QString& language :
         QDir(RELUCENT_SOURCE "/resources/help").entryList(QDir::Dirs | QDir::NoDotAndDotDot))
      if (language != "pictures") QTest::newRow(qPrintable(language)) << language;
  }
  void everyLinkAndPictureIsThere() {
    QFETCH(QString, language);
    QList<HelpPage> pages = helpPages(language);
    QCOMPARE(pages.size(), helpPages("en").size());
    static const QRegularExpression link(R"(\]\(([^)]+)\))");
    for (int i = 0; i < pages.size(); ++i) {
      QCOMPARE(pages[i].id, helpPages("en")[i].id);
      QVERIFY2(!pages[i].title.isEmpty(), qPrintable(pages[i].id));
      int pictures = 0;
      for (auto match = link.globalMatch(pages[i].text); match.hasNext();) {
        QString target = match.next().captured(1);
        if (target.startsWith("http")) continue;
        pictures += target.endsWith(".png") ? 1 : 0;
        QString file = QDir::cleanPath(":/help/" + language + '/' + target);
        QVERIFY2(QFile::exists(file), qPrintable(pages[i].id + ": " + target));
      }
      if (i < 8) QCOMPARE(pictures, 1);  // one page a step, each with its picture
    }
  }

  void anotherLanguageFallsBackToEnglish() { QCOMPARE(helpPages("xx").size(), helpPages("en").size()); }

  void everyLibraryIsNamedWithVersionAndLicence() {
    QString about = helpPages("en").last().text;
    QVERIFY(about.contains("Permission is hereby granted"));
    QVERIFY(about.contains(QString::fromStdString(relucentVersion())));
    for (const LibraryVersion& library : allLibraries()) {
      QString name = QString::fromStdString(library.name);
      QVERIFY2(!library.version.empty(), library.name.c_str());
      QVERIFY2(about.contains(name + ' ' + QString::fromStdString(library.version)), library.name.c_str());
      QVERIFY2(about.contains("- **" + name + "**"), library.name.c_str());
    }
  }

  void picturesFitAndLinksLead() {
    HelpWindow help("en");
    help.show();
    QVERIFY(QTest::qWaitForWindowExposed(&help));
    auto* text = help.findChild<HelpText*>("help-text");
    auto* pages = help.findChild<QListWidget*>("help-pages");
    for (int width : {760, 1100}) {
      help.resize(width, 640);
      help.showPage(6);
      QCoreApplication::processEvents();
      auto picture =
          text->document()->resource(QTextDocument::ImageResource, QUrl("../pictures/07-preview.png"));
      QVERIFY(picture.canConvert<QImage>() && !picture.value<QImage>().isNull());
      QVERIFY(text->horizontalScrollBar()->maximum() == 0);
    }
    Q_EMIT text->anchorClicked(QUrl("09-limits.md"));
    QCOMPARE(pages->currentRow(), 8);
    QVERIFY(text->toPlainText().contains("Shadow is shadow"));
    QDesktopServices::setUrlHandler("https", this, "show");
    Q_EMIT text->anchorClicked(QUrl("https://example.org/"));
    QDesktopServices::unsetUrlHandler("https");
    QCOMPARE(outside_, QUrl("https://example.org/"));
    QCOMPARE(pages->currentRow(), 8);
  }
};

QTEST_MAIN(TestHelpWindow)
#include "test_help_window.moc"
