// SPDX-License-Identifier: MIT
#include <QRegularExpression>
#include <QTemporaryDir>
#include <QThread>
#include <QtTest>
#include <cmath>

#include "handover/report_chart.h"
#include "handover/report_pdf.h"
#include "relucent/base/error.h"
#include "relucent/pipeline/report.h"
#include "relucent/pipeline/report_charts.h"

using namespace relucent;
using namespace relucent::gui;
using namespace relucent::hdr;
using namespace relucent::image;
using namespace relucent::pipeline;

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

QImage chart(const std::string& svg) {
  QXmlStreamReader xml(QString::fromStdString(svg));
  xml.readNextStartElement();
  return chartOf(xml, 1.0);
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

  void aChartIsDrawn() {
    QImage empty = chart("<svg viewBox='0 0 40 20'></svg>");
    QCOMPARE(empty.size(), QSize(40, 20));
    QCOMPARE(empty.pixelColor(5, 5), QColor(Qt::white));
    QImage bar =
        chart("<svg viewBox='0 0 40 20'><rect x='2' y='2' width='10' height='10' fill='#ff0000'/></svg>");
    QCOMPARE(bar.pixelColor(6, 6), QColor("#ff0000"));
    QCOMPARE(bar.pixelColor(30, 15), QColor(Qt::white));
    QImage lines = chart("<svg viewBox='0 0 40 20'><path class='after' d='M2 2l20 0v10H2Z'/></svg>");
    QVERIFY(lines.pixelColor(10, 6) != QColor(Qt::white));
    QCOMPARE(lines.pixelColor(30, 15), QColor(Qt::white));
  }

  void everyChartOfTheReportLeavesInk() {
    QImage curves = chart(responseChart(data().responses[0], "Response"));
    QImage bars = chart(barChart({{"a", 1.0, "one", true}, {"b", 0.0, "none", false}}, "Bars"));
    for (const QImage& drawn : {curves, bars}) {
      int ink = 0;
      for (int y = 0; y < drawn.height(); ++y)
        for (int x = 0; x < drawn.width(); ++x) ink += drawn.pixelColor(x, y) != QColor(Qt::white) ? 1 : 0;
      QVERIFY2(ink > 500, QByteArray::number(ink));
    }
  }
};

QTEST_MAIN(TestReportPdf)
#include "test_report_pdf.moc"
