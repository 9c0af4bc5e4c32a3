// SPDX-License-Identifier: MIT
#include "views/matrix_view.h"

#include <QTemporaryDir>
#include <QtTest>

#include "core/transport/random_blocks.h"
#include "relucent/image/exr.h"
#include "theme/tokens.h"
#include "views/raster_axis.h"
#include "views/view_actions.h"
#include "views/vtk_view.h"

using namespace relucent;
using namespace relucent::gui;
using namespace relucent::image;
using namespace relucent::transport;

namespace {

constexpr int patience = 20000;  // milliseconds; pictures of these matrices take one

/// Each camera pixel sees the projector pixel of its own number, in white, and one in the middle everything.
std::shared_ptr<const MatrixPictures> diagonal(int side) {
  Size size{side, side};
  NodeLayout layout{Rasters(size)};
  BlockSparseBuilder builder(layout.count(), std::vector<float>(size.count(), 1.0f));
  for (std::size_t i = 0; i < size.count(); ++i) builder.add(i, i, 0.5f * ColourBlock::Identity());
  return std::make_shared<MatrixPictures>(std::make_shared<TransportMatrix>(size, size, builder.build()));
}

class OpenedView : public MatrixView {
 public:
  using MatrixView::frame;
  using MatrixView::vtk;
};

}  // namespace

class TestMatrixView : public QObject {
  Q_OBJECT

  void open(OpenedView& view, std::shared_ptr<const MatrixPictures> matrix) {
    view.resize(500, 400);
    view.show();
    QVERIFY(QTest::qWaitForWindowExposed(&view));
    view.setMatrix(std::move(matrix));
    QTRY_VERIFY_WITH_TIMEOUT(view.isSettled() && view.valueAt({0, 0}), patience);
  }
  /// The scene's colour at a place of the matrix.
  static QColor colourAt(OpenedView& view, QPointF entry) {
    QImage image = view.vtk()->drawn();
    QPointF place = view.widgetFromPicture(entry) * view.devicePixelRatioF();
    return image.pixelColor(place.toPoint());
  }

 private slots:
  void aDiagonalIsSeenAsOne() {
    OpenedView view;
    open(view, diagonal(16));
    // 256 x 256 entries on more pixels than that: each is seen by itself.
    QCOMPARE(view.seen(), (MatrixPart{0, 256, 0, 256}));
    QVERIFY(std::abs(*view.valueAt({77, 77}) - 0.5f) < 1e-4f);
    QCOMPARE(*view.valueAt({78, 77}), 0.0f);
    QColor none = invalidColour;
    QVERIFY(colourAt(view, {77.5, 77.5}) != none);
    QCOMPARE(colourAt(view, {200.5, 50.5}), none);
    QCOMPARE(colourAt(view, {50.5, 200.5}), none);
    QColor expectedColour =
        qtColourAt(ColourMap::viridis, view.scale().place(static_cast<double>(*view.valueAt({77, 77}))));
    view.link().look(20.0, {77.5 / 256.0, 77.5 / 256.0});
    QTRY_VERIFY_WITH_TIMEOUT(view.isSettled(), patience);
    expectedColour =
        qtColourAt(ColourMap::viridis, view.scale().place(static_cast<double>(*view.valueAt({77, 77}))));
    QColor found = colourAt(view, {77.5, 77.5});
    // Eight bits a channel, twice rounded.
    QVERIFY(std::abs(found.red() - expectedColour.red()) <= 2 &&
            std::abs(found.green() - expectedColour.green()) <= 2);
    QCOMPARE(colourAt(view, {78.5, 77.5}), none);
  }

  void zoomingInComesToSingleEntries() {
    auto transport = std::make_shared<TransportMatrix>(
        Size{40, 30}, Size{64, 48},
        randomBlocks(1200, NodeLayout(Rasters(Size{64, 48})).count(), 0.01, 5, 0.0f).sparse);
    auto pictures = std::make_shared<MatrixPictures>(transport);
    OpenedView view;
    open(view, pictures);
    QPoint entry(1503, 611);
    view.link().look(60.0, {entry.x() / 3072.0, entry.y() / 1200.0});
    QTRY_VERIFY_WITH_TIMEOUT(view.isSettled(), patience);
    MatrixPart seen = view.seen();
    QVERIFY(seen.columns() < 64 && seen.rows() < 64);
    auto column = static_cast<std::size_t>(entry.x()), row = static_cast<std::size_t>(entry.y());
    MatrixDensity exact = pictures->density({row - 2, row + 3, column - 2, column + 3}, {5, 5});
    for (int y = -2; y <= 2; ++y)
      for (int x = -2; x <= 2; ++x)
        QCOMPARE(*view.valueAt(entry + QPoint(x, y)), exact.sums[indexOf(exact.cells, {x + 2, y + 2})]);
  }

  /// Law: what is read at an entry is that entry's, however many a cell of the picture holds.
  void anEntrysValueIsTheSameAtEveryMagnification() {
    auto transport = std::make_shared<TransportMatrix>(
        Size{40, 30}, Size{64, 48},
        randomBlocks(1200, NodeLayout(Rasters(Size{64, 48})).count(), 0.01, 5, 0.0f).sparse);
    auto pictures = std::make_shared<MatrixPictures>(transport);
    OpenedView view;
    open(view, pictures);
    QRandomGenerator random(3);
    for (int i = 0; i < 20; ++i) {
      const auto row = static_cast<std::size_t>(random.bounded(1200)),
                 column = static_cast<std::size_t>(random.bounded(3072));
      const QPoint entry(static_cast<int>(column), static_cast<int>(row));
      const float expected = pictures->density({row, row + 1, column, column + 1}, {1, 1}).sums.front();
      for (double zoom : {1.0, 8.0, 60.0}) {
        view.link().look(zoom, {entry.x() / 3072.0, entry.y() / 1200.0});
        QTRY_VERIFY_WITH_TIMEOUT(view.isSettled(), patience);
        QCOMPARE(*view.valueAt(entry), expected);
      }
    }
  }

  void theKeysOfAView() {
    OpenedView view;
    open(view, diagonal(16));
    QTest::keyClick(&view, Qt::Key_Plus);
    QVERIFY(view.link().zoom() > 1.0);
    QTest::keyClick(&view, Qt::Key_Minus);
    QVERIFY(view.link().zoom() < 1.01);
    QTest::keyClick(&view, Qt::Key_Plus);
    QTest::keyClick(&view, Qt::Key_0);
    QCOMPARE(view.link().zoom(), 1.0);
    QTest::keyClick(&view, Qt::Key_Right);
    QPoint pick = *view.link().pick();
    QTest::keyClick(&view, Qt::Key_Down, Qt::ShiftModifier);
    QCOMPARE(*view.link().pick(), pick + QPoint(0, 10));
    QVERIFY(!view.accessibleDescription().isEmpty());
  }

  void aClickPicksTheEntryBelowIt() {
    OpenedView view;
    open(view, diagonal(16));
    view.link().look(4.0, {0.5, 0.5});
    QPoint place = view.widgetFromPicture({120.5, 133.5}).toPoint();
    QTest::mouseClick(&view, Qt::LeftButton, {}, place);
    QVERIFY(view.link().pick().has_value());
    QPoint away = *view.link().pick() - QPoint(120, 133);
    QVERIFY(away.manhattanLength() <= 1);  // a place is a whole pixel of the screen
  }

  void aDragShowsAtOnceWhatIsThere() {
    OpenedView view;
    open(view, diagonal(32));
    view.link().look(8.0, {0.5, 0.5});
    QTRY_VERIFY_WITH_TIMEOUT(view.isSettled(), patience);
    MatrixPart before = view.seen();
    QPoint middle = view.frame().center().toPoint();
    QTest::mousePress(&view, Qt::LeftButton, {}, middle);
    QTest::mouseMove(&view, middle + QPoint(-40, -30));
    QTest::mouseRelease(&view, Qt::LeftButton, {}, middle + QPoint(-40, -30));
    QVERIFY(view.seen().firstColumn > before.firstColumn && view.seen().firstRow > before.firstRow);
    QVERIFY(!view.link().pick());
    QVERIFY(!view.vtk()->drawn().isNull());
  }

  void whatIsSeenIsSaved() {
    QTemporaryDir folder;
    OpenedView view;
    open(view, diagonal(16));
    ViewValues values{[&view] { return view.values(); }, "camera signal per second"};
    QString numbers = folder.filePath("matrix.exr"), picture = folder.filePath("matrix.png");
    saveView(view, values, numbers);
    saveView(view, values, picture);
    ExrImage read = readExr(numbers.toStdString());
    QCOMPARE(read.pixels, view.values());
    QCOMPARE(std::get<std::string>(read.attributes.at(exr_attribute::units)), values.units);
    QCOMPARE(QImage(picture).size(), view.size() * view.devicePixelRatioF());
    QVERIFY_EXCEPTION_THROWN(saveView(view, values, folder.filePath("matrix.gif")), Error);
    QVERIFY_EXCEPTION_THROWN(saveView(view, values, folder.filePath("none/matrix.png")), Error);
    QVERIFY_EXCEPTION_THROWN(saveView(view, {}, numbers), Error);
  }

  void aFileIsSuggested_data() {
    QTest::addColumn<QString>("shown");
    QTest::addColumn<QString>("name");
    QTest::newRow("plain") << "Error map" << "Error map.png";
    QTest::newRow("what no file may be called") << " Light: T\\p / \"e\"?\n" << "Light T p e.png";
    QTest::newRow("what is told at length")
        << "Audience's view, corrected at the right" << "Audience's view.png";
    QTest::newRow("at length in another script")
        << QString::fromUtf8("خريطة، تفاصيل") << QString::fromUtf8("خريطة.png");
    QTest::newRow("another script") << QString::fromUtf8("خريطة الخطأ")
                                    << QString::fromUtf8("خريطة الخطأ.png");
  }
  void aFileIsSuggested() {
    QFETCH(QString, shown);
    QFETCH(QString, name);
    const QFileInfo file(suggestedFile({}, shown, ".png"));
    QCOMPARE(file.fileName(), name);
    QVERIFY(file.isAbsolute());
    QCOMPARE(QFileInfo(suggestedFile("/venues/Chapel", shown, ".png")).fileName(), "Chapel, " + name);
  }
  void aFileHasANameWhateverIsShown() {
    QVERIFY(!QFileInfo(suggestedFile({}, {}, ".png")).baseName().isEmpty());
  }

  void anotherMatrixTakesItsPlace() {
    OpenedView view;
    open(view, diagonal(16));
    view.setMatrix(diagonal(4));
    QTRY_VERIFY_WITH_TIMEOUT(view.isSettled() && view.valueAt({0, 0}), patience);
    QCOMPARE(view.seen(), (MatrixPart{0, 16, 0, 16}));
    view.setMatrix(nullptr);
    QVERIFY(view.values().empty());
    QVERIFY(!view.vtk()->drawn().isNull());
  }

  void marksAreLinesThenPixels() {
    Rasters rasters(std::vector<Size>{{100, 50}, {40, 20}});
    for (const RasterTick& tick : rasterTicks(rasters, 0, 5800, 8)) {
      bool second = tick.place >= 5000.0;
      QCOMPARE(tick.text.startsWith("2: "), second);
      int line = tick.text.section(' ', 1).toInt();
      QCOMPARE(tick.place, second ? 5000.0 + 40.0 * line : 100.0 * line);
    }
    std::vector<RasterTick> near = rasterTicks(rasters, 110, 120, 5);
    QVERIFY(!near.empty());
    for (const RasterTick& tick : near)
      QCOMPARE(tick.text, QString("1: %1, 1").arg(static_cast<int>(tick.place) - 100));
    QVERIFY(rasterTicks(Rasters(), 0, 1, 5).empty());
    QVERIFY(rasterTicks(rasters, 3, 3, 5).empty());
  }
};

QTEST_MAIN(TestMatrixView)
#include "test_matrix_view.moc"
