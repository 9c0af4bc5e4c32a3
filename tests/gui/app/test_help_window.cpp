// SPDX-License-Identifier: MIT
// The guide beside the program: read from its language's side, with pictures that fit and links that lead.
#include <QDesktopServices>
#include <QScrollBar>
#include <QTextBlock>
#include <QtTest>

#include "app/help_window.h"
#include "app/versions.h"
#include "theme/theme.h"

using namespace relucent;
using namespace relucent::gui;
using namespace relucent::pipeline;

class TestHelpWindow : public QObject {
  Q_OBJECT

  QUrl outside_;

 public:
  Q_INVOKABLE void show(const QUrl& url) { outside_ = url; }

 private slots:
  void aPageIsReadFromTheSideOfItsLanguage_data() {
    QTest::addColumn<QString>("language");
    QTest::addColumn<Qt::LayoutDirection>("first");
    QTest::addColumn<Qt::LayoutDirection>("second");
    QTest::newRow("German") << "de" << Qt::LeftToRight << Qt::LeftToRight;
    QTest::newRow("Arabic") << "ar" << Qt::RightToLeft << Qt::RightToLeft;
    QTest::newRow("several") << QString() << Qt::RightToLeft << Qt::LeftToRight;
  }
  void aPageIsReadFromTheSideOfItsLanguage() {
    QFETCH(QString, language);
    QFETCH(Qt::LayoutDirection, first);
    QFETCH(Qt::LayoutDirection, second);
    HelpText text;
    text.show({"page", "page", "# مكان\n\nRelucent مكان", language});
    QCOMPARE(text.document()->firstBlock().textDirection(), first);
    QCOMPARE(text.document()->lastBlock().textDirection(), second);
  }

  /// A page looks the same whatever was read before, and from its start.
  void aPageTakesNothingOverFromTheOneBefore() {
    HelpWindow help("en");
    help.show();
    QVERIFY(QTest::qWaitForWindowExposed(&help));
    auto* text = help.findChild<HelpText*>("help-text");
    auto* search = help.findChild<QLineEdit*>("help-search");
    auto sizes = [](const QTextDocument& document) {
      QList<QVariant> found;
      for (QTextBlock block = document.begin(); block.isValid(); block = block.next())
        for (auto piece = block.begin(); !piece.atEnd(); ++piece)
          found << piece.fragment().charFormat().property(QTextFormat::FontSizeAdjustment);
      return found;
    };
    const QList<HelpPage> pages = helpPages("en");
    for (int i = 0; i < pages.size(); ++i) {
      HelpText fresh;
      fresh.show(pages[i]);
      help.showPage((i + 3) % static_cast<int>(pages.size()));
      help.showPage(i);
      QCOMPARE(sizes(*text->document()), sizes(*fresh.document()));
    }
    search->setText("flicker");
    search->clear();
    HelpText fresh;
    fresh.show(pages.last());
    help.showPage(static_cast<int>(pages.size()) - 1);
    QCOMPARE(sizes(*text->document()), sizes(*fresh.document()));
  }

  /// Law: words that no page holds show no page, whichever was read before.
  void whatNoPageHoldsIsSaidAlone() {
    HelpWindow help("en");
    help.show();
    QVERIFY(QTest::qWaitForWindowExposed(&help));
    auto* text = help.findChild<HelpText*>("help-text");
    auto* search = help.findChild<QLineEdit*>("help-search");
    for (int i = 0; i < helpPages("en").size(); ++i) {
      help.showPage(i);
      QCoreApplication::processEvents();
      search->setText("nowhere-to-be-found");
      QCoreApplication::processEvents();
      QCOMPARE(text->toPlainText().trimmed(), QString("No page holds these words."));
      help.resize(help.width() + (i % 2 == 0 ? 40 : -40), help.height());
      QCoreApplication::processEvents();
      QCOMPARE(text->toPlainText().trimmed(), QString("No page holds these words."));
    }
    // Whoever asks for keys finds them.
    search->setText("keyboard shortcuts");
    QVERIFY(text->toPlainText().contains("Alt+Left"));
  }

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
    const auto brightness = [&](Look look) {
      Theme::instance().apply(look);
      const auto picture =
          text->document()->resource(QTextDocument::ImageResource, QUrl("../pictures/07-preview.png"));
      return qGray(
          picture.value<QImage>().scaled(1, 1, Qt::IgnoreAspectRatio, Qt::SmoothTransformation).pixel(0, 0));
    };
    QVERIFY(brightness(Look::dark) < 80 && brightness(Look::light) > 120);
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
