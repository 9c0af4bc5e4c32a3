// SPDX-License-Identifier: MIT
#include <QRegularExpression>
#include <QTest>
#include <QXmlStreamReader>
#include <cmath>

#include "relucent/charts/svg.h"

using namespace relucent;
using namespace relucent::charts;

namespace {

constexpr double noNumber = std::numeric_limits<double>::quiet_NaN();

Chart fullChart() {
  Chart chart{"Light < over \"drive\"", {0.0, 255.0, false, "Level & more"}, {1.0, 1e4, true, "Light"}};
  chart.curves = {{"Red", "red", Marker::circle, {{0.0, 1.0}, {255.0, 1e4}}, {{128.0, 100.0}}},
                  {"", "green", Marker::square, {}, {{64.0, 10.0}}},
                  {"Blue", "before", Marker::none, {{0.0, 5.0}, {100.0, 50.0}}, {}, true}};
  chart.columns = {{10.0, 20.0, 100.0, "kept"}};
  chart.mark = 200.0;
  return chart;
}

struct Element {
  QString name, text;
  QXmlStreamAttributes attributes;
};

/// The elements in their order; empty if the drawing is not well-formed.
QList<Element> elementsOf(const std::string& svg) {
  QList<Element> found;
  QXmlStreamReader xml(QString::fromStdString(svg));
  while (!xml.atEnd()) {
    xml.readNext();
    if (xml.isStartElement()) found << Element{xml.name().toString(), {}, xml.attributes()};
    if (xml.isCharacters() && !found.isEmpty()) found.last().text += xml.text();
  }
  return xml.hasError() ? QList<Element>() : found;
}

QList<Element> named(const QList<Element>& elements, const QString& name, const QString& style) {
  QList<Element> found;
  for (const Element& element : elements)
    if (element.name == name && element.attributes.value("class").toString().split(' ').contains(style))
      found << element;
  return found;
}

double number(const Element& element, const char* name) {
  return element.attributes.value(name).toDouble();
}

}  // namespace

Q_DECLARE_METATYPE(Chart)

class TestSvg : public QObject {
  Q_OBJECT

 private slots:
  void drawingsAreWellFormed_data() {
    QTest::addColumn<Chart>("chart");
    QTest::newRow("nothing") << Chart{};
    QTest::newRow("everything") << fullChart();
    QTest::newRow("no range") << Chart{"", {1.0, 1.0}, {noNumber, noNumber}};
    QTest::newRow("no numbers") << Chart{
        "", {}, {}, {{"a", "b", Marker::triangle, {{noNumber, noNumber}}, {{noNumber, 0.0}}}}};
    QTest::newRow("names that look like markup")
        << Chart{"</svg>", {0, 1, false, "<b>"}, {}, {{"a & b", "c", Marker::none, {{0, 0}, {1, 1}}}}};
  }
  void drawingsAreWellFormed() {
    QFETCH(Chart, chart);
    for (Extent extent : {Extent{470, 300}, Extent{30, 20}, Extent{0, 0}}) {
      std::string svg = svgOf(chart, {extent});
      QVERIFY2(!elementsOf(svg).isEmpty(), svg.c_str());
      QVERIFY2(svg.find("nan") == std::string::npos && svg.find("inf") == std::string::npos, svg.c_str());
    }
  }

  void aScreenReaderSaysItsTitle() {
    QList<Element> elements = elementsOf(svgOf(fullChart(), {{470, 300}}));
    QCOMPARE(elements[0].attributes.value("aria-label").toString(), QString("Light < over \"drive\""));
    QCOMPARE(elements[1].name, QString("title"));
    QCOMPARE(elements[1].text, QString("Light < over \"drive\""));
  }

  /// The plot that a program hears of is the plot that is drawn.
  void valuesStandWhereThePlotSays() {
    Chart chart = fullChart();
    Drawing drawing{{470, 300}};
    PlotArea plot = plotOf(chart, drawing);
    QVERIFY(plot.left > 0.0 && plot.top > 0.0);
    QVERIFY(plot.left + plot.width < 470.0 && plot.top + plot.height < 300.0);
    QList<Element> elements = elementsOf(svgOf(chart, drawing));
    Element point = named(elements, "circle", "red").at(0);
    double x = plot.left + plot.width * 128.0 / 255.0, y = plot.top + plot.height / 2.0;
    QVERIFY(std::abs(number(point, "cx") - x) < 0.051 &&
            std::abs(number(point, "cy") - y) < 0.051);  // one decimal
    Element mark = named(elements, "line", "mark").at(0);
    QVERIFY(std::abs(number(mark, "x1") - (plot.left + plot.width * 200.0 / 255.0)) < 0.051);
    QCOMPARE(number(mark, "x1"), number(mark, "x2"));
  }

  void nothingIsDrawnBesideThePlot() {
    Chart chart{"", {0.0, 1.0}, {0.0, 1.0}};
    chart.curves = {
        {"", "red", Marker::circle, {{-5.0, 0.5}, {0.5, 7.0}, {2.0, 0.5}}, {{-1.0, 0.5}, {0.5, -3.0}}}};
    Drawing drawing{{200, 100}};
    PlotArea plot = plotOf(chart, drawing);
    QList<Element> elements = elementsOf(svgOf(chart, drawing));
    QList<Element> points = named(elements, "circle", "red");
    QCOMPARE(points.size(), 1);
    QVERIFY(std::abs(number(points[0], "cy") - (plot.top + plot.height)) < 0.051);
    QCOMPARE(named(elements, "path", "red").at(0).attributes.value("d").toString().count('L'), 0);
  }

  void theLegendNamesCurvesThatHaveNames() {
    QStringList names;
    for (const Element& entry : named(elementsOf(svgOf(fullChart(), {{470, 300}})), "text", "legend"))
      names << entry.text;
    QCOMPARE(names, QStringList({"Red", "Blue"}));
  }

  void theLegendStandsWhereNoCurveIs_data() {
    QTest::addColumn<double>("from");
    QTest::addColumn<double>("to");
    QTest::newRow("rising") << 0.1 << 0.9;
    QTest::newRow("falling") << 0.9 << 0.1;
    QTest::newRow("above") << 0.95 << 0.95;
    QTest::newRow("below") << 0.05 << 0.05;
  }
  void theLegendStandsWhereNoCurveIs() {
    QFETCH(double, from);
    QFETCH(double, to);
    Chart chart{"", {0.0, 1.0}, {0.0, 1.0}};
    chart.curves = {{"Name", "red", Marker::none, {{0.0, from}, {1.0, to}}, {}}};
    const Drawing drawing{{400, 300}};
    const PlotArea plot = plotOf(chart, drawing);
    const Element name = named(elementsOf(svgOf(chart, drawing)), "text", "legend").at(0);
    const double x = (number(name, "x") - plot.left) / plot.width;
    const double curve = plot.top + plot.height * (1.0 - (from + x * (to - from)));
    QVERIFY(std::abs(number(name, "y") - curve) > 14.0);
  }

  /// Where every corner is taken, by lines, markers or the mark, names stand above the plot, side by side.
  void theLegendLeavesAFullPlot() {
    Chart chart{"", {0.0, 1.0}, {0.0, 1.0, false, "Title"}};
    chart.curves = {{"Upper", "red", Marker::none, {{0.0, 0.95}, {1.0, 0.95}}, {}},
                    {"Lower", "blue", Marker::none, {{0.0, 0.05}, {1.0, 0.05}}, {}}};
    const Drawing drawing{{400, 300}};
    const double top = plotOf(chart, drawing).top;
    const auto full = named(elementsOf(svgOf(chart, drawing)), "text", "legend");
    QCOMPARE(full.size(), qsizetype{2});
    for (const Element& name : full) QVERIFY(number(name, "y") < top);
    QVERIFY(number(full[1], "x") > number(full[0], "x") + 40.0);
    // Signs that are as wide as high take as much as they need.
    chart.curves[0].name = "\u3053\u3053\u3092\u8d85\u3048\u308b\u3068\u8b66\u544a";
    const auto wide = named(elementsOf(svgOf(chart, drawing)), "text", "legend");
    QVERIFY(number(wide[1], "x") > number(wide[0], "x") + 9 * 12.0);
    chart.curves[0].name = "Upper";
    // The mark is in the way as well.
    chart.curves.pop_back();
    chart.curves[0].line = {{0.0, 0.95}, {0.5, 0.95}};
    const auto placed = [&] {
      const Element name = named(elementsOf(svgOf(chart, drawing)), "text", "legend").at(0);
      return std::pair(number(name, "x"), number(name, "y"));
    };
    const auto before = placed();
    chart.mark = 0.9;
    QVERIFY(placed() != before);
  }

  void numbersAreWrittenAsAsked() {
    Drawing drawing{{470, 300}, {}, [](const Axis&, const Tick&) { return std::string("7"); }};
    for (const Element& tick : named(elementsOf(svgOf(fullChart(), drawing)), "text", "number"))
      QCOMPARE(tick.text, QString("7"));
  }

  void aStyleSheetStandsInTheDrawing() {
    QVERIFY(svgOf(fullChart(), {{470, 300}}).find("<style>") == std::string::npos);
    QVERIFY(svgOf(fullChart(), {{470, 300}}).find("xmlns") == std::string::npos);
    const std::string alone = svgOf(fullChart(), {{470, 300}, ".red{}"});
    QVERIFY(alone.find("<style>.red{}</style>") != std::string::npos);
    QVERIFY(alone.starts_with("<svg xmlns=\"http:"));
  }

  void barsAreAsLongAsTheirValues() {
    std::vector<Bar> bars{{"all", 4.0, "4"},
                          {"a quarter", 1.0, "1", true},
                          {"none", -1.0, "-1"},
                          {"exact", std::numeric_limits<double>::infinity(), "exact"},
                          {"?", noNumber, "?"}};
    QList<Element> drawn = named(elementsOf(svgOf(bars, "Bars")), "rect", "bar");
    QCOMPARE(drawn.size(), 5);
    QCOMPARE(number(drawn[1], "width"), number(drawn[0], "width") / 4.0);
    QVERIFY(number(drawn[2], "width") <= 1.0 && number(drawn[4], "width") <= 1.0);
    QCOMPARE(number(drawn[3], "width"), number(drawn[0], "width"));
    QVERIFY(drawn[1].attributes.value("class").contains(u"accent"));
    QVERIFY(!elementsOf(svgOf(std::vector<Bar>{}, "none")).isEmpty());
  }

  void aColourBarRunsThroughItsMap() {
    QList<Element> cells;
    for (const Element& element : elementsOf(colourBarSvg(image::ColourMap::viridis, {"0", "1"}, "Light")))
      if (element.name == "rect") cells << element;
    QVERIFY(cells.size() > 10);
    QVERIFY(cells.first().attributes.value("fill") != cells.last().attributes.value("fill"));
    for (qsizetype i = 1; i < cells.size(); ++i) QVERIFY(number(cells[i], "x") > number(cells[i - 1], "x"));
  }
};

QTEST_APPLESS_MAIN(TestSvg)
#include "test_svg.moc"
