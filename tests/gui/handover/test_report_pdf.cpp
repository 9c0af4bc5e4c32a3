// SPDX-License-Identifier: MIT
#include <QProcess>
#include <QRegularExpression>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QThread>
#include <QtTest>
#include <cmath>

#include "handover/chart_picture.h"
#include "handover/page_places.h"
#include "handover/report_pdf.h"
#include "handover/report_pieces.h"
#include "relucent/base/error.h"
#include "relucent/report/pictures.h"
#include "relucent/report/report.h"

using namespace relucent;
using namespace relucent::gui;
using namespace relucent::hdr;
using namespace relucent::image;
using namespace relucent::report;

namespace {

ReportData data() {
  ReportData data;
  data.title = "Chapel & altar";
  data.projector = {256, 192};
  data.camera = {64, 48};
  std::vector<double> x, y;
  for (int i = 0; i <= 32; ++i) {
    x.push_back(i / 32.0);
    y.push_back(std::pow(i / 32.0, 2.2));
  }
  ResponseCurve curve(x, y);
  data.responses = {{{curve, ResponseCurve(), curve}}};
  data.flood = Image({64, 48}, 3);
  for (std::size_t i = 0; i < data.flood.data().size(); ++i)
    data.flood.data()[i] = 0.1f + static_cast<float>(i % 97) / 97.0f;
  data.black = Image({64, 48}, 3);
  for (float& value : data.black.data()) value = 0.01f;
  data.ridgeCurve = {{0.2, 24.5}, {0.4, 24.75}};
  for (int i = 0; i < 60; ++i) data.settings.push_back({"Setting " + std::to_string(i), "8"});
  data.libraries = {{"Eigen", "3.4.0"}};
  return data;
}

QString html() {
  return QString::fromStdString(reportHtml(data()));
}

QByteArray read(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

}  // namespace

class TestReportPdf : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  QString file_ = folder_.filePath("report.pdf");

 private slots:
  void itIsAPdfOfSomePages() {
    writeReportPdf(html(), file_);
    QByteArray pdf = read(file_);
    QVERIFY(pdf.startsWith("%PDF-1.") && pdf.trimmed().endsWith("%%EOF"));
    QVERIFY(pdf.count("/Type /Page\n") >= 1);
    // The pictures of flood, reachable light and black, and the charts.
    QVERIFY2(pdf.count("/Subtype /Image") >= 5, QByteArray::number(pdf.count("/Subtype /Image")));
  }

  /// What is searched for, copied, or read aloud.
  void itsTextIsWhatTheReportSays_data() {
    QTest::addColumn<QString>("text");
    for (const char* text : {"measured at 12:30:05", "256 × 192 pixels", "-0.5 to 3.2 dB", "1 -> 2 => 3",
                             "fi ffi fl", "0x1F (2x4)", "Größe, Élan, ΔE₀₀ 1.5 %"})
      QTest::newRow(text) << QString::fromUtf8(text);
  }
  void itsTextIsWhatTheReportSays() {
    QFETCH(QString, text);
    const QString reader = QStandardPaths::findExecutable("pdftotext");
    if (reader.isEmpty()) QSKIP("pdftotext is not installed (poppler-utils)");
    writeReportPdf("<html><head><title>Law</title></head><body><h1>" + text.toHtmlEscaped() + "</h1><p>" +
                       text.toHtmlEscaped() + "</p></body></html>",
                   file_);
    QProcess reading;
    reading.start(reader, {file_, "-"});
    QVERIFY(reading.waitForFinished());
    const QString found = QString::fromUtf8(reading.readAllStandardOutput());
    QVERIFY2(found.count(text) >= 2, qPrintable(found));
  }

  /// Law: in a wide table names and figures stay whole, and what is read has a quarter of the page.
  void wideTablesKeepTheirWordsWhole() {
    const QString table =
        "<html><body><table><thead><tr><th scope=\"col\">Method</th><th class=\"prose\">What it "
        "does</th></tr>"
        "</thead><tbody><tr><th scope=\"row\">optimum</th><td>27.7 dB</td><td class=\"prose\">the best for "
        "still pictures</td></tr></tbody></table></body></html>";
    const ReportPieces pieces = reportPieces(table, 640.0);
    QCOMPARE(pieces.pieces.size(), 1);
    const QString& paper = pieces.pieces[0].html;
    for (const char* whole : {"optimum", "27.7 dB"})
      QVERIFY(QRegularExpression(QString("nowrap\">%1").arg(whole)).match(paper).hasMatch());
    QVERIFY(!QRegularExpression("nowrap\">(Method|What|the best)").match(paper).hasMatch());
    QCOMPARE(paper.count("width=\"25%\""), 2);
  }

  /// Law: pieces keep their order, do not overlap, stay on their page, and no heading ends a page.
  void headingsStandWithWhatFollows_data() {
    QTest::addColumn<QList<PieceSize>>("pieces");
    QTest::newRow("nothing") << QList<PieceSize>{};
    QTest::newRow("a heading at the foot")
        << QList<PieceSize>{{80, 0, false}, {10, 5, true}, {20, 5, false}, {10, 5, false}};
    QTest::newRow("two headings and a chart")
        << QList<PieceSize>{{60, 0, false}, {10, 5, true}, {5, 2, true}, {40, 2, false}};
    QTest::newRow("more than a page holds, together")
        << QList<PieceSize>{{60, 0, false}, {10, 5, true}, {30, 5, true}, {80, 5, false}};
    QTest::newRow("higher than a page") << QList<PieceSize>{{30, 0, true}, {250, 5, false}, {10, 5, false}};
    QList<PieceSize> many;
    for (int i = 0; i < 200; ++i) many.append({7.0 + i * 13 % 41, double(i % 5), i % 4 == 0 && i < 199});
    QTest::newRow("many") << many;
  }
  void headingsStandWithWhatFollows() {
    QFETCH(QList<PieceSize>, pieces);
    constexpr double page = 100.0;
    const QList<PiecePlace> places = placesOf(pieces, page);
    QCOMPARE(places.size(), pieces.size());
    for (qsizetype i = 0; i < places.size(); ++i) {
      const double bottom = places[i].top + places[i].scale * pieces[i].height;
      QVERIFY(places[i].top >= 0.0 && bottom <= page + 1e-9 && places[i].scale <= 1.0);
      if (i + 1 == places.size()) break;
      const PiecePlace& next = places[i + 1];
      QVERIFY(next.page == places[i].page ? next.top >= bottom : next.page == places[i].page + 1);
      const bool fits = pieces[i].height + pieces[i + 1].gap + pieces[i + 1].height <= page;
      if (pieces[i].keepsNext && fits) QVERIFY2(next.page == places[i].page, QByteArray::number(i));
    }
  }

  /// Law: no figure that likes to stay together leaves more than half of a page empty.
  void figuresFillPages() {
    // A heading, and six rows of pictures below less than half a page of text.
    QList<PieceSize> pieces{{40, 0, false}, {5, 5, true}};
    for (int row = 0; row < 6; ++row) pieces.append({14, 1, false, row < 5});
    const QList<PiecePlace> places = placesOf(pieces, 100.0);
    QCOMPARE(places[1].page, 0);
    QCOMPARE(places[2].page, 0);
    QCOMPARE(places.last().page, 1);
    // Below more than that they stay together.
    pieces.front().height = 60;
    const QList<PiecePlace> together = placesOf(pieces, 100.0);
    QCOMPARE(together[1].page, 1);
    QCOMPARE(together.last().page, 1);
  }

  /// Law: no page holds a line alone that gaps would have room for.
  void gapsSpareAPage() {
    QList<PieceSize> pieces;
    for (int line = 0; line < 6; ++line) pieces.append({15, 4, false});  // 90 and five gaps of 4
    QCOMPARE(placesOf(pieces, 100.0).last().page, 0);
    pieces.append({15, 4, false});
    QCOMPARE(placesOf(pieces, 100.0).last().page, 1);
  }

  void everythingOfTheReportIsAPiece() {
    const ReportPieces found = reportPieces(html(), 640.0);
    QVERIFY(found.title.startsWith("Chapel & altar"));
    QString all;
    for (const ReportPiece& piece : found.pieces) all += piece.html;
    for (const char* text : {"Chapel &amp; altar", "Findings", "Nothing stands out", "Floodlight image",
                             "Response of projector 1", "Setting 0", "Setting 59", "Not darker than black"})
      QVERIFY2(all.contains(text), text);
    QVERIFY(found.pictures.size() >= 5);
    for (qsizetype i = 0; i < found.pictures.size(); ++i) QVERIFY(all.contains(pictureName(i)));
    // A heading is never the last, nor is what keeps the next.
    QVERIFY(!found.pieces.last().keepsNext);
    for (const ReportPiece& piece : found.pieces)
      if (piece.html.startsWith("<h")) QVERIFY(piece.keepsNext);
  }

  /// Law: rows of one figure stay together, as long as a page holds them.
  void picturesStayWithTheirHeading() {
    const QString picture = QString::fromStdString(pngDataUri(Image({4, 3}, 3)));
    QString figures;
    for (int i = 0; i < 5; ++i) figures += "<figure><img src=\"" + picture + "\"></figure>";
    const QString section =
        "<section><h2>Before and after</h2><p class=\"soft\">Of it.</p><div class=\"pictures\">" + figures +
        "</div></section>";
    const ReportPieces found = reportPieces("<html><body>" + section + section + "</body></html>", 640.0);
    QCOMPARE(found.pieces.size(), 8);
    for (qsizetype i = 0; i < found.pieces.size(); ++i) {
      QCOMPARE(found.pieces[i].keepsNext, i % 4 < 2);
      QCOMPARE(found.pieces[i].likesNext, i % 4 == 2);
    }
  }

  void anotherThreadWritesItToo() {
    std::unique_ptr<QThread> thread(
        QThread::create([&] { writeReportPdf(html(), folder_.filePath("other.pdf")); }));
    thread->start();
    QVERIFY(thread->wait(60000));
    QVERIFY(read(folder_.filePath("other.pdf")).size() > 1000);
  }

  void nothingIsWrittenOfWhatIsNoReport() {
    QString file = folder_.filePath("none.pdf");
    QString broken = html().replace("</section>", "");
    QString noPicture = html().replace(QRegularExpression("base64,[^\"]*"), "base64,AAAA");
    QVERIFY_EXCEPTION_THROWN(writeReportPdf(broken, file), Error);
    QVERIFY_EXCEPTION_THROWN(writeReportPdf(noPicture, file), Error);
    QVERIFY(!QFile::exists(file));
    QVERIFY_EXCEPTION_THROWN(writeReportPdf(html(), "/nowhere/report.pdf"), Error);
  }

  /// The program's font has its size in pixels.
  void initTestCase() {
    QFont inPixels;
    inPixels.setPixelSize(13);
    QGuiApplication::setFont(inPixels);
  }

  void textOnPaperHasItsSize() {
    QXmlStreamReader xml(
        QString("<svg viewBox='0 0 200 20'><text class='number' x='2' y='14'>HHHHHHHHHHHHHHHH</text></svg>"));
    xml.readNextStartElement();
    QImage drawn = chartPicture(xml, 1.0);
    int ink = 0;
    for (int y = 0; y < drawn.height(); ++y)
      for (int x = 0; x < drawn.width(); ++x) ink += qGray(drawn.pixel(x, y)) < 128 ? 1 : 0;
    QVERIFY2(ink > 16 * 10, QByteArray::number(ink));  // two stems and a bar of each letter
  }

  void everyChartOfTheReportLeavesInk() {
    QRegularExpression drawing("<svg.*?</svg>", QRegularExpression::DotMatchesEverythingOption);
    int charts = 0;
    for (const auto& match : drawing.globalMatch(html())) {
      QXmlStreamReader xml(match.captured());
      xml.readNextStartElement();
      QImage drawn = chartPicture(xml, 2.0);
      QVERIFY(xml.isEndElement() && xml.name() == u"svg");
      int ink = 0;
      bool isColoured = false;
      for (int y = 0; y < drawn.height(); ++y)
        for (int x = 0; x < drawn.width(); ++x) {
          QColor colour = drawn.pixelColor(x, y);
          ink += colour != QColor(Qt::white) ? 1 : 0;
          isColoured |= colour.saturation() > 100;
        }
      bool wantsColour =
          match.captured().contains(QRegularExpression("class=\"(red|after|bar accent|legend)"));
      QVERIFY2(ink > 1000 && isColoured == wantsColour, qPrintable(match.captured().left(200)));
      ++charts;
    }
    QVERIFY2(charts >= 3, QByteArray::number(charts));
  }
};

QTEST_MAIN(TestReportPdf)
#include "test_report_pdf.moc"
