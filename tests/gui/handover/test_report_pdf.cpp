// SPDX-License-Identifier: MIT
#include <QRegularExpression>
#include <QTemporaryDir>
#include <QThread>
#include <QtTest>
#include <cmath>

#include "handover/chart_picture.h"
#include "handover/report_pdf.h"
#include "relucent/base/error.h"
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
  data.settings = {{"acquisition.relative_threshold", "0.008"}};
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
