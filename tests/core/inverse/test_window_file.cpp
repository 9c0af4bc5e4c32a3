// SPDX-License-Identifier: MIT
#include "relucent/inverse/window_file.h"

#include <QTemporaryDir>
#include <QtTest>
#include <cstring>

#include "core/inverse/synthetic_transport.h"
#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/transport/npz.h"

using namespace relucent;
using namespace relucent::inverse;
using namespace relucent::synthetic;

namespace {

Progress quiet;

/// An archive of windows of a 4x4 projector, one tile, before a camera of 2x1 pixels: sound as it is.
struct Arrays {
  std::vector<std::int32_t> cameras{2, 1}, projectors{4, 4}, tile{4}, row{0, 1};
  std::vector<std::int64_t> start{0, 2};
  std::vector<float> unmix = std::vector<float>(18, 1.0f), scale = std::vector<float>(3, 0.5f);
  std::vector<std::int16_t> weight = std::vector<std::int16_t>(2 * 3 * 16, 7);

  void save(const std::filesystem::path& path) const {
    transport::NpzWriter writer;
    writer.addText("format", "relucent-windows");
    writer.addText("key", "k");
    writer.add("cameras", cameras, {cameras.size() / 2, 2});
    writer.add("projectors", projectors, {projectors.size() / 2, 2});
    writer.add("tile", tile, {tile.size()});
    writer.add("tile_start", start, {start.size()});
    writer.add("row", row, {row.size()});
    const auto bytesOf = [](const auto& values) {
      return [&values](std::uint64_t begin, std::uint64_t count, char* out) {
        std::memcpy(out, values.data() + begin, count * sizeof(values[0]));
      };
    };
    writer.add("unmix", {"<f4", {unmix.size() / 9, 3, 3}}, bytesOf(unmix));
    writer.add("scale", {"<f4", {scale.size() / 3, 3}}, bytesOf(scale));
    writer.add("weight", {"<i2", {weight.size() / 48, 3, 16}}, bytesOf(weight));
    writer.save(path);
  }
};

using Change = std::function<void(Arrays&)>;

}  // namespace

Q_DECLARE_METATYPE(Change)

class TestWindowFile : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  std::filesystem::path path() const { return folder_.filePath("windows.npz").toStdString(); }

  void refused() const {
    try {
      loadWindows(path(), "k");
      QFAIL("taken for windows");
    } catch (const Error& error) {
      QVERIFY2(error.kind() == ErrorKind::format, error.what());
    }
  }

 private slots:
  /// Law: what was stored comes back, the same bits, and is found by its key alone.
  void theSameBits_data() {
    QTest::addColumn<int>("tile");
    QTest::addColumn<int>("width");
    QTest::addColumn<bool>("isDark");
    for (int tile : {4, 8})
      for (int width : {64, 37})
        for (bool isDark : {false, true})
          QTest::addRow("tiles of %d, %d pixels wide%s", tile, width, isDark ? ", nothing usable" : "")
              << tile << width << isDark;
  }
  void theSameBits() {
    QFETCH(int, tile);
    QFETCH(int, width);
    QFETCH(bool, isDark);
    SceneSettings settings;
    settings.projector = {width, 29};
    Scene scene = makeScene(settings);
    if (isDark) std::fill(scene.usable.begin(), scene.usable.end(), std::uint8_t{0});
    WindowSettings made;
    made.tile = tile;
    const WindowInverse windows = computeWindows(scene.transport, scene.usable, made, quiet);
    saveWindows(path(), windows, "of this");
    const std::optional<WindowInverse> read = loadWindows(path(), "of this");
    QVERIFY(read && *read == windows);
    QVERIFY(!loadWindows(path(), "of that"));
  }

  void cutOff_data() {
    QTest::addColumn<double>("share");
    for (double share : {0.0, 0.3, 0.9, 0.999}) QTest::addRow("%g of the file", share) << share;
  }
  void cutOff() {
    QFETCH(double, share);
    Arrays().save(path());
    const std::string whole = readFile(path());
    writeFileAtomically(path(),
                        whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size()))));
    refused();
  }

  void whatContradicts_data() {
    QTest::addColumn<Change>("change");
    const auto add = [](const char* name, Change change) { QTest::newRow(name) << std::move(change); };
    add("another tile", [](Arrays& a) { a.tile = {5}; });
    add("no tile", [](Arrays& a) { a.tile = {}; });
    add("a pixel beyond the camera", [](Arrays& a) { a.row[1] = 2; });
    add("a negative pixel", [](Arrays& a) { a.row[0] = -1; });
    add("rows of nobody", [](Arrays& a) { a.start[1] = 1; });
    add("rows that go back",
        [](Arrays& a) { a.projectors = {8, 4}, a.scale.resize(6), a.start = {0, 3, 2}; });
    add("rows from below none", [](Arrays& a) { a.start[0] = -1; });
    add("a tile too few", [](Arrays& a) { a.projectors = {8, 4}; });
    add("fewer weights", [](Arrays& a) { a.weight.resize(48); });
    add("fewer scales", [](Arrays& a) { a.scale.clear(); });
    add("fewer colours", [](Arrays& a) { a.unmix.resize(9); });
    add("infinite colours", [](Arrays& a) { a.unmix[3] = std::numeric_limits<float>::infinity(); });
    add("no number for a scale", [](Arrays& a) { a.scale[1] = std::nanf(""); });
    add("a huge camera", [](Arrays& a) { a.cameras = {1 << 30, 1 << 30}; });
  }
  void whatContradicts() {
    QFETCH(Change, change);
    Arrays arrays;
    arrays.save(path());
    QVERIFY(loadWindows(path(), "k"));
    change(arrays);
    arrays.save(path());
    refused();
  }
};

QTEST_APPLESS_MAIN(TestWindowFile)
#include "test_window_file.moc"
